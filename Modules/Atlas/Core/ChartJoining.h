// Which charts become one: neighbours along smooth borders, those with the longest first.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "Common/Core/TriangleMesh.h"
#include "Common/Core/Vector.h"

namespace lambert {

/// Where two charts meet, a < b, in edges whose points their faces share: no crease lies there.
struct ChartBorder {
  int32_t a = 0, b = 0;
  double length = 0;  ///< m
};
/// By a and b; `neighbours` as FindNeighbours gives them.
std::vector<ChartBorder> SmoothBorders(const TriangleMesh& mesh,
                                       const std::vector<int32_t>& neighbours,
                                       const std::vector<int32_t>& chartOfFace);

/// The edges in which two charts meet, as corners of the faces of the first: those of the longest
/// line of them, and those of the others.
struct CommonLines {
  std::vector<int32_t> longest, others;
};
CommonLines LinesBetween(const TriangleMesh& mesh, const std::vector<int32_t>& neighbours,
                         const std::vector<int32_t>& faces, const std::vector<int32_t>& beyond);

/// Two charts as they are, the second turned and moved so that they meet best along a line.
struct SideBySide {
  std::vector<int32_t> faces;                ///< of the first, then of the second
  std::vector<std::array<Vec2d, 3>> places;  ///< of their corners, m
};
/// `line`: edges in which the first meets the second, as LinesBetween gives them; `places` by face
/// of the mesh.
SideBySide LaySideBySide(const std::array<const std::vector<int32_t>*, 2>& charts,
                         const std::vector<std::array<Vec2f, 3>>& places,
                         const std::vector<int32_t>& neighbours, const std::vector<int32_t>& line);

/// Tells which of the pairs have become one; chart a then stands for both.
using TryToJoin =
    std::function<std::vector<uint8_t>(const std::vector<std::array<int32_t, 2>>& pairs)>;

/// Offers pairs that are each other's neighbour along the longest border, no chart twice at a time,
/// until none is left that was not tried. Does not depend on the order of the borders.
void JoinAlongBorders(std::vector<ChartBorder> borders, const TryToJoin& tryToJoin);

}  // namespace lambert
