// Where charts lie on the pages of an atlas: each falls onto what lies there already, outline onto
// outline (levy2002); small ones fill the holes that large ones leave.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lambert {

/// The texels that a chart takes, padding and all.
class ChartMask {
 public:
  ChartMask() = default;
  /// None taken; width and height in texels, [1, inf).
  ChartMask(int width, int height);

  int Width() const { return width_; }
  int Height() const { return height_; }
  bool IsTaken(int x, int y) const { return bits_[this->Word(x, y)] >> (y % 64) & 1; }
  /// Texels [low, high) of a column.
  void Take(int x, int low, int high);
  /// Turned left by a quarter.
  ChartMask Turned() const;

 private:
  size_t Word(int x, int y) const { return size_t(x) * size_t(words_) + size_t(y / 64); }

  int width_ = 0, height_ = 0;
  int words_ = 0;  ///< a column
  std::vector<uint64_t> bits_;
};

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
Packing PackCharts(const std::vector<ChartMask>& charts, int pageSize,
                   PackingOrder order = PackingOrder::Longest);

}  // namespace lambert
