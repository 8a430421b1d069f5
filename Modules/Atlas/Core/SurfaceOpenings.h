// How open the pieces are that surfaces lie on: where light comes to their other side.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "Common/Core/TriangleMesh.h"

namespace lambert {

/// Of a connected piece, whatever its materials; positions alone connect.
struct SurfaceOpening {
  double holes = 0;  ///< areas that its border lines span, in parts of its own area
  /// Half of all other area lies within its bounds: what is outside shows less than it costs.
  bool isRoom = false;
  /// The side, kFront or kBack, that no light reaches: the inside of a closed piece that takes up
  /// a hundredth of the scene at most, with no emitting face within its bounds. Rooms are larger,
  /// and lights may stand in them that are no faces.
  std::optional<uint8_t> enclosedSide;
};

/// By surface of `mesh`; of one on several pieces, that of its first face.
std::vector<SurfaceOpening> FindOpenings(const TriangleMesh& mesh);

}  // namespace lambert
