#include "Atlas/Core/ChartSegmentation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "Atlas/Core/ChartJoining.h"
#include "Atlas/Core/ChartRoom.h"
#include "Atlas/Core/ChartStraightening.h"
#include "Atlas/Core/ConformalMap.h"
#include "Clustering/Core/ClusterFrame.h"
#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"

namespace lambert {

namespace {

/// A cluster is seen along its normal where that shortens no length by more than this factor.
constexpr double kMostForeshortened = 1.1;
/// Charts are joined where the smaller one has this part of the area of all at most: large ones
/// have little to gain. More faces than these take too long, as they may be tried again and again.
constexpr double kSmall = 1. / 500;
constexpr size_t kMostFaces = 1 << 14;
/// Laid flat together they may take less than side by side as they are, by about this factor.
constexpr double kMostGuessed = 1.1;
/// Two charts become one whose smallest rectangle is as large as theirs together, times this, at
/// most: borders are ragged.
constexpr double kMostJoined = 1.25;
/// Two charts are cut anew where they leave this part of their area empty at least, to this part of
/// their rectangles at most.
constexpr double kLeastEmpty = 0.1, kMostCutAnew = 0.99;
/// A chart is cut apart where both parts, padding and all, take this part of its room at most: more
/// charts have more seams.
constexpr double kMostCutApart = 0.9;
/// Charts cut anew may have lengths that are powers of this, times the root of all area.
constexpr double kLengthStep = 1.2;

/// Extents that a chart may be refused for: at least `edge`, its longest one, of which no cut makes
/// it rid, and under `extent`, the longer side of its upright rectangle; m.
struct Refusal {
  double edge = 0, extent = 0;

  bool IsFor(double longest) const { return edge <= longest && longest < extent; }
};

Refusal RefusalOf(const ChartMesh& mesh, const std::vector<Vec2d>& map) {
  Refusal refusal;
  Vec2d low = map.front(), high = map.front();
  for (const Vec2d& p : map) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  refusal.extent = std::max(high.x - low.x, high.y - low.y);
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    refusal.edge = std::max(refusal.edge, Flatten(mesh, t).length);
  }
  return refusal;
}

/// What is taken for no limit is one that no chart reaches.
double LongestOf(const ChartOptions& options) {
  return options.longest > 0 ? options.longest : std::numeric_limits<double>::max();
}

/// What a chart keeps to besides the options: m2, m.
struct Limits {
  double rectangle = std::numeric_limits<double>::max();
  double extent = std::numeric_limits<double>::max();
};

/// Faces that a chart is made of, and what is known of it.
struct Piece {
  Chart chart;  ///< without corners: they cannot be laid flat
  std::vector<int32_t> faces;
  Room rectangle;     ///< the smallest about it
  double area = 0;    ///< m2
  double extent = 0;  ///< m, of the longer side of the upright one

  double Empty() const { return rectangle.area - area; }
};

class Segmentation {
 public:
  Segmentation(const TriangleMesh& mesh, const ClusterTree& tree, const ChartOptions& options)
      : mesh_(mesh), tree_(tree), options_(options), neighbours_(FindNeighbours(mesh)) {
    set_.places.resize(size_t(mesh.FaceCount()));
    set_.corners.resize(size_t(mesh.FaceCount()));
    set_.options = options;
    for (const int32_t root : tree.surfaceRoots) area_ += double(tree.nodes[size_t(root)].area);
  }

  ChartSet Run(const ProgressCallback& progress) {
    this->CutDown(progress);
    const auto before = [](const Piece& a, const Piece& b) {
      return a.faces.front() < b.faces.front();
    };
    std::sort(pieces_.begin(), pieces_.end(), before);
    this->Join(progress);
    this->CutApart(progress);
    this->Straighten(progress);
    std::sort(pieces_.begin(), pieces_.end(), before);
    for (Piece& piece : pieces_) {
      piece.chart.first = int32_t(set_.faces.size());
      piece.chart.faceCount = int32_t(piece.faces.size());
      set_.faces.insert(set_.faces.end(), piece.faces.begin(), piece.faces.end());
      set_.charts.push_back(piece.chart);
    }
    return std::move(set_);
  }

