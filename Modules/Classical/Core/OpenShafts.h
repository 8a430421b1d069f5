// Between which groups of points does certainly nothing stand? There no ray need be cast
// (Haines and Wallace 1991).
#pragma once

#include <cstdint>
#include <vector>

#include "Common/Core/TriangleMesh.h"

namespace lambert {

class OpenShafts {
 public:
  /// Keeps a reference to `mesh`. Faces nearer than `tolerance` (m) to a group's points do not
  /// block, as for rays. Where groups times faces exceed 2^28 nothing is found open.
  OpenShafts(const TriangleMesh& mesh, float tolerance,
             const std::vector<std::vector<Vec3f>>& groups);

  /// True where no face can stand between a point of the convex hull of group a and one of b.
  /// Never wrongly true but for what the tolerance hides.
  bool IsOpen(int32_t a, int32_t b) const;

 private:
  /// Bits of sides_: all points of a group lie on or above the plane of a face, or on or below it.
  enum : uint8_t { kAbove = 1, kBelow = 2 };

  void ClassifyFaces(const std::vector<Vec3f>& points, float tolerance, uint8_t* sides) const;
  bool MayBlock(size_t face, const std::vector<std::array<float, 4>>& planes) const;

  const TriangleMesh& mesh_;
  std::vector<Box3f> bounds_;   ///< per group
  std::vector<uint8_t> sides_;  ///< per group and face; rows of rowLength_ bytes
  size_t rowLength_ = 0;        ///< faces, filled up to a multiple of 8
};

}  // namespace lambert
