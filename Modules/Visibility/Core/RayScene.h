// Rays against the scene: the only place that knows Embree.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "Common/Core/TriangleMesh.h"

namespace lambert {

/// One visibility question: is there anything strictly between two points?
struct Segment {
  Vec3f from, to;
};

/// Where rays leave a surface.
struct RayStart {
  Vec3f position;
  Vec3f normal;  ///< unit, geometric, of the side that they leave
};

struct RayHit {
  int32_t face = -1;   ///< -1: nothing
  float distance = 0;  ///< along the unit direction, m
  Vec2f barycentric;   ///< weights of corners 1 and 2
  Vec3f front;         ///< normal of the face's front, unit; zero of a face without area
};

/// A bounding volume hierarchy over all faces of a mesh; both sides of a face block.
class RayScene {
 public:
  /// The triangles of the mesh have to stay where they are.
  explicit RayScene(const TriangleMesh& mesh);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  /// Length that rays skip at both ends: 1e-5 of the scene diagonal.
  float Epsilon() const;
  float Diagonal() const;

  /// occluded[i] = 1 where segment i is blocked. Hits nearer than Epsilon() to either end do not
  /// block. Safe to call from several threads.
  void Occluded(const Segment* segments, int count, uint8_t* occluded) const;
  bool Occluded(const Vec3f& from, const Vec3f& to) const;
  /// The same up to `distance` (m, may be infinite) in a unit direction.
  bool Occluded(const Vec3f& from, const Vec3f& unitDirection, float distance) const;
  /// True where a ray to infinity is blocked.
  bool OccludedDirection(const Vec3f& from, const Vec3f& direction) const;
  /// The closest hit beyond Epsilon().
  RayHit Closest(const Vec3f& from, const Vec3f& unitDirection) const;

  /// The same of rays that leave a surface: nearer than Epsilon() they pass what lies upon it,
  /// within 8 degrees of parallel, alone. A wall that rises from it blocks however near it is, or
  /// light would leak along edges, and fill closed things that are not much larger.
  bool Occluded(const RayStart& from, const Vec3f& to) const;
  bool Occluded(const RayStart& from, const Vec3f& unitDirection, float distance) const;
  RayHit Closest(const RayStart& from, const Vec3f& unitDirection) const;
  /// Whether anything at all is nearer than Epsilon(); also what the others pass.
  bool OccludedNear(const RayStart& from, const Vec3f& unitDirection) const;
  /// Faces whose bounds come within `radius` (m) of a point, in ascending order.
  std::vector<int32_t> FacesNear(const Vec3f& point, float radius) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace lambert