 private:
  /// Clusters of one level of the tree after the other; those that fail hand on to their children.
  void CutDown(const ProgressCallback& progress) {
    std::vector<int32_t> open = tree_.surfaceRoots;
    size_t done = 0;
    while (!open.empty()) {
      const double fraction = double(done) / double(std::max<int64_t>(1, mesh_.FaceCount()));
      if (!Report(progress, 0.8 * fraction, "cutting into charts")) throw Cancelled();
      std::vector<Piece> flat(open.size());
      std::vector<Refusal> refusals(open.size());
      ParallelForEach(int64_t(open.size()), 1, [&](int64_t i) {
        const ClusterNode& node = tree_.nodes[size_t(open[size_t(i)])];
        flat[size_t(i)] = this->TryToFlatten(FacesFrom(node.firstFace, node.faceCount), Limits(),
                                             &refusals[size_t(i)]);
      });
      for (const Refusal& refusal : refusals) this->Narrow(refusal);
      std::vector<int32_t> children;
      for (size_t i = 0; i < open.size(); ++i) {
        if (flat[i].chart.cornerCount > 0) {
          done += flat[i].faces.size();
          pieces_.push_back(std::move(flat[i]));
          continue;
        }
        const int32_t child = tree_.nodes[size_t(open[i])].child;
        children.push_back(child);
        children.push_back(child + 1);
      }
      open = std::move(children);
    }
  }

  /// Neighbours become one chart where that leaves no more empty than the two do.
  void Join(const ProgressCallback& progress) {
    const auto tryAll = [&](const std::vector<std::array<int32_t, 2>>& pairs) {
      if (!Report(progress, 0.8, "joining charts")) throw Cancelled();
      std::vector<uint8_t> isJoined(pairs.size(), 0);
      std::vector<Refusal> refusals(pairs.size());
      ParallelForEach(int64_t(pairs.size()), 1, [&](int64_t i) {
        isJoined[size_t(i)] =
            this->TryToJoin(&pieces_[size_t(pairs[size_t(i)][0])],
                            &pieces_[size_t(pairs[size_t(i)][1])], &refusals[size_t(i)]);
      });
      for (const Refusal& refusal : refusals) this->Narrow(refusal);
      return isJoined;
    };
    JoinAlongBorders(this->Borders(), tryAll);
    const auto isJoined = [](const Piece& piece) { return piece.faces.empty(); };
    pieces_.erase(std::remove_if(pieces_.begin(), pieces_.end(), isJoined), pieces_.end());
  }

  /// Charts fall in two along a line where that needs less room, as long as any does.
  void CutApart(const ProgressCallback& progress) {
    if (std::isinf(options_.margin)) {
      set_.leastMargin = std::numeric_limits<double>::max();
      return;
    }
    const double longest = this->LongestCutAnew();
    std::vector<size_t> open(pieces_.size());
    std::iota(open.begin(), open.end(), size_t(0));
    while (!open.empty()) {
      if (!Report(progress, 0.85, "cutting charts apart")) throw Cancelled();
      std::vector<Piece> others(open.size());
      std::vector<double> mostMargins(open.size(), -1);
      ParallelForEach(int64_t(open.size()), 1, [&](int64_t i) {
        others[size_t(i)] =
            this->TryToCutApart(&pieces_[open[size_t(i)]], longest, &mostMargins[size_t(i)]);
      });
      std::vector<size_t> cut;
      for (size_t i = 0; i < open.size(); ++i) {
        const bool isCut = mostMargins[i] >= options_.margin;
        double& end = isCut ? set_.mostMargin : set_.leastMargin;
        end = isCut ? std::min(end, mostMargins[i]) : std::max(end, mostMargins[i]);
        if (!isCut) continue;
        cut.push_back(open[i]);
        cut.push_back(pieces_.size());
        pieces_.push_back(std::move(others[i]));
      }
      open = std::move(cut);
    }
  }

  /// Neighbours are cut anew where that leaves less empty.
  void Straighten(const ProgressCallback& progress) {
    StraightenedCharts charts;
    charts.borders = [&] { return this->Borders(); };
    charts.empty = [&](int32_t i) { return pieces_[size_t(i)].Empty(); };
    charts.tryToCut = [&](const std::vector<std::array<int32_t, 2>>& pairs) {
      if (!Report(progress, 0.9, "straightening borders")) throw Cancelled();
      std::vector<uint8_t> isCut(pairs.size(), 0);
      const double longest = this->LongestCutAnew();
      ParallelForEach(int64_t(pairs.size()), 1, [&](int64_t i) {
        const auto& [a, b] = pairs[size_t(i)];
        isCut[size_t(i)] = this->TryToCutAnew(&pieces_[size_t(a)], &pieces_[size_t(b)], longest);
      });
      return isCut;
    };
    StraightenBorders(charts);
  }

