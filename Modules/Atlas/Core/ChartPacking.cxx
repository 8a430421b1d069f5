#include "Atlas/Core/ChartPacking.h"

#include <algorithm>
#include <bitset>
#include <limits>
#include <numeric>
#include <tuple>

#include "Common/Core/Error.h"

namespace lambert {

namespace {

/// Texels that a chart leaves empty below it count this much beside those that its top rises.
constexpr double kWaste = 0.5;
/// Holes are looked for whenever charts have left this part of a page empty within or below them.
constexpr double kEmptyPart = 1. / 64;
/// Holes are rectangles of cells: so many texels along a cell, or more, that so many are along a
/// page at most.
constexpr int kCell = 4, kMostCells = 512;
/// At most so many holes, found in so many passes, the largest first.
constexpr int kMostHoles = 512, kPasses = 4;
constexpr int kLeastHole = 6;  ///< texels along its shorter side

/// Columns whose highest top is looked for at once.
constexpr int kColumns = 64;

int LowestBit(uint64_t word) { return __builtin_ctzll(word); }
/// Zeros above the highest bit.
int ZerosAbove(uint64_t word) { return __builtin_clzll(word); }

/// Whether any of `count` bits from `first` on is set.
bool IsAnySet(const std::vector<uint64_t>& words, int first, int count) {
  for (int bit = first; bit < first + count;) {
    const int end = std::min(first + count, (bit / 64 + 1) * 64);
    const uint64_t ones = ~uint64_t(0) >> (64 - (end - bit));
    if (words[size_t(bit / 64)] & ones << (bit % 64)) return true;
    bit = end;
  }
  return false;
}

/// A rectangle of a page that is filled from below.
class Bin {
 public:
  Bin(int x, int y, int width, int height)
      : x_(x), y_(y), height_(height), top_(size_t(width), 0), topSum_(size_t(width) + 1, 0) {}

  struct Spot {
    int x = -1, y = 0;
    double cost = std::numeric_limits<double>::max();
  };

  /// Where the chart comes to lie lowest and leaves least empty, in the bin, at less than `cost`;
  /// x < 0: nowhere.
  Spot Find(const ChartShape& chart, double cost) const {
    Spot best;
    best.cost = cost;
    const int width = chart.Width();
    const auto isTooHigh = [&](int y) {
      return y + chart.Height() > height_ || double(y + chart.Height()) >= best.cost;
    };
    if (isTooHigh(least_ - chart.mostLow)) return best;
    int known = 0;  // Columns up to this one let it lie low enough.
    for (int x = 0; x + width <= int(top_.size()); ++x) {
      // Past the last column that holds it too high wherever it crosses it.
      int last = -1;
      for (known = std::max(x, known); known < x + width; ++known) {
        if (isTooHigh(top_[size_t(known)] - chart.mostLow)) last = known;
      }
      if (last >= 0) {
        x = last;
        continue;
      }
      const Spot found = this->Fall(chart, x, best.cost);
      if (found.cost < best.cost) best = found;
    }
    return best;
  }

  /// Returns its place on the page, and adds the texels that stay empty within and below it.
  std::array<int, 2> Put(const ChartShape& chart, const Spot& spot, int64_t* empty) {
    *empty -= chart.area;
    for (int i = 0; i < chart.Width(); ++i) {
      int16_t& top = top_[size_t(spot.x + i)];
      *empty += spot.y + chart.high[size_t(i)] - top;
      top = int16_t(spot.y + chart.high[size_t(i)]);
    }
    least_ = *std::min_element(top_.begin(), top_.end());
    for (size_t i = size_t(spot.x); i < top_.size(); ++i) topSum_[i + 1] = topSum_[i] + top_[i];
    return {x_ + spot.x, y_ + spot.y};
  }

  int Top(int x) const { return top_[size_t(x)]; }
  int Height() const { return *std::max_element(top_.begin(), top_.end()); }

