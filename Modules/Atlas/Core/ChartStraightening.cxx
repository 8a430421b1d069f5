#include "Atlas/Core/ChartStraightening.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "Common/Core/DisjointSets.h"
#include "Common/Core/Spectrum.h"

namespace lambert {

namespace {

/// Directions of lines that are tried.
constexpr int kDirections = 16;
/// Strips along a line that faces are sorted into before it is looked for.
constexpr size_t kStrips = 64;
/// Of the area of two charts, what either has at least.
constexpr double kLeastPart = 0.05;
/// Rounds after which borders are left as they are.
constexpr int kMostRounds = 64;

double AreaOf(const std::array<Vec2d, 3>& t) {
  const Vec2d u = t[1] - t[0], v = t[2] - t[0];
  return 0.5 * std::abs(u.x * v.y - u.y * v.x);
}

/// A rectangle across and along a line that grows about what it holds.
struct Bounds {
  Vec2d low{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  Vec2d high = low * -1.;

  void Include(const Bounds& other) {
    low = {std::min(low.x, other.low.x), std::min(low.y, other.low.y)};
    high = {std::max(high.x, other.high.x), std::max(high.y, other.high.y)};
  }
  /// Of none 0.
  double Area() const { return high.x >= low.x ? (high.x - low.x) * (high.y - low.y) : 0; }
};

/// Faces of the charts by number, and those beyond their edges: places among them, or -1.
struct Division {
  std::vector<size_t> order;
  std::vector<int32_t> faces, neighbours;
};

Division Divide(const std::vector<int32_t>& neighbours, const std::vector<int32_t>& faces) {
  Division division;
  division.order.resize(faces.size());
  std::iota(division.order.begin(), division.order.end(), size_t(0));
  std::sort(division.order.begin(), division.order.end(),
            [&](size_t i, size_t j) { return faces[i] < faces[j]; });
  std::vector<int32_t>& sorted = division.faces;
  for (const size_t i : division.order) sorted.push_back(faces[i]);
  for (const int32_t face : sorted) {
    for (int32_t corner = 3 * face; corner < 3 * face + 3; ++corner) {
      const int32_t other = neighbours[size_t(corner)] < 0 ? -1 : neighbours[size_t(corner)] / 3;
      const auto found = std::lower_bound(sorted.begin(), sorted.end(), other);
      const bool isWithin = found != sorted.end() && *found == other;
      division.neighbours.push_back(isWithin ? int32_t(found - sorted.begin()) : -1);
    }
  }
  return division;
}

/// Of borders that are open those of the charts that leave most empty, no chart twice.
std::vector<std::array<int32_t, 2>> Emptiest(const std::vector<ChartBorder>& borders,
                                             const StraightenedCharts& charts) {
  std::vector<double> empty;
  int32_t count = 0;
  for (const ChartBorder& border : borders) {
    empty.push_back(charts.empty(border.a) + charts.empty(border.b));
    count = std::max(count, border.b + 1);
  }
  std::vector<size_t> order(borders.size());
  std::iota(order.begin(), order.end(), size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t i, size_t j) { return empty[i] > empty[j]; });
  std::vector<uint8_t> isTaken(size_t(count), 0);
  std::vector<std::array<int32_t, 2>> pairs;
  for (const size_t i : order) {
    uint8_t &a = isTaken[size_t(borders[i].a)], &b = isTaken[size_t(borders[i].b)];
    if (a || b) continue;
    a = b = 1;
    pairs.push_back({borders[i].a, borders[i].b});
  }
  return pairs;
}

/// Faces in strips along a line. A cut between two of a strip is looked for only where whatever
/// lies before the strip and beyond it leaves hope.
class Strips {
 public:
  explicit Strips(const std::vector<std::array<Vec2d, 3>>& faces)
      : faces_(faces), bounds_(faces.size()), across_(faces.size()), stripOf_(faces.size()) {
    for (const auto& face : faces) {
      area_.push_back(AreaOf(face));
      whole_ += area_.back();
    }
  }

