#include "Atlas/Core/ChartPacking.h"

#include <algorithm>
#include <bitset>
#include <limits>
#include <numeric>
#include <tuple>

#include "Atlas/Core/PackingPage.h"
#include "Common/Core/Error.h"

namespace lambert {

namespace {

/// A chart may lie dearer than another by so many times what its shorter side is longer: what is
/// large comes first.
constexpr double kSize = 2;
/// Of its shorter side: by how much dearer spots of a chart than those that it might win with are
/// looked for at once.
constexpr double kAhead = 0.5;

int LowestBit(uint64_t word) { return __builtin_ctzll(word); }
/// Zeros above the highest bit.
int ZerosAbove(uint64_t word) { return __builtin_clzll(word); }

/// A chart that may come next, and the cheapest spot for it on top of a page, as far as is known.
struct Prospect {
  int32_t chart = 0;
  double size = 0;         ///< texels, of its shorter side
  bool isForHoles = true;  ///< not tried there yet
  PackingSpot spot;
  double least = 0;  ///< that all other spots cost

  bool IsKnown() const { return spot.x >= 0 && spot.cost <= least; }
  /// The spot, or what is known of it; the least wins.
  double Score() const { return std::min(spot.cost, least) - kSize * size; }
};

/// A page that is filled with the first of some charts that are left, always with the one that
/// suits it best.
class PageFilling {
 public:
  PageFilling(const std::vector<TurnedChart>& charts, int pageSize, const PackingWay& way,
              std::vector<ChartPlace>* places)
      : charts_(charts), page_(pageSize, way.waste), window_(size_t(way.window)), places_(places) {}

  /// Returns the charts that find no room.
  std::vector<int32_t> Fill(const std::vector<int32_t>& order) {
    size_t next = 0;
    for (;;) {
      while (open_.size() < window_ && next < order.size()) this->Offer(order[next++]);
      if (page_.RenewHoles()) {
        for (Prospect& prospect : open_) prospect.isForHoles = true;
      }
      if (this->FillHoles()) continue;
      Prospect* best = this->Best();
      if (!best) break;
      const PackingSpot spot = page_.PutOnTop(this->Chart(*best), best->spot, this->PlaceOf(*best));
      const int end = spot.x + this->Chart(*best)[size_t(spot.turns)].Width();
      open_.erase(open_.begin() + (best - open_.data()));
      for (Prospect& prospect : open_) this->Renew(&prospect, spot.x, end);
    }
    std::vector<int32_t> left;
    for (const Prospect& prospect : open_) left.push_back(prospect.chart);
    left.insert(left.end(), order.begin() + std::ptrdiff_t(next), order.end());
    return left;
  }

  int Height() const { return page_.Top().HighestTop(); }

 private:
  const TurnedChart& Chart(const Prospect& prospect) const {
    return charts_[size_t(prospect.chart)];
  }
  ChartPlace* PlaceOf(const Prospect& prospect) { return &(*places_)[size_t(prospect.chart)]; }

  void Offer(int32_t chart) {
    const ChartShape& shape = charts_[size_t(chart)][0];
    Prospect prospect;
    prospect.chart = chart;
    prospect.size = std::min(shape.Width(), shape.Height());
    open_.push_back(prospect);
  }

  /// Tells whether any chart went into a hole.
  bool FillHoles() {
    std::vector<Prospect> left;
    for (Prospect& prospect : open_) {
      const bool isForHoles = prospect.isForHoles;
      prospect.isForHoles = false;
      if (isForHoles && page_.PutIntoHole(this->Chart(prospect), this->PlaceOf(prospect))) continue;
      left.push_back(prospect);
    }
    const bool isAnyGone = left.size() < open_.size();
    open_ = std::move(left);
    return isAnyGone;
  }

  /// Null where none finds room.
  Prospect* Best() {
    Prospect* best = nullptr;
    const auto isBetter = [&](const Prospect& prospect) {
      return !best || prospect.Score() < best->Score();
    };
    for (Prospect& prospect : open_) {
      if (prospect.IsKnown() && isBetter(prospect)) best = &prospect;
    }
    for (Prospect& prospect : open_) {
      if (prospect.IsKnown() || !isBetter(prospect)) continue;
      // Only spots with which it might win, and some beyond for when others are gone.
      prospect.least = best ? best->Score() + (kSize + kAhead) * prospect.size
                            : std::numeric_limits<double>::max();
      prospect.spot = page_.Top().Find(this->Chart(prospect), prospect.least);
      if (prospect.IsKnown() && isBetter(prospect)) best = &prospect;
    }
    return best;
  }

