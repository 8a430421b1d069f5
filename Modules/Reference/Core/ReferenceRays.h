// The reference's own rays, on Embree, apart from those of the methods.
#pragma once

#include <memory>

#include "Common/Core/TriangleMesh.h"

namespace lambert {

/// A place that light arrives at: a receiver, or a bounce on one side of a face.
struct ReferenceVertex {
  Vec3f position;
  Vec3f normal;     ///< the irradiance is for this one
  Vec3f geometric;  ///< only directions of its hemisphere see light
};

/// What a ray hit.
struct ReferenceHit {
  int32_t face = -1;
  Side side = kFront;
  float distance = 0;      ///< m
  ReferenceVertex vertex;  ///< on the side that was hit, with its geometric normal
};

/// Rays against all faces, both sides of which block; but not those that lie upon the start: nearer
/// than 1e-5 of the scene diagonal, and within 8 degrees of parallel to its geometric plane.
class ReferenceRays {
 public:
  /// Keeps a reference to `mesh`. Throws Error where Embree cannot be started.
  explicit ReferenceRays(const TriangleMesh& mesh);
  ~ReferenceRays();

  float Nearest() const;
  /// True where something stands between `at` and the place at `distance` (m, may be infinite) in a
  /// unit direction.
  bool Blocked(const ReferenceVertex& at, const Vec3f& direction, float distance) const;
  /// False where the ray escapes.
  bool Closest(const ReferenceVertex& at, const Vec3f& direction, ReferenceHit* hit) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Denormal numbers count as zero while this lives; rays are several times slower over them.
class FlushDenormals {
 public:
  FlushDenormals();
  ~FlushDenormals();

 private:
  unsigned state_;
};

}  // namespace lambert