 private:
  /// As low as it falls from a column on; at any cost of `most` or more where that is sure.
  Spot Fall(const ChartShape& chart, int x, double most) const {
    const int width = chart.Width();
    const int64_t gaps = chart.lowSum - topSum_[size_t(x + width)] + topSum_[size_t(x)];
    const auto costAt = [&](int y) {
      return y + chart.Height() + kWaste * double(width * int64_t(y) + gaps) / width;
    };
    // It lies no lower than where it would leave nothing empty.
    Spot spot{x, int(std::max<int64_t>(0, -gaps / width)), 0};
    spot.cost = costAt(spot.y);
    const int16_t *top = top_.data() + x, *low = chart.low.data();
    for (int begin = 0; begin < width && spot.cost < most; begin += kColumns) {
      int16_t highest = 0;
      for (int i = begin; i < std::min(width, begin + kColumns); ++i) {
        highest = std::max(highest, int16_t(top[i] - low[i]));
      }
      spot.y = std::max(spot.y, int(highest));
      if (spot.y + chart.Height() > height_) return {};
      spot.cost = costAt(spot.y);
    }
    return spot;
  }

  int x_, y_, height_, least_ = 0;
  std::vector<int16_t> top_;
  std::vector<int64_t> topSum_;  ///< of the columns before each
};

/// A page: what is taken of it, and the holes below its top.
class Page {
 public:
  explicit Page(int size) : size_(size), all_(0, 0, size, size), taken_(size, size) {}

  /// True, with the place, where the chart fits in one of its four ways.
  bool Put(const TurnedChart& turned, ChartPlace* place) {
    // Into a hole, the smallest that has room; else on top.
    if (double(empty_) > kEmptyPart * size_ * size_) this->FindHoles();
    for (size_t hole = holes_.size(); hole-- > 0;) {
      if (this->PutInto(turned, &holes_[hole], place)) return true;
    }
    return this->PutInto(turned, &all_, place);
  }

  int Height() const { return all_.Height(); }

 private:
  struct Cells {
    int x = 0, y = 0, width = 0, height = 0;
    /// The largest first; then the leftmost, the lowest and the narrowest. All within 16 bits.
    uint64_t Rank() const {
      const uint64_t area = uint64_t(width) * uint64_t(height);
      return ~area << 40 | uint64_t(x) << 28 | uint64_t(y) << 14 | uint64_t(width);
    }
  };

  /// The largest rectangles of cells that nothing takes, and the largest of what they leave.
  void FindHoles() {
    const int cell = std::max(kCell, size_ / kMostCells), cells = size_ / cell;
    const int least = (kLeastHole + cell - 1) / cell;
    std::vector<uint8_t> isFree = this->FreeCells(cell, cells);
    std::vector<Cells> found;
    for (int pass = 0; pass < kPasses; ++pass) {
      for (const Cells& hole : Rectangles(isFree, cells, least)) {
        if (found.size() < kMostHoles && TakeCells(hole, cells, &isFree)) found.push_back(hole);
      }
    }
    SortByArea(&found);
    holes_.clear();
    empty_ = 0;
    for (const Cells& hole : found) {
      holes_.emplace_back(hole.x * cell, hole.y * cell, hole.width * cell, hole.height * cell);
    }
  }

  /// Cells of so many texels along a side, column after column, that lie free below the top.
  std::vector<uint8_t> FreeCells(int cell, int cells) const {
    std::vector<uint8_t> isFree(size_t(cells) * size_t(cells));
    std::vector<uint64_t> taken(size_t(taken_.WordsOfColumn()));
    for (int x = 0; x < cells; ++x) {
      std::fill(taken.begin(), taken.end(), uint64_t(0));
      int top = size_;
      for (int i = x * cell; i < (x + 1) * cell; ++i) {
        top = std::min(top, all_.Top(i));
        for (size_t w = 0; w < taken.size(); ++w) taken[w] |= taken_.Column(i)[w];
      }
      for (int y = 0; y < top / cell; ++y) {
        isFree[size_t(x) * size_t(cells) + size_t(y)] = !IsAnySet(taken, y * cell, cell);
      }
    }
    return isFree;
  }

  static void SortByArea(std::vector<Cells>* holes) {
    std::sort(holes->begin(), holes->end(),
              [](const Cells& a, const Cells& b) { return a.Rank() < b.Rank(); });
  }

