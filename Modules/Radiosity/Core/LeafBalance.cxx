#include "Radiosity/Core/LeafBalance.h"

#include <algorithm>
#include <numeric>

#include "Common/Core/Parallel.h"

namespace lambert {

namespace {

/// Bounces go on until one brings less than this part of all light, or so many.
constexpr double kLeastGained = 1e-4;
constexpr int kMostBounces = 500;

/// One bounce of what all have `now`, to the leaf of a row.
void Receive(const LeafRows& rows, size_t row, const std::vector<Spectrum>& now,
             const Spectrum& most, Spectrum* places) {
  const int64_t begin = rows.begin[row];
  const int64_t count = (rows.begin[row + 1] - begin) / kSamplesPerElement;
  places[kMean] = Spectrum();
  for (int64_t k = 0; k < kSamplesPerElement; ++k) {
    Spectrum sum;
    for (int64_t r = begin + k * count; r < begin + (k + 1) * count; ++r) {
      const LeafRay& ray = rows.rays[size_t(r)];
      if (ray.element < 0) continue;
      sum += ray.part * now[size_t(ray.element) * kPlacesOfLeaf + size_t(ray.place)];
    }
    const Spectrum all = rows.fromSources[row][size_t(k)] + sum / float(count);
    for (int band = 0; band < 3; ++band) places[k][band] = std::min(most[band], all[band]);
    places[kMean] += places[k] / float(kSamplesPerElement);
  }
}

}  // namespace

std::vector<Spectrum> BalanceLeaves(const LeafRows& rows, const std::vector<Spectrum>& received,
                                    const Spectrum& most) {
  std::vector<Spectrum> now = received;
  for (const int32_t leaf : rows.leaves) {
    std::fill_n(now.begin() + int64_t(leaf) * kPlacesOfLeaf, kPlacesOfLeaf, Spectrum());
  }
  std::vector<Spectrum> next = now;
  std::vector<float> power(rows.leaves.size()), gained(rows.leaves.size());
  for (int bounce = 0; bounce < kMostBounces; ++bounce) {
    ParallelForEach(int64_t(rows.leaves.size()), 64, [&](int64_t i) {
      const size_t row = size_t(i), first = size_t(rows.leaves[row]) * kPlacesOfLeaf;
      Receive(rows, row, now, most, &next[first]);
      power[row] = rows.areas[row] * next[first + kMean].Mean();
      gained[row] = power[row] - rows.areas[row] * now[first + kMean].Mean();
    });
    now.swap(next);
    const double all = std::accumulate(power.begin(), power.end(), 0.0);
    if (std::accumulate(gained.begin(), gained.end(), 0.0) <= kLeastGained * all) break;
  }
  return now;
}

}  // namespace lambert
