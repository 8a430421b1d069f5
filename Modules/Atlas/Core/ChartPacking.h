// Where charts lie on the pages of an atlas: each falls onto what lies there already, outline onto
// outline (levy2002); small ones fill the holes that large ones leave.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "Atlas/Core/ChartMask.h"

namespace lambert {

/// A chart laid one of four ways, and what it takes of each column.
struct ChartShape {
  ChartMask mask;
  /// By column: the texels [low, high) that its outline spans; pages are short enough for 16 bits.
  std::vector<int16_t> low, high;
  int mostLow = 0;               ///< of `low`
  int64_t lowSum = 0, area = 0;  ///< of `low`; texels taken

  ChartShape() = default;
  explicit ChartShape(ChartMask mask);
  int Width() const { return mask.Width(); }
  int Height() const { return mask.Height(); }
};
/// After none, one, two and three quarter turns to the left.
using TurnedChart = std::array<ChartShape, 4>;
TurnedChart TurnFourWays(ChartMask mask);

/// Where a chart lies: its mask, after `turns` quarter turns to the left, with its lower left
/// corner at (x, y) of a page.
struct ChartPlace {
  int page = 0, x = 0, y = 0, turns = 0;
};

struct Packing {
  std::vector<ChartPlace> places;  ///< by chart
  int pages = 0;
  int lastHeight = 0;       ///< texels of the last page that are taken, from below
  int64_t takenTexels = 0;  ///< by all charts
};

/// Which charts come first.
enum class PackingOrder : uint8_t { Longest, Widest, LargestPerimeter, LargestArea };
constexpr PackingOrder kPackingOrders[] = {PackingOrder::Longest, PackingOrder::Widest,
                                           PackingOrder::LargestPerimeter,
                                           PackingOrder::LargestArea};

/// Charts on pages of `pageSize` x `pageSize` texels; as many pages as it takes.
/// Throws Error for a chart that is larger than a page.
Packing PackCharts(const std::vector<TurnedChart>& charts, int pageSize,
                   PackingOrder order = PackingOrder::Longest);

}  // namespace lambert