  /// False where one of them is not free.
  static bool TakeCells(const Cells& hole, int cells, std::vector<uint8_t>* isFree) {
    const auto column = [&](int x) { return isFree->begin() + std::ptrdiff_t(x) * cells + hole.y; };
    for (int x = hole.x; x < hole.x + hole.width; ++x) {
      if (std::find(column(x), column(x) + hole.height, 0) != column(x) + hole.height) return false;
    }
    for (int x = hole.x; x < hole.x + hole.width; ++x) {
      std::fill(column(x), column(x) + hole.height, uint8_t(0));
    }
    return true;
  }

  bool PutInto(const TurnedChart& turned, Bin* bin, ChartPlace* place) {
    Bin::Spot best;
    for (int turns = 0; turns < 4; ++turns) {
      const Bin::Spot spot = bin->Find(turned[size_t(turns)], best.cost);
      if (spot.x < 0) continue;
      best = spot;
      place->turns = turns;
    }
    if (best.x < 0) return false;
    const ChartShape& chart = turned[size_t(place->turns)];
    const std::array<int, 2> corner = bin->Put(chart, best, &empty_);
    place->x = corner[0];
    place->y = corner[1];
    taken_.Take(chart.mask, corner[0], corner[1]);
    return true;
  }

  /// Rectangles of free cells that no higher one and none further to the left holds, of `least`
  /// cells along a side at least, the largest first: under a histogram of free cells to the left,
  /// column by column.
  static std::vector<Cells> Rectangles(const std::vector<uint8_t>& isFree, int cells, int least) {
    std::vector<Cells> found;
    std::vector<int> run(size_t(cells) + 1, 0);  // Free cells to the left, by row; 0 at the end.
    std::vector<int> open;                       // Rows where a longer run began.
    for (int x = 0; x < cells; ++x) {
      open.clear();
      for (int y = 0; y <= cells; ++y) {
        if (y < cells) {
          const bool free = isFree[size_t(x) * size_t(cells) + size_t(y)] != 0;
          run[size_t(y)] = free ? run[size_t(y)] + 1 : 0;
        }
        while (!open.empty() && run[size_t(open.back())] >= run[size_t(y)]) {
          const int width = run[size_t(open.back())];
          open.pop_back();
          const int first = open.empty() ? 0 : open.back() + 1;
          if (std::min(width, y - first) < least) continue;
          found.push_back({x - width + 1, first, width, y - first});
        }
        open.push_back(y);
      }
    }
    SortByArea(&found);
    return found;
  }

  int size_;
  Bin all_;
  ChartMask taken_;
  std::vector<Bin> holes_;  ///< the largest first
  int64_t empty_ = 0;       ///< texels that were left since holes were looked for
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
    for (int w = first; w < last; ++w) area += int64_t(std::bitset<64>(column[w]).count());
  }
}

TurnedChart TurnFourWays(ChartMask mask) {
  TurnedChart turned;
  turned[0] = ChartShape(std::move(mask));
  for (size_t t = 1; t < 4; ++t) turned[t] = ChartShape(turned[t - 1].mask.Turned());
  return turned;
}

Packing PackCharts(const std::vector<TurnedChart>& charts, int pageSize, PackingOrder by) {
  for (const TurnedChart& ways : charts) {
    const ChartShape& chart = ways[0];
    if (std::max(chart.Height(), chart.Width()) <= pageSize) continue;
    throw Error("A chart of " + std::to_string(chart.Width()) + " x " +
                std::to_string(chart.Height()) + " texels does not fit on a page of " +
                std::to_string(pageSize) + "; take larger pages or larger texels.");
  }

  // The largest first, as `by` tells; of equal ones the longest.
  const auto rank = [&](int32_t i) {
    const ChartShape& chart = charts[size_t(i)][0];
    const int64_t width = chart.Width(), height = chart.Height();
    int64_t first = 0;
    switch (by) {
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
    Page page(pageSize);
    std::vector<int32_t> left;
    for (const int32_t i : order) {
      packing.places[size_t(i)].page = packing.pages;
      if (!page.Put(charts[size_t(i)], &packing.places[size_t(i)])) left.push_back(i);
    }
    ++packing.pages;
    packing.lastHeight = page.Height();
    order = std::move(left);
  }
  return packing;
}

}  // namespace lambert
