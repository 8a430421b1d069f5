#include "Classical/Core/RayBatch.h"

#include <array>
#include <numeric>
#include <utility>

#include "Common/Core/Parallel.h"

namespace lambert {

namespace {

constexpr int kBinsPerAxis = 8;

/// A bin of the octahedral map of directions (Cigolle et al. 2014).
uint8_t DirectionBin(const Vec3f& d) {
  const float sum = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
  float u = d.x / sum, v = d.y / sum;
  if (d.z < 0) {
    const float folded = (1 - std::abs(v)) * std::copysign(1.f, u);
    v = (1 - std::abs(u)) * std::copysign(1.f, v);
    u = folded;
  }
  const auto bin = [](float x) {
    return std::min(kBinsPerAxis - 1, std::max(0, int((x + 1) * (0.5f * kBinsPerAxis))));
  };
  return uint8_t(bin(u) * kBinsPerAxis + bin(v));
}

/// Spreads the low 20 bits of `x` three apart.
uint64_t SpreadBits(uint64_t x) {
  x &= 0xfffff;
  x = (x | x << 32) & 0x001f00000000ffffull;
  x = (x | x << 16) & 0x001f0000ff0000ffull;
  x = (x | x << 8) & 0x100f00f00f00f00full;
  x = (x | x << 4) & 0x10c30c30c30c30c3ull;
  return (x | x << 2) & 0x1249249249249249ull;
}

}  // namespace

void RayBatch::Trace(const RayScene& scene) {
  // Bins of directions; the order within a bin stays, so that neighbours stay neighbours.
  std::array<int32_t, kBinsPerAxis * kBinsPerAxis + 1> begin{};
  bins_.resize(rays_.size());
  for (size_t i = 0; i < rays_.size(); ++i) {
    bins_[i] = DirectionBin(rays_[i].direction);
    ++begin[size_t(bins_[i]) + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  order_.resize(rays_.size());
  for (size_t i = 0; i < rays_.size(); ++i) {
    order_[size_t(begin[size_t(bins_[i])]++)] = int32_t(i);
  }

  hits_.resize(rays_.size());
  for (const int32_t i : order_) {
    hits_[size_t(i)] = scene.Closest(rays_[size_t(i)].from, rays_[size_t(i)].direction);
  }
}

std::vector<int32_t> CoherentOrder(const std::vector<Vec3f>& positions,
                                   const std::vector<Vec3f>& normals) {
  Box3f bounds;
  for (const Vec3f& p : positions) bounds.Include(p);
  const Vec3f extent = bounds.Extent();
  const float largest = std::max(extent.x, std::max(extent.y, extent.z));
  const float scale = largest > 0 ? float(1 << 17) / largest : 0;
  std::vector<std::pair<uint64_t, int32_t>> keyed(positions.size());
  ParallelForEach(int64_t(positions.size()), 4096, [&](int64_t i) {
    const Vec3f p = (positions[size_t(i)] - bounds.low) * scale;
    const Vec3f& n = normals[size_t(i)];
    // The octant counts within a cube of a 64th of the scene.
    const uint64_t octant = uint64_t(n.x < 0) | uint64_t(n.y < 0) << 1 | uint64_t(n.z < 0) << 2;
    const uint64_t morton =
        SpreadBits(uint64_t(p.x)) | SpreadBits(uint64_t(p.y)) << 1 | SpreadBits(uint64_t(p.z)) << 2;
    constexpr int kFineBits = 33;
    const uint64_t fine = morton & ((uint64_t(1) << kFineBits) - 1);
    keyed[size_t(i)] = {(morton >> kFineBits << 3 | octant) << kFineBits | fine, int32_t(i)};
  });
  std::sort(keyed.begin(), keyed.end());
  std::vector<int32_t> order(positions.size());
  for (size_t i = 0; i < keyed.size(); ++i) order[i] = keyed[i].second;
  return order;
}

}  // namespace lambert
