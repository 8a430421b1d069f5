// Rays that are traced together, those of like direction one after the other: neighbours in a
// scene meet the same branches of its hierarchy, which is half the cost of a ray.
#pragma once

#include <cstdint>
#include <vector>

#include "Visibility/Core/RayScene.h"

namespace lambert {

class RayBatch {
 public:
  void Clear() { rays_.clear(); }
  /// `direction` is a unit vector.
  void Add(const Vec3f& from, const Vec3f& direction) { rays_.push_back({from, direction}); }
  int32_t Size() const { return int32_t(rays_.size()); }
  const Vec3f& From(int32_t ray) const { return rays_[size_t(ray)].from; }
  const Vec3f& Direction(int32_t ray) const { return rays_[size_t(ray)].direction; }

  /// Finds the closest hit of every ray.
  void Trace(const RayScene& scene);
  const RayHit& Hit(int32_t ray) const { return hits_[size_t(ray)]; }
  /// Where the ray met a face, m.
  Vec3f HitPosition(int32_t ray) const {
    return From(ray) + Direction(ray) * hits_[size_t(ray)].distance;
  }

 private:
  struct Ray {
    Vec3f from, direction;
  };
  std::vector<Ray> rays_;
  std::vector<RayHit> hits_;
  std::vector<uint8_t> bins_;
  std::vector<int32_t> order_;
};

/// The order in which places next to each other that face alike follow one another: along a
/// space-filling curve (Morton 1966), the eight octants of normals apart.
std::vector<int32_t> CoherentOrder(const std::vector<Vec3f>& positions,
                                   const std::vector<Vec3f>& normals);

}  // namespace lambert
