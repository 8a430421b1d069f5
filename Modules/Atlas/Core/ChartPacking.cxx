#include "Atlas/Core/ChartPacking.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <tuple>

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"

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

/// A mask, and what it takes of each column.
struct Shape {
  ChartMask mask;
  std::vector<int> low, high;
  int mostLow = 0;   ///< of `low`
  int64_t area = 0;  ///< texels

  explicit Shape(ChartMask mask_ = {}) : mask(std::move(mask_)) {
    for (int x = 0; x < mask.Width(); ++x) {
      int first = 0, last = mask.Height();
      while (first < last && !mask.IsTaken(x, first)) ++first;
      while (last > first && !mask.IsTaken(x, last - 1)) --last;
      low.push_back(first);
      mostLow = std::max(mostLow, first);
      high.push_back(last);
      for (int y = first; y < last; ++y) area += mask.IsTaken(x, y);
    }
  }
  int Width() const { return mask.Width(); }
  int Height() const { return mask.Height(); }
};

/// A rectangle of a page that is filled from below.
class Bin {
 public:
  Bin(int x, int y, int width, int height)
      : x_(x), y_(y), height_(height), top_(size_t(width), 0) {}

  struct Spot {
    int x = -1, y = 0;
    double cost = std::numeric_limits<double>::max();
  };

  /// Where the chart comes to lie lowest and leaves least empty, in the bin, at less than `cost`;
  /// x < 0: nowhere.
  Spot Find(const Shape& chart, double cost) const {
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

      // As low as it falls.
      int y = 0;
      for (int i = 0; i < width; ++i) {
        y = std::max(y, top_[size_t(x + i)] - chart.low[size_t(i)]);
      }
      if (isTooHigh(y)) continue;
      int64_t waste = 0;
      for (int i = 0; i < width; ++i) waste += y + chart.low[size_t(i)] - top_[size_t(x + i)];
      const double found = y + chart.Height() + kWaste * double(waste) / width;
      if (found < best.cost) best = {x, y, found};
    }
    return best;
  }

  /// Returns its place on the page, and adds the texels that stay empty within and below it.
  std::array<int, 2> Put(const Shape& chart, const Spot& spot, int64_t* empty) {
    *empty -= chart.area;
    for (int i = 0; i < chart.Width(); ++i) {
      *empty += spot.y + chart.high[size_t(i)] - top_[size_t(spot.x + i)];
      top_[size_t(spot.x + i)] = spot.y + chart.high[size_t(i)];
    }
    least_ = *std::min_element(top_.begin(), top_.end());
    return {x_ + spot.x, y_ + spot.y};
  }

  int Top(int x) const { return top_[size_t(x)]; }
  int Height() const { return *std::max_element(top_.begin(), top_.end()); }

 private:
  int x_, y_, height_, least_ = 0;
  std::vector<int> top_;
};

/// A page: what is taken of it, and the holes below its top.
class Page {
 public:
  explicit Page(int size) : size_(size), all_(0, 0, size, size), taken_(size, size) {}

  /// True, with the place, where the chart fits in one of its four ways.
  bool Put(const std::array<Shape, 4>& turned, ChartPlace* place) {
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
    int Area() const { return width * height; }
  };

