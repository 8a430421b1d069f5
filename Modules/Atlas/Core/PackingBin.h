// A rectangle of a page that charts fall into, onto what lies there already.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "Atlas/Core/ChartPacking.h"

namespace lambert {

/// Where a chart comes to lie in a bin, after `turns` quarter turns to the left; x < 0: nowhere.
struct PackingSpot {
  int x = -1, y = 0, turns = 0;
  /// Texels to its top, and on the average below it that stay empty, by PackingWay::waste.
  double cost = std::numeric_limits<double>::max();
};

class PackingBin {
 public:
  /// Its lower left corner on the page, and its size; texels. `waste` as PackingWay::waste.
  PackingBin(int x, int y, int width, int height, double waste)
      : x_(x),
        y_(y),
        height_(height),
        waste_(waste),
        top_(size_t(width), 0),
        topSum_(size_t(width) + 1, 0) {}

  /// The cheapest spot in the bin, at less than `cost`, of those that take a column of [from, to).
  PackingSpot Find(const TurnedChart& chart, double cost, int from, int to) const;
  PackingSpot Find(const TurnedChart& chart, double cost) const {
    return this->Find(chart, cost, 0, this->Width());
  }
  /// Returns the texels that stay empty within and below it.
  int64_t Put(const ChartShape& chart, const PackingSpot& spot);

  int Left() const { return x_; }
  int Low() const { return y_; }
  int Width() const { return int(top_.size()); }
  int Top(int x) const { return top_[size_t(x)]; }
  int HighestTop() const;

 private:
  int x_, y_, height_, least_ = 0;
  double waste_;
  std::vector<int16_t> top_;
  std::vector<int32_t> topSum_;  ///< of the columns before each
};

}  // namespace lambert