  std::vector<ChartBorder> Borders() const {
    std::vector<int32_t> chartOfFace(size_t(mesh_.FaceCount()), 0);
    for (size_t i = 0; i < pieces_.size(); ++i) {
      for (const int32_t face : pieces_[i].faces) chartOfFace[size_t(face)] = int32_t(i);
    }
    return SmoothBorders(mesh_, neighbours_, chartOfFace);
  }

  /// Both in `a`, if they can be laid flat together. Where they meet in several lines, as the
  /// halves of a tube, all but the longest stay cut.
  bool TryToJoin(Piece* a, Piece* b, Refusal* refusal) {
    if (std::min(a->rectangle.area, b->rectangle.area) > kSmall * area_) return false;
    if (a->faces.size() + b->faces.size() > kMostFaces) return false;
    const CommonLines lines = LinesBetween(mesh_, neighbours_, a->faces, b->faces);
    const double mostRectangle = kMostJoined * (a->rectangle.area + b->rectangle.area);
    std::vector<Vec2d> places;
    for (const auto& corners : this->Lay(*a, *b, lines).places) {
      places.insert(places.end(), corners.begin(), corners.end());
    }
    if (RoomOf(places).area > kMostGuessed * mostRectangle) return false;
    std::vector<int32_t> faces;
    std::merge(a->faces.begin(), a->faces.end(), b->faces.begin(), b->faces.end(),
               std::back_inserter(faces));
    const std::vector<int32_t> beyond = this->Open(lines.others);
    Piece joined = this->TryToFlatten(std::move(faces), {mostRectangle}, refusal);
    if (joined.faces.empty()) {
      for (size_t i = 0; i < beyond.size(); ++i) this->Close(lines.others[i], beyond[i]);
      return false;
    }
    *a = std::move(joined);
    *b = {};
    return true;
  }

  /// m, of a series, so that a little more or less room changes nothing.
  double LongestCutAnew() {
    if (!(options_.longest > 0)) return std::numeric_limits<double>::max();
    const double unit = std::sqrt(area_), step = std::log(kLengthStep);
    const double power = std::floor(std::log(options_.longest / unit) / step);
    const double longest = std::min(options_.longest, unit * std::exp(power * step));
    set_.leastLongest = std::max(set_.leastLongest, longest);
    set_.mostLongest = std::min(set_.mostLongest, unit * std::exp((power + 1) * step));
    return longest;
  }

  /// The part beyond the best line, if both parts can be laid flat and need less room than the
  /// chart; neither longer than that was, or than `longest`, m. `mostMargin`: the widest margin
  /// with which that is so, m, where any is.
  Piece TryToCutApart(Piece* piece, double longest, double* mostMargin) {
    if (piece->faces.size() < 2 || piece->Empty() < kLeastEmpty * piece->area) return {};
    SideBySide chart{piece->faces, {}};
    for (const int32_t face : piece->faces) {
      const auto& p = set_.places[size_t(face)];
      chart.places.push_back({Vec2d(p[0]), Vec2d(p[1]), Vec2d(p[2])});
    }
    const double most = kMostCutApart * piece->rectangle.area;
    auto sides = CutAnew(neighbours_, chart, most);
    if (sides[0].empty()) return {};
    const Places before = this->PlacesOf(piece->faces);
    auto [first, second] =
        this->TryToFlattenBoth(std::move(sides), {most, std::max(piece->extent, longest)});
    if (!second.faces.empty()) {
      *mostMargin =
          MostMargin(piece->rectangle, {first.rectangle, second.rectangle}, kMostCutApart);
    }
    if (!(*mostMargin >= options_.margin)) {
      this->PutBack(piece->faces, before);
      return {};
    }
    *piece = std::move(first);
    return std::move(second);
  }

