// Which leaf of a hierarchy lies at a place on a side of a face.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "Common/Core/TriangleMesh.h"
#include "Common/Core/Vector.h"
#include "Radiosity/Core/ElementHierarchy.h"

namespace lambert {

/// Of the leaves as they are at construction. Safe to use from several threads.
class LeafLookup {
 public:
  explicit LeafLookup(const ElementHierarchy& hierarchy);

  /// The leaf; -1 where none does.
  int32_t Find(int64_t face, Side side, const Vec3f& position) const;

 private:
  /// A triangle or patch as a part of what was cut: it lies where the plane is not negative, its
  /// earlier siblings on the other side.
  struct Part {
    Vec3f normal;
    float offset = 0;
    int32_t child = -1, childCount = 0;  ///< its own parts; -1: it was not cut
  };
  void FindParts(const ElementHierarchy& hierarchy, int32_t index);

  /// By side: the element that holds the face, a leaf or a triangle; -1 where none does.
  std::array<std::vector<int32_t>, 2> elementOfFace_;
  std::vector<Part> parts_;  ///< by element, of triangles and patches
};

}  // namespace lambert