  /// After columns [from, to) have risen.
  void Renew(Prospect* prospect, int from, int to) const {
    PackingSpot& spot = prospect->spot;
    const TurnedChart& chart = this->Chart(*prospect);
    if (spot.x >= 0 && spot.x < to && spot.x + chart[size_t(spot.turns)].Width() > from) {
      prospect->least = std::min(prospect->least, spot.cost);
      spot = {};
    }
    const double cost = std::min(spot.x < 0 ? prospect->least : spot.cost, prospect->least);
    const PackingSpot found = page_.Top().Find(chart, cost, from, to);
    if (found.x >= 0) spot = found;
  }

  const std::vector<TurnedChart>& charts_;
  PackingPage page_;
  size_t window_;
  std::vector<ChartPlace>* places_;
  std::vector<Prospect> open_;
};

}  // namespace

ChartShape::ChartShape(ChartMask mask_) : mask(std::move(mask_)) {
  const int words = mask.WordsOfColumn();
  for (int x = 0; x < mask.Width(); ++x) {
    const uint64_t* column = mask.Column(x);
    int first = 0, last = words;
    while (first < last && column[first] == 0) ++first;
    while (last > first && column[last - 1] == 0) --last;
    const bool isEmpty = first == last;
    low.push_back(int16_t(isEmpty ? mask.Height() : 64 * first + LowestBit(column[first])));
    high.push_back(isEmpty ? low.back() : int16_t(64 * last - ZerosAbove(column[last - 1])));
    mostLow = std::max(mostLow, int(low.back()));
    lowSum += low.back();
    for (int w = first; w < last; ++w) area += int32_t(std::bitset<64>(column[w]).count());
  }
  for (size_t i = 0; i < feet.size(); ++i) {
    const auto at = [&](size_t part) {
      return low.begin() + std::ptrdiff_t(part * low.size() / 8);
    };
    const auto end = std::max(at(i + 1), at(i) + 1);
    feet[i] = int16_t(std::min_element(at(i), end) - low.begin());
  }
}

TurnedChart TurnFourWays(ChartMask mask) {
  TurnedChart turned;
  turned[0] = ChartShape(std::move(mask));
  for (size_t t = 1; t < 4; ++t) turned[t] = ChartShape(turned[t - 1].mask.Turned());
  return turned;
}

Packing PackCharts(const std::vector<TurnedChart>& charts, int pageSize, const PackingWay& way) {
  for (const TurnedChart& ways : charts) {
    const ChartShape& chart = ways[0];
    if (std::max(chart.Height(), chart.Width()) <= pageSize) continue;
    throw Error("A chart of " + std::to_string(chart.Width()) + " x " +
                std::to_string(chart.Height()) + " texels does not fit on a page of " +
                std::to_string(pageSize) + "; take larger pages or larger texels.");
  }

  // The largest first, as the order tells; of equal ones the longest.
  const auto rank = [&](int32_t i) {
    const ChartShape& chart = charts[size_t(i)][0];
    const int64_t width = chart.Width(), height = chart.Height();
    int64_t first = 0;
    switch (way.order) {
      case PackingOrder::Longest:
        break;
      case PackingOrder::Widest:
        first = std::min(width, height);
        break;
      case PackingOrder::LargestPerimeter:
        first = width + height;
        break;
      case PackingOrder::LargestArea:
        first = chart.area;
        break;
    }
    return std::make_tuple(-first, -std::max(width, height), -std::min(width, height), i);
  };
  std::vector<int32_t> order(charts.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int32_t a, int32_t b) { return rank(a) < rank(b); });

  // Page after page; what does not fit waits for the next.
  Packing packing;
  packing.places.resize(charts.size());
  for (const TurnedChart& ways : charts) packing.takenTexels += ways[0].area;
  while (!order.empty()) {
    for (const int32_t i : order) packing.places[size_t(i)].page = packing.pages;
    PageFilling filling(charts, pageSize, way, &packing.places);
    order = filling.Fill(order);
    ++packing.pages;
    packing.lastHeight = filling.Height();
  }
  return packing;
}

}  // namespace lambert