  /// Lines at another angle.
  void Turn(double angle) {
    // Faces across the line, by their middles.
    const double c = std::cos(angle), s = std::sin(angle);
    double low = std::numeric_limits<double>::max(), high = -low;
    for (size_t i = 0; i < faces_.size(); ++i) {
      bounds_[i] = {};
      across_[i] = 0;
      for (const Vec2d& p : faces_[i]) {
        const Vec2d turned(c * p.x + s * p.y, c * p.y - s * p.x);
        bounds_[i].Include({turned, turned});
        across_[i] += turned.x;
      }
      low = std::min(low, across_[i]);
      high = std::max(high, across_[i]);
    }

    // What lies in each strip, before and beyond.
    before_.fill({});
    beyond_.fill({});
    partBefore_.fill(0);
    const double scale = high > low ? double(kStrips) / (high - low) : 0;
    for (size_t i = 0; i < faces_.size(); ++i) {
      const size_t strip = std::min(kStrips - 1, size_t((across_[i] - low) * scale));
      stripOf_[i] = uint8_t(strip);
      before_[strip + 1].Include(bounds_[i]);
      beyond_[strip].Include(bounds_[i]);
      partBefore_[strip + 1] += area_[i];
    }
    for (size_t strip = 0; strip < kStrips; ++strip) {
      before_[strip + 1].Include(before_[strip]);
      partBefore_[strip + 1] += partBefore_[strip];
    }
    for (size_t strip = kStrips; strip-- > 0;) beyond_[strip].Include(beyond_[strip + 1]);
  }

  /// A line between each two faces of a strip, and between them and what lies beyond.
  void TryCutsWithin(size_t strip, StraightCut* best) {
    const auto most = [&](double part) { return part > (1 - kLeastPart) * whole_; };
    const auto least = [&](double part) { return part < kLeastPart * whole_; };
    if (least(partBefore_[strip + 1]) || most(partBefore_[strip])) return;
    if (before_[strip].Area() + beyond_[strip + 1].Area() >= best->rectangles) return;
    within_.clear();
    for (size_t i = 0; i < faces_.size(); ++i) {
      if (stripOf_[i] == strip) within_.emplace_back(across_[i], i);
    }
    std::sort(within_.begin(), within_.end());
    beyondEach_.assign(within_.size() + 1, beyond_[strip + 1]);
    for (size_t i = within_.size(); i-- > 0;) {
      beyondEach_[i] = beyondEach_[i + 1];
      beyondEach_[i].Include(bounds_[within_[i].second]);
    }
    Bounds before = before_[strip];
    double part = partBefore_[strip];
    std::pair<double, size_t> cut;
    bool isBetter = false;
    for (size_t i = 0; i < within_.size(); ++i) {
      before.Include(bounds_[within_[i].second]);
      part += area_[within_[i].second];
      if (least(part) || most(part)) continue;
      const double rectangles = before.Area() + beyondEach_[i + 1].Area();
      if (!(rectangles < best->rectangles)) continue;
      best->rectangles = rectangles;
      cut = within_[i];
      isBetter = true;
    }
    if (!isBetter) return;
    best->side.resize(faces_.size());
    for (size_t i = 0; i < faces_.size(); ++i) {
      best->side[i] = std::make_pair(across_[i], i) > cut;
    }
  }

