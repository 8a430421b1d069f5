#include "Atlas/Core/PackingPage.h"

#include <algorithm>

namespace lambert {

namespace {

/// Holes are looked for whenever charts have left this part of a page empty within or below them.
constexpr double kEmptyPart = 1. / 64;
/// Holes are rectangles of cells: so many texels along a cell, or more, that so many are along a
/// page at most.
constexpr int kCell = 4, kMostCells = 512;
/// At most so many holes, found in so many passes, the largest first.
constexpr int kMostHoles = 512, kPasses = 4;
constexpr int kMostRectangles = 4096;  ///< of a pass
constexpr int kLeastHole = 6;          ///< texels along its shorter side

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

struct Cells {
  int x = 0, y = 0, width = 0, height = 0;
  /// The largest first; then the leftmost, the lowest and the narrowest. All within 16 bits.
  uint64_t Rank() const {
    const uint64_t area = uint64_t(width) * uint64_t(height);
    return ~area << 40 | uint64_t(x) << 28 | uint64_t(y) << 14 | uint64_t(width);
  }
};

void SortByArea(std::vector<Cells>* holes) {
  std::sort(holes->begin(), holes->end(),
            [](const Cells& a, const Cells& b) { return a.Rank() < b.Rank(); });
}

/// False where one of them is not free.
bool TakeCells(const Cells& hole, int cells, std::vector<uint8_t>* isFree) {
  const auto column = [&](int x) { return isFree->begin() + std::ptrdiff_t(x) * cells + hole.y; };
  for (int x = hole.x; x < hole.x + hole.width; ++x) {
    if (std::find(column(x), column(x) + hole.height, 0) != column(x) + hole.height) return false;
  }
  for (int x = hole.x; x < hole.x + hole.width; ++x) {
    std::fill(column(x), column(x) + hole.height, uint8_t(0));
  }
  return true;
}

/// Rectangles of free cells that no higher one and none further to the left holds, of `least`
/// cells along a side at least, the largest first: under a histogram of free cells to the left,
/// column by column.
std::vector<Cells> Rectangles(const std::vector<uint8_t>& isFree, int cells, int least) {
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
  if (found.size() > kMostRectangles) {
    const auto end = found.begin() + kMostRectangles;
    std::nth_element(found.begin(), end, found.end(),
                     [](const Cells& a, const Cells& b) { return a.Rank() < b.Rank(); });
    found.erase(end, found.end());
  }
  SortByArea(&found);
  return found;
}

}  // namespace

PackingPage::PackingPage(int size, double waste)
    : size_(size), waste_(waste), all_(0, 0, size, size, waste), taken_(size, size) {}

bool PackingPage::RenewHoles() {
  if (double(empty_) <= kEmptyPart * size_ * size_) return false;
  this->FindHoles();
  return true;
}

void PackingPage::FindHoles() {
  const int cell = std::max(kCell, size_ / kMostCells), cells = size_ / cell;
  const int least = (kLeastHole + cell - 1) / cell;
  std::vector<uint8_t> isFree = this->FreeCells(cell, cells);
  std::vector<Cells> found;
  for (int pass = 0; pass < kPasses && found.size() < kMostHoles; ++pass) {
    for (const Cells& hole : Rectangles(isFree, cells, least)) {
      if (found.size() < kMostHoles && TakeCells(hole, cells, &isFree)) found.push_back(hole);
    }
  }
  SortByArea(&found);
  holes_.clear();
  empty_ = 0;
  for (const Cells& hole : found) {
    holes_.emplace_back(hole.x * cell, hole.y * cell, hole.width * cell, hole.height * cell,
                        waste_);
  }
}

std::vector<uint8_t> PackingPage::FreeCells(int cell, int cells) const {
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

bool PackingPage::PutIntoHole(const TurnedChart& chart, ChartPlace* place) {
  for (size_t hole = holes_.size(); hole-- > 0;) {
    const PackingSpot spot = holes_[hole].Find(chart, std::numeric_limits<double>::max());
    if (spot.x < 0) continue;
    // What lies beside it may have moved in.
    if (this->Meets(holes_[hole], chart[size_t(spot.turns)], spot)) continue;
    this->Put(chart, spot, &holes_[hole], place);
    return true;
  }
  return false;
}

PackingSpot PackingPage::PutOnTop(const TurnedChart& chart, const PackingSpot& spot,
                                  ChartPlace* place) {
  return this->Put(chart, spot, &all_, place);
}

bool PackingPage::Meets(const PackingBin& bin, const ChartShape& chart,
                        const PackingSpot& spot) const {
  return taken_.Meets(chart.mask, bin.Left() + spot.x, bin.Low() + spot.y);
}

PackingSpot PackingPage::Put(const TurnedChart& chart, PackingSpot spot, PackingBin* bin,
                             ChartPlace* place) {
  // To the left and down as far as it goes, below what overhangs.
  const ChartShape& shape = chart[size_t(spot.turns)];
  for (bool moves = true; moves;) {
    moves = false;
    for (int* along : {&spot.x, &spot.y}) {
      while (*along > 0) {
        --*along;
        if (this->Meets(*bin, shape, spot)) {
          ++*along;
          break;
        }
        moves = true;
      }
    }
  }
  empty_ += bin->Put(shape, spot);
  place->x = bin->Left() + spot.x;
  place->y = bin->Low() + spot.y;
  place->turns = spot.turns;
  taken_.Take(shape.mask, place->x, place->y);
  return spot;
}

}  // namespace lambert
