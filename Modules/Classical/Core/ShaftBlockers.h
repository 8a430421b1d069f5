// Which faces may stand between two groups of points (haines1991)? Where none does, no
// ray need be cast; where few do, rays need be tried against those alone.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "Common/Core/TriangleMesh.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

class ShaftBlockers {
 public:
  /// Keeps a reference to `mesh`. Hits nearer than `tolerance` (m) to an end do not block, as for
  /// rays. Where groups times faces exceed 2^28 every shaft counts as crowded.
  ShaftBlockers(const TriangleMesh& mesh, float tolerance,
                const std::vector<std::vector<Vec3f>>& groups);

  /// More faces than this are a crowd.
  static constexpr int kCrowd = 8;
  struct Faces {
    int count = 0;  ///< kCrowd + 1: a crowd, left to the hierarchy of a RayScene
    std::array<int32_t, kCrowd + 1> face;

    bool IsOpen() const { return count == 0; }
    bool IsCrowd() const { return count > kCrowd; }
  };

  /// The faces that may stand between a point of the convex hull of group a and one of b. None is
  /// missed but what the tolerance hides.
  Faces Between(int32_t a, int32_t b) const;

  /// True where one of `faces`, which are no crowd, blocks the segment.
  bool IsBlocked(const Faces& faces, const Segment& segment) const;

 private:
  /// Bits of sides_: all points of a group lie on or above the plane of a face, or on or below it.
  enum : uint8_t { kAbove = 1, kBelow = 2 };
  /// A face, ready to be tried: its plane, and affine maps to its barycentric coordinates.
  struct Blocker {
    Vec3f normal, toU, toV;
    float offset = 0, u0 = 0, v0 = 0;
  };

  Blocker MakeBlocker(int64_t face) const;
  void ClassifyFaces(const std::vector<Vec3f>& points, uint8_t* sides) const;
  bool MayBlock(size_t face, const std::vector<std::array<float, 4>>& planes) const;

  const TriangleMesh& mesh_;
  const float tolerance_;
  std::vector<Blocker> blockers_;  ///< per face
  std::vector<Box3f> bounds_;      ///< per group
  std::vector<uint8_t> sides_;     ///< per group and face; rows of rowLength_ bytes
  size_t rowLength_ = 0;           ///< faces, filled up to a multiple of 8
};

}  // namespace lambert