  /// Both along a straight line, if what that makes can be laid flat and leaves less empty; neither
  /// longer than both were, or than `longest`, m. Where they meet in several lines, all but the
  /// longest stay cut within either.
  bool TryToCutAnew(Piece* a, Piece* b, double longest) {
    if (a->faces.size() + b->faces.size() > 2 * kMostFaces) return false;
    if (a->Empty() + b->Empty() < kLeastEmpty * (a->area + b->area)) return false;
    const CommonLines lines = LinesBetween(mesh_, neighbours_, a->faces, b->faces);
    const SideBySide charts = this->Lay(*a, *b, lines);
    const double most = kMostCutAnew * (a->rectangle.area + b->rectangle.area);
    const std::vector<int32_t> beyond = this->Open(lines.others);
    auto sides = CutAnew(neighbours_, charts, most);
    Piece first, second;
    if (!sides[0].empty()) {
      const Places before = this->PlacesOf(charts.faces);
      std::tie(first, second) = this->TryToFlattenBoth(
          std::move(sides), {most, std::max({a->extent, b->extent, longest})});
      if (second.faces.empty()) this->PutBack(charts.faces, before);
    }
    // What lies between them now is closed.
    const bool isCut = !second.faces.empty();
    for (size_t i = 0; i < beyond.size(); ++i) {
      const auto isInFirst = [&](int32_t corner) {
        return std::binary_search(first.faces.begin(), first.faces.end(), corner / 3);
      };
      if (isCut && isInFirst(lines.others[i]) == isInFirst(beyond[i])) continue;
      this->Close(lines.others[i], beyond[i]);
    }
    if (!isCut) return false;
    *a = std::move(first);
    *b = std::move(second);
    return true;
  }

  SideBySide Lay(const Piece& a, const Piece& b, const CommonLines& lines) const {
    return LaySideBySide({&a.faces, &b.faces}, set_.places, neighbours_, lines.longest);
  }

  /// Faces are no neighbours any more along some edges. Returns the corners beyond.
  std::vector<int32_t> Open(const std::vector<int32_t>& corners) {
    std::vector<int32_t> beyond;
    for (const int32_t corner : corners) beyond.push_back(neighbours_[size_t(corner)]);
    for (const std::vector<int32_t>* side : {&corners, &std::as_const(beyond)}) {
      for (const int32_t corner : *side) neighbours_[size_t(corner)] = -1;
    }
    return beyond;
  }
  void Close(int32_t corner, int32_t beyond) {
    neighbours_[size_t(corner)] = beyond;
    neighbours_[size_t(beyond)] = corner;
  }

  /// Where some faces lie, to be put back.
  struct Places {
    std::vector<std::array<Vec2f, 3>> places;
    std::vector<std::array<int32_t, 3>> corners;
  };
  Places PlacesOf(const std::vector<int32_t>& faces) const {
    Places kept;
    for (const int32_t face : faces) {
      kept.places.push_back(set_.places[size_t(face)]);
      kept.corners.push_back(set_.corners[size_t(face)]);
    }
    return kept;
  }
  void PutBack(const std::vector<int32_t>& faces, const Places& kept) {
    for (size_t i = 0; i < faces.size(); ++i) {
      set_.places[size_t(faces[i])] = kept.places[i];
      set_.corners[size_t(faces[i])] = kept.corners[i];
    }
  }

  /// The charts are the same for any longest extent on this side of both ends of `refusal`.
  void Narrow(const Refusal& refusal) {
    for (const double end : {refusal.edge, refusal.extent}) {
      if (end <= LongestOf(options_)) {
        set_.leastLongest = std::max(set_.leastLongest, end);
      } else {
        set_.mostLongest = std::min(set_.mostLongest, end);
      }
    }
  }

  /// The chart of some faces; one without corners where they cannot be laid flat. With `refusal`
  /// the options tell how long it may be: what it may be refused for, where that was looked at.
  Piece TryToFlatten(std::vector<int32_t> faces, const Limits& limits, Refusal* refusal = nullptr) {
    const ChartMesh mesh = MakeChartMesh(mesh_, neighbours_, faces);
    Piece piece;
    if (faces.size() == 1) {
      const std::vector<Vec2d> map = MapOfFace(mesh);
      piece.rectangle = RoomOf(map);
      piece.area = AreaOf(mesh);
      piece.extent = RefusalOf(mesh, map).extent;
      piece.chart.cornerCount = 3;
      piece.chart.isProjected = true;
      piece.faces = std::move(faces);
      this->Keep(piece, mesh, map);
      return piece;
    }
    if (!mesh.IsFlat()) return {};

    // Seen along its normal, or else by a map that keeps angles.
    double stretch = 0;
    piece.area = AreaOf(mesh);
    std::vector<Vec2d> map = this->Map(mesh, piece.area, &piece.chart.isProjected, &stretch);
    if (map.empty()) return {};
    piece.rectangle = RoomOf(map);
    if (piece.rectangle.area > limits.rectangle) return {};
    const Refusal ends = RefusalOf(mesh, map);
    piece.extent = ends.extent;
    if (piece.extent > limits.extent) return {};
    if (refusal) {
      *refusal = ends;
      if (ends.IsFor(LongestOf(options_))) return {};
    }
    if (options_.mostEmpty > 0 && piece.Empty() > options_.mostEmpty) return {};
    piece.chart.stretch = float(stretch);
    piece.chart.cornerCount = int32_t(mesh.positions.size());
    piece.faces = std::move(faces);
    this->Keep(piece, mesh, map);
    return piece;
  }

