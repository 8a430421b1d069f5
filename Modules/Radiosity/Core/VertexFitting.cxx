#include "Radiosity/Core/VertexFitting.h"

#include <algorithm>
#include <numeric>

#include "Common/Core/Parallel.h"

namespace lambert {

namespace {

/// Parts of a triangle's area that one of its corners and its middle stand for.
constexpr float kCorner = 1.f / 12, kMiddle = 3.f / 4;
/// Rounds, and the part of the way to what each alone would ask for.
constexpr int kRounds = 12;
constexpr float kStep = 0.6f;

/// The triangles about each point, in their order.
struct TrianglesOfPoints {
  std::vector<int32_t> begin, triangles;

  TrianglesOfPoints(const std::vector<FittedTriangle>& all, size_t points)
      : begin(points + 2, 0), triangles(3 * all.size()) {
    // Counted one place further, so that filling them in moves the ends to where others begin.
    for (const FittedTriangle& t : all) {
      for (const int32_t p : t.points) ++begin[size_t(p) + 2];
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    for (size_t t = 0; t < all.size(); ++t) {
      for (const int32_t p : all[t].points) {
        triangles[size_t(begin[size_t(p) + 1]++)] = int32_t(t);
      }
    }
  }
  template <class Visit>
  void ForEach(size_t point, const Visit& visit) const {
    for (int32_t i = begin[point]; i < begin[point + 1]; ++i) {
      visit(size_t(triangles[size_t(i)]));
    }
  }
};

}  // namespace

std::vector<Spectrum> FitVertices(const std::vector<Spectrum>& irradiance,
                                  const std::vector<FittedTriangle>& triangles) {
  // What each point may become, and how much it counts for.
  const int64_t points = int64_t(irradiance.size());
  const TrianglesOfPoints about(triangles, irradiance.size());
  std::vector<Spectrum> least = irradiance, most = irradiance, fitted = irradiance;
  std::vector<float> weight(irradiance.size(), 0);
  ParallelForEach(points, 4096, [&](int64_t i) {
    const size_t p = size_t(i);
    about.ForEach(p, [&](size_t index) {
      const FittedTriangle& t = triangles[index];
      weight[p] += t.area * (kCorner + kMiddle / 9);
      for (int band = 0; band < 3; ++band) {
        least[p][band] = std::min(least[p][band], t.middle[band]);
        most[p][band] = std::max(most[p][band], t.middle[band]);
      }
    });
  });

  // By how much the middle of each triangle is missed, and down the slope of that at each point.
  std::vector<Spectrum> off(triangles.size());
  for (int round = 0; round < kRounds; ++round) {
    ParallelForEach(int64_t(triangles.size()), 4096, [&](int64_t i) {
      const FittedTriangle& t = triangles[size_t(i)];
      off[size_t(i)] = t.middle * -1.f;
      for (const int32_t p : t.points) off[size_t(i)] += fitted[size_t(p)] / 3.f;
    });
    ParallelForEach(points, 4096, [&](int64_t i) {
      const size_t p = size_t(i);
      if (!(weight[p] > 0)) return;
      Spectrum slope;
      about.ForEach(p, [&](size_t t) {
        slope +=
            ((fitted[p] - irradiance[p]) * kCorner + off[t] * (kMiddle / 3)) * triangles[t].area;
      });
      fitted[p] += slope * (-kStep / weight[p]);
      for (int band = 0; band < 3; ++band) {
        fitted[p][band] = std::min(most[p][band], std::max(least[p][band], fitted[p][band]));
      }
    });
  }
  return fitted;
}

}  // namespace lambert
