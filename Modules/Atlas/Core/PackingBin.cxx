#include "Atlas/Core/PackingBin.h"

#include <algorithm>
#include <cmath>

namespace lambert {

namespace {

/// Columns whose highest top is looked for at once.
constexpr int kColumns = 64;

/// Looks for spots of a chart, as it lies, over the tops of columns and their sums.
class Search {
 public:
  Search(const ChartShape& chart, const std::vector<int16_t>& top,
         const std::vector<int32_t>& topSum, int height, double waste)
      : width_(chart.Width()),
        chart_(chart),
        top_(top),
        topSum_(topSum),
        height_(height),
        waste_(waste),
        perColumn_(1. / chart.Width()) {}

  /// Of those that begin in columns [from, to), where any costs less than `best`.
  void Run(int from, int to, int least, PackingSpot* best) {
    this->Limit(best->cost);
    if (highest_ < 0 || least - chart_.mostLow > highest_) return;
    int known = from;  // Columns up to this one let it lie low enough.
    for (int x = from; x < std::min(to, int(top_.size()) - width_ + 1); ++x) {
      if (topSum_[size_t(x) + size_t(width_)] - topSum_[size_t(x)] >= mostSum_) continue;
      // Past the last column that holds it too high wherever it crosses it.
      int last = -1;
      for (known = std::max(x, known); known < x + width_; ++known) {
        if (top_[size_t(known)] - chart_.mostLow > highest_) last = known;
      }
      if (last >= 0) {
        x = last;
        continue;
      }
      const PackingSpot found = this->Fall(x);
      if (found.x < 0) continue;
      *best = found;
      this->Limit(found.cost);
    }
  }

 private:
  /// Where spots that cost so much or more are left out.
  void Limit(double cost) {
    cost_ = std::min(cost, (2 + waste_) * height_);
    highest_ = std::min(height_, int(std::ceil(cost_)) - 1) - chart_.Height();
    mostSum_ = chart_.lowSum + int32_t(std::ceil((cost_ - chart_.Height()) * width_));
  }

  /// As low as it falls from a column on; nowhere, where that is beyond the limits.
  PackingSpot Fall(int x) const {
    const int16_t *top = top_.data() + x, *low = chart_.low.data();
    const int32_t sum = topSum_[size_t(x) + size_t(width_)] - topSum_[size_t(x)];
    const double gaps = double(chart_.lowSum - sum) * perColumn_;
    const auto costAt = [&](int y) { return y + chart_.Height() + waste_ * (y + gaps); };
    // Onto its feet first.
    int y = 0;
    for (const int16_t foot : chart_.feet) y = std::max(y, top[foot] - low[foot]);
    for (int begin = 0; y <= highest_ && costAt(y) < cost_; begin += kColumns) {
      if (begin >= width_) return {x, y, 0, costAt(y)};
      int16_t most = 0;
      for (int i = begin; i < std::min(width_, begin + kColumns); ++i) {
        most = std::max(most, int16_t(top[i] - low[i]));
      }
      y = std::max(y, int(most));
    }
    return {};
  }

  const int width_;
  const ChartShape& chart_;
  const std::vector<int16_t>& top_;
  const std::vector<int32_t>& topSum_;
  const int height_;
  const double waste_;
  const double perColumn_;
  double cost_ = 0;
  int highest_ = 0;      ///< that it may lie
  int32_t mostSum_ = 0;  ///< of the tops below it, under which it has to stay
};

}  // namespace

PackingSpot PackingBin::Find(const TurnedChart& chart, double cost, int from, int to) const {
  PackingSpot best;
  best.cost = cost;
  for (int turns = 0; turns < 4; ++turns) {
    const ChartShape& shape = chart[size_t(turns)];
    const double before = best.cost;
    Search(shape, top_, topSum_, height_, waste_)
        .Run(std::max(0, from - shape.Width() + 1), to, least_, &best);
    if (best.cost < before) best.turns = turns;
  }
  return best;
}

int64_t PackingBin::Put(const ChartShape& chart, const PackingSpot& spot) {
  int64_t empty = -chart.area;
  for (int i = 0; i < chart.Width(); ++i) {
    int16_t& top = top_[size_t(spot.x) + size_t(i)];
    const int high = spot.y + chart.high[size_t(i)];
    if (high <= top) continue;
    empty += high - top;
    top = int16_t(high);
  }
  for (size_t i = size_t(spot.x); i < top_.size(); ++i) topSum_[i + 1] = topSum_[i] + top_[i];
  least_ = *std::min_element(top_.begin(), top_.end());
  return empty;
}

int PackingBin::HighestTop() const { return *std::max_element(top_.begin(), top_.end()); }

}  // namespace lambert