  /// Two charts that keep to the limits together, and each to their extent; the second one has no
  /// faces where they do not.
  std::pair<Piece, Piece> TryToFlattenBoth(std::array<std::vector<int32_t>, 2> sides,
                                           Limits limits) {
    std::pair<Piece, Piece> both;
    both.first = this->TryToFlatten(std::move(sides[0]), limits);
    limits.rectangle -= both.first.rectangle.area;
    if (!both.first.faces.empty()) {
      both.second = this->TryToFlatten(std::move(sides[1]), limits);
    }
    return both;
  }

  /// Empty where no map keeps within the stretch.
  std::vector<Vec2d> Map(const ChartMesh& mesh, double area, bool* isProjected,
                         double* stretch) const {
    const Vec3d vectorArea = VectorAreaOf(mesh), axis = Normalize(vectorArea);
    std::vector<Vec2d> map;
    *isProjected = true;
    const double limit = std::min(options_.stretch, kMostForeshortened);
    const bool isFacing = area <= kMostForeshortened * Length(vectorArea);
    if (isFacing && axis != Vec3d()) map = ProjectedMap(mesh, axis);
    *stretch = map.empty() ? 0 : Stretch(mesh, map);
    if (*stretch > 0 && *stretch <= limit) return map;
    *isProjected = false;
    map = ConformalMap(mesh);
    *stretch = map.empty() ? 0 : Stretch(mesh, map);
    if (!(*stretch > 0 && *stretch <= options_.stretch)) map.clear();
    return map;
  }

  void Keep(const Piece& piece, const ChartMesh& mesh, const std::vector<Vec2d>& map) {
    Vec2d middle;
    for (const Vec2d& place : map) middle = middle + place * (1 / double(map.size()));
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
      const size_t face = size_t(piece.faces[t]);
      set_.corners[face] = mesh.triangles[t];
      for (size_t c = 0; c < 3; ++c) {
        set_.places[face][c] = Vec2f(map[size_t(mesh.triangles[t][c])] - middle);
      }
    }
  }

  const TriangleMesh& mesh_;
  const ClusterTree& tree_;
  const ChartOptions options_;
  std::vector<int32_t> neighbours_;
  double area_ = 0;  ///< m2, of all
  std::vector<Piece> pieces_;
  ChartSet set_;
};

}  // namespace

bool ChartSet::IsOf(const ChartOptions& other) const {
  return !charts.empty() && other.stretch == options.stretch &&
         other.mostEmpty == options.mostEmpty && LongestOf(other) >= leastLongest &&
         LongestOf(other) < mostLongest && other.margin > leastMargin && other.margin <= mostMargin;
}

std::vector<int32_t> ChartOfFace(const ChartSet& set) {
  std::vector<int32_t> chartOfFace(set.places.size());
  for (size_t i = 0; i < set.charts.size(); ++i) {
    for (const int32_t face : set.FacesOf(set.charts[i])) chartOfFace[size_t(face)] = int32_t(i);
  }
  return chartOfFace;
}

float LargestStretch(const ChartSet& set) {
  float largest = 1;
  for (const Chart& chart : set.charts) largest = std::max(largest, chart.stretch);
  return largest;
}

ChartSet CutIntoCharts(const TriangleMesh& mesh, const ClusterTree& tree,
                       const ChartOptions& options, const ProgressCallback& progress) {
  if (!(options.stretch >= 1 && std::isfinite(options.stretch))) {
    throw Error("The stretch of a chart is a factor of at least 1.");
  }
  if (!(options.longest >= 0)) throw Error("A chart's extent is 0 m or more.");
  if (!(options.margin >= 0)) throw Error("The margin of a chart is 0 m or more.");
  if (!(options.mostEmpty >= 0)) throw Error("What a chart leaves empty is 0 m2 or more.");
  int64_t faces = 0;
  for (const int32_t root : tree.surfaceRoots) faces += tree.nodes[size_t(root)].faceCount;
  if (faces != mesh.FaceCount()) {
    throw Error("The cluster tree holds " + std::to_string(faces) + " faces, the mesh " +
                std::to_string(mesh.FaceCount()) + ".");
  }
  return Segmentation(mesh, tree, options).Run(progress);
}

}  // namespace lambert