  /// The largest rectangles of cells that nothing takes, and the largest of what they leave.
  void FindHoles() {
    const int cell = std::max(kCell, size_ / kMostCells), cells = size_ / cell;
    const int least = (kLeastHole + cell - 1) / cell;
    std::vector<uint8_t> isFree(size_t(cells) * size_t(cells));
    ParallelForEach(cells, 8, [&](int64_t x) {
      for (int y = 0; y < cells; ++y) {
        isFree[size_t(x) * size_t(cells) + size_t(y)] = this->IsFree(int(x) * cell, y * cell, cell);
      }
    });
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

  static void SortByArea(std::vector<Cells>* holes) {
    std::sort(holes->begin(), holes->end(), [](const Cells& a, const Cells& b) {
      return std::make_tuple(-a.Area(), a.x, a.y, a.width) <
             std::make_tuple(-b.Area(), b.x, b.y, b.width);
    });
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

  bool PutInto(const std::array<Shape, 4>& turned, Bin* bin, ChartPlace* place) {
    Bin::Spot best;
    for (int turns = 0; turns < 4; ++turns) {
      const Bin::Spot spot = bin->Find(turned[size_t(turns)], best.cost);
      if (spot.x < 0) continue;
      best = spot;
      place->turns = turns;
    }
    if (best.x < 0) return false;
    const Shape& chart = turned[size_t(place->turns)];
    const std::array<int, 2> corner = bin->Put(chart, best, &empty_);
    place->x = corner[0];
    place->y = corner[1];
    for (int x = 0; x < chart.Width(); ++x) {
      for (int y = 0; y < chart.Height();) {
        int end = y;
        while (end < chart.Height() && chart.mask.IsTaken(x, end)) ++end;
        if (end > y) taken_.Take(corner[0] + x, corner[1] + y, corner[1] + end);
        y = end + 1;
      }
    }
    return true;
  }

  bool IsFree(int left, int low, int cell) const {
    for (int x = left; x < left + cell; ++x) {
      if (low + cell > all_.Top(x)) return false;
      for (int y = low; y < low + cell; ++y) {
        if (taken_.IsTaken(x, y)) return false;
      }
    }
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

ChartMask::ChartMask(int width, int height)
    : width_(width),
      height_(height),
      words_((height + 63) / 64),
      bits_(size_t(width) * size_t(words_), 0) {}

void ChartMask::Take(int x, int low, int high) {
  for (int y = low; y < high;) {
    const int end = std::min(high, (y / 64 + 1) * 64);
    const uint64_t ones = ~uint64_t(0) >> (64 - (end - y));
    bits_[this->Word(x, y)] |= ones << (y % 64);
    y = end;
  }
}

ChartMask ChartMask::Turned() const {
  // What was row y is column y from the right.
  ChartMask turned(height_, width_);
  for (int x = 0; x < width_; ++x) {
    for (int y = 0; y < height_; ++y) {
      if (this->IsTaken(x, y)) turned.Take(height_ - 1 - y, x, x + 1);
    }
  }
  return turned;
}

Packing PackCharts(const std::vector<ChartMask>& charts, int pageSize, PackingOrder by) {
  // The four ways to lay each.
  std::vector<std::array<Shape, 4>> turned(charts.size());
  for (const ChartMask& chart : charts) {
    if (std::max(chart.Height(), chart.Width()) <= pageSize) continue;
    throw Error("A chart of " + std::to_string(chart.Width()) + " x " +
                std::to_string(chart.Height()) + " texels does not fit on a page of " +
                std::to_string(pageSize) + "; take larger pages or larger texels.");
  }
  ParallelForEach(int64_t(charts.size()), 4, [&](int64_t i) {
    std::array<Shape, 4>& ways = turned[size_t(i)];
    ways[0] = Shape(charts[size_t(i)]);
    for (size_t t = 1; t < 4; ++t) ways[t] = Shape(ways[t - 1].mask.Turned());
  });

  // The largest first, as `by` tells; of equal ones the longest.
  const auto rank = [&](int32_t i) {
    const ChartMask& chart = charts[size_t(i)];
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
        first = turned[size_t(i)][0].area;
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
  for (const std::array<Shape, 4>& ways : turned) packing.takenTexels += ways[0].area;
  while (!order.empty()) {
    Page page(pageSize);
    std::vector<int32_t> left;
    for (const int32_t i : order) {
      packing.places[size_t(i)].page = packing.pages;
      if (!page.Put(turned[size_t(i)], &packing.places[size_t(i)])) left.push_back(i);
    }
    ++packing.pages;
    packing.lastHeight = page.Height();
    order = std::move(left);
  }
  return packing;
}

}  // namespace lambert