 private:
  const std::vector<std::array<Vec2d, 3>>& faces_;
  std::vector<double> area_;
  double whole_ = 0;  ///< of all areas
  std::vector<Bounds> bounds_;
  std::vector<double> across_;
  std::vector<uint8_t> stripOf_;
  /// Of the strips before each, and from each on.
  std::array<Bounds, kStrips + 1> before_, beyond_;
  std::array<double, kStrips + 1> partBefore_;
  /// Of the faces of a strip one after the other across it.
  std::vector<std::pair<double, size_t>> within_;
  std::vector<Bounds> beyondEach_;
};

}  // namespace

StraightCut BestStraightCut(const std::vector<std::array<Vec2d, 3>>& faces, double most) {
  StraightCut best;
  best.rectangles = most;
  Strips strips(faces);
  for (int direction = 0; direction < kDirections; ++direction) {
    strips.Turn(kPi * direction / kDirections);
    for (size_t strip = 0; strip < kStrips; ++strip) strips.TryCutsWithin(strip, &best);
  }
  return best;
}

void RemoveTeeth(const std::vector<int32_t>& neighbours, std::vector<uint8_t>* side) {
  for (const uint8_t from : {uint8_t(0), uint8_t(1)}) {
    for (size_t face = 0; face < side->size(); ++face) {
      if ((*side)[face] != from) continue;
      int beyond = 0;
      for (size_t corner = 3 * face; corner < 3 * face + 3; ++corner) {
        const int32_t other = neighbours[corner];
        beyond += other >= 0 && (*side)[size_t(other)] != from;
      }
      if (beyond >= 2) (*side)[face] = uint8_t(1 - from);
    }
  }
}

void KeepLargestPieces(const std::vector<int32_t>& neighbours, std::vector<uint8_t>* side) {
  const size_t count = side->size();
  DisjointSets pieces{count};
  for (size_t corner = 0; corner < neighbours.size(); ++corner) {
    const int32_t other = neighbours[corner];
    if (other < 0 || (*side)[corner / 3] != (*side)[size_t(other)]) continue;
    pieces.Join(int32_t(corner / 3), other);
  }
  std::vector<int32_t> size(count, 0);
  for (size_t face = 0; face < count; ++face) ++size[size_t(pieces.Find(int32_t(face)))];
  std::array<int32_t, 2> largest = {-1, -1};
  for (size_t face = 0; face < count; ++face) {
    int32_t& best = largest[(*side)[face]];
    if (best < 0 || size[face] > size[size_t(best)]) best = int32_t(face);
  }
  for (size_t face = 0; face < count; ++face) {
    uint8_t& of = (*side)[face];
    if (pieces.Find(int32_t(face)) != largest[of]) of = uint8_t(1 - of);
  }
}

std::array<std::vector<int32_t>, 2> CutAnew(const std::vector<int32_t>& neighbours,
                                            const SideBySide& charts, double mostRectangles) {
  const StraightCut cut = BestStraightCut(charts.places, mostRectangles);
  if (cut.side.empty()) return {};
  const Division division = Divide(neighbours, charts.faces);
  std::vector<uint8_t> side;
  for (const size_t i : division.order) side.push_back(cut.side[i]);
  RemoveTeeth(division.neighbours, &side);
  KeepLargestPieces(division.neighbours, &side);
  std::array<std::vector<int32_t>, 2> sides;
  for (size_t i = 0; i < side.size(); ++i) sides[side[i]].push_back(division.faces[i]);
  if (sides[0].empty() || sides[1].empty()) return {};
  return sides;
}

// A rectangle grows by its perimeter times the margin, and by four squares of that.
void StraightenBorders(const StraightenedCharts& charts) {
  // How often each was cut anew, now and when a pair was tried.
  std::map<int32_t, int> cuts;
  std::map<std::array<int32_t, 2>, std::array<int, 2>> tried;
  const auto now = [&](int32_t a, int32_t b) { return std::array<int, 2>{cuts[a], cuts[b]}; };
  for (int round = 0; round < kMostRounds; ++round) {
    std::vector<ChartBorder> open;
    for (const ChartBorder& border : charts.borders()) {
      const auto last = tried.find({border.a, border.b});
      if (last == tried.end() || last->second != now(border.a, border.b)) open.push_back(border);
    }
    const std::vector<std::array<int32_t, 2>> pairs = Emptiest(open, charts);
    if (pairs.empty()) return;
    const std::vector<uint8_t> isCut = charts.tryToCut(pairs);
    for (size_t i = 0; i < pairs.size(); ++i) {
      for (const int32_t chart : pairs[i]) cuts[chart] += isCut[i];
      tried[pairs[i]] = now(pairs[i][0], pairs[i][1]);
    }
  }
}

}  // namespace lambert
