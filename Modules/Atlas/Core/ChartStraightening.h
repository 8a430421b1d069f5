// Straight borders between charts: one that leaves much of its rectangle empty is cut apart along a
// line; two neighbours that do are laid side by side and cut anew.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "Atlas/Core/ChartJoining.h"

namespace lambert {

/// On which side of a line faces in the plane lie.
struct StraightCut {
  std::vector<uint8_t> side;  ///< by face, 0 or 1; empty where no line will do
  double rectangles = 0;      ///< m2, of those about both sides that lie along the line
};

/// The line whose two rectangles are smallest, of 16 directions, under `most` m2, with a 20th of
/// the area at least on either side. Corners of the faces, m.
StraightCut BestStraightCut(const std::vector<std::array<Vec2d, 3>>& faces,
                            double most = std::numeric_limits<double>::max());

/// A face with two neighbours beyond the line goes over to them. `neighbours` by corner, three a
/// face: the face beyond its edge, -1 where there is none.
void RemoveTeeth(const std::vector<int32_t>& neighbours, std::vector<uint8_t>* side);
/// Either side keeps its largest piece; its other pieces go over.
void KeepLargestPieces(const std::vector<int32_t>& neighbours, std::vector<uint8_t>* side);

/// The faces of two charts as they lie side by side, on the two sides of their best line,
/// ascending, each in one piece; none where the rectangles are not under `mostRectangles`, m2.
/// `neighbours` as FindNeighbours gives them.
std::array<std::vector<int32_t>, 2> CutAnew(const std::vector<int32_t>& neighbours,
                                            const SideBySide& charts, double mostRectangles);

/// What StraightenBorders asks of the charts.
struct StraightenedCharts {
  std::function<std::vector<ChartBorder>()> borders;  ///< as they are now
  std::function<double(int32_t chart)> empty;         ///< m2, of its rectangle
  /// Tells which of the pairs were cut anew, into the same two numbers.
  std::function<std::vector<uint8_t>(const std::vector<std::array<int32_t, 2>>& pairs)> tryToCut;
};

/// Offers neighbours, those that leave most empty first, no chart twice at a time, until none is
/// left that was not tried as it is.
void StraightenBorders(const StraightenedCharts& charts);

}  // namespace lambert
