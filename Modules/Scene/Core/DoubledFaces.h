// Doubled faces, as CAD has them where the two sides of a sheet differ: the same three corners
// twice, wound opposite ways, each with a material of its own.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "Common/Core/TriangleMesh.h"

namespace lambert {

/// Of such a pair light sees the fronts: each lies on the back of the other. The front is the
/// file's winding, as it is for emission.
class DoubledFaces {
 public:
  /// Pairs of equal corners, to the bit, neither of which emits from the side that is hidden.
  explicit DoubledFaces(const TriangleMesh& mesh);

  bool IsEmpty() const { return twins_.empty(); }
  /// Whether that side of a face lies under the front of its twin.
  bool IsHidden(int64_t face, Side side) const {
    return !twins_.empty() && twins_[size_t(face)].face >= 0 && twins_[size_t(face)].hidden == side;
  }
  /// Whether its twin is wound the other way as they are stored.
  bool IsReversed(int64_t face) const { return twins_[size_t(face)].isReversed; }
  /// A place on a face: weights of its corners 1 and 2.
  struct Place {
    int32_t face;
    Vec2f barycentric;
  };
  /// The twin's place of one on a hidden side.
  Place OnTwin(const Place& hidden) const;

 private:
  struct Twin {
    int32_t face = -1;  ///< -1: none
    Side hidden = kBack;
    bool isReversed = true;
    std::array<uint8_t, 3> corner{};  ///< of the twin, where the face has its corners 0 to 2
  };
  std::vector<Twin> twins_;  ///< per face; empty where there are none
};

}  // namespace lambert
