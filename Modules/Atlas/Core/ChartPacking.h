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
  std::array<int16_t, 8> feet{};  ///< the lowest column of each eighth
  int mostLow = 0;                ///< of `low`
  int64_t lowSum = 0, area = 0;   ///< of `low`; texels taken

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
/// How charts are packed.
struct PackingWay {
  PackingOrder order = PackingOrder::Longest;
  /// Of so many that come next, [1, inf), the one is put first that lies cheapest; large ones may
  /// lie a little dearer.
  int window = 1;
  /// Texels that a chart leaves empty below it count this much beside those that its top rises.
  double waste = 0.5;
};

/// Charts on pages of `pageSize` x `pageSize` texels; as many pages as it takes.
/// Throws Error for a chart that is larger than a page.
Packing PackCharts(const std::vector<TurnedChart>& charts, int pageSize,
                   const PackingWay& way = {});

}  // namespace lambert
