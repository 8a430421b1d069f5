#include "Atlas/Core/ChartSegmentation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "Atlas/Core/ConformalMap.h"
#include "Clustering/Core/ClusterFrame.h"
#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"

namespace lambert {

namespace {

/// A cluster is seen along its normal where that shortens no length by more than this factor.
constexpr double kMostForeshortened = 1.1;

/// One face at a place of its own; that it has no area does no harm.
std::vector<Vec2d> MapOfFace(const ChartMesh& chart) {
  const FlatTriangle flat = Flatten(chart, 0);
  const Vec2d places[3] = {{0, 0}, {flat.length, 0}, {flat.x, flat.height}};
  std::vector<Vec2d> map(3);
  for (int c = 0; c < 3; ++c) {
    map[size_t(chart.triangles[0][size_t((flat.first + c) % 3)])] = places[c];
  }
  return map;
}

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

/// Its smallest rectangle has no more empty space.
bool IsFull(const std::vector<Vec2d>& map, double area, double mostEmpty) {
  if (!(mostEmpty > 0)) return true;
  std::vector<Vec2f> points;
  for (const Vec2d& p : map) points.emplace_back(p);
  const Vec2f half = MinimumAreaRectangle(points).halfExtent;
  return 4 * double(half.x) * double(half.y) - area <= mostEmpty;
}

class Segmentation {
 public:
  Segmentation(const TriangleMesh& mesh, const ClusterTree& tree, const ChartOptions& options)
      : mesh_(mesh), tree_(tree), options_(options), neighbours_(FindNeighbours(mesh)) {
    set_.places.resize(size_t(mesh.FaceCount()));
    set_.corners.resize(size_t(mesh.FaceCount()));
    set_.options = options;
  }

  /// Clusters of one level of the tree after the other; those that fail hand on to their children.
  ChartSet Run(const ProgressCallback& progress) {
    std::vector<int32_t> open = tree_.surfaceRoots;
    int64_t done = 0;
    while (!open.empty()) {
      const double fraction = double(done) / double(std::max<int64_t>(1, mesh_.FaceCount()));
      if (!Report(progress, fraction, "cutting into charts")) throw Cancelled();
      std::vector<Chart> flat(open.size());
      std::vector<Refusal> refusals(open.size());
      ParallelForEach(int64_t(open.size()), 1, [&](int64_t i) {
        flat[size_t(i)] = this->TryToFlatten(open[size_t(i)], &refusals[size_t(i)]);
      });
      for (const Refusal& refusal : refusals) this->Narrow(refusal);
      std::vector<int32_t> children;
      for (size_t i = 0; i < open.size(); ++i) {
        if (flat[i].cornerCount > 0) {
          set_.charts.push_back(flat[i]);
          done += flat[i].faceCount;
          continue;
        }
        const int32_t child = tree_.nodes[size_t(open[i])].child;
        children.push_back(child);
        children.push_back(child + 1);
      }
      open = std::move(children);
    }
    std::sort(set_.charts.begin(), set_.charts.end(),
              [](const Chart& a, const Chart& b) { return a.firstFace < b.firstFace; });
    return std::move(set_);
  }

 private:
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

  /// The chart of a cluster; one without corners where it cannot be laid flat. What it may be
  /// refused for, where its extent was looked at.
  Chart TryToFlatten(int32_t index, Refusal* refusal) {
    const ClusterNode& node = tree_.nodes[size_t(index)];
    const ChartMesh mesh = MakeChartMesh(mesh_, neighbours_, node.firstFace, node.faceCount);
    Chart chart{index, node.firstFace, node.faceCount, int32_t(mesh.positions.size()), true};
    if (node.faceCount == 1) {
      this->Keep(chart, mesh, MapOfFace(mesh));
      return chart;
    }
    if (!mesh.IsFlat()) return {};

    // Seen along its normal, or else by a map that keeps angles.
    const Vec3d axis = Normalize(Vec3d(node.vectorArea));
    std::vector<Vec2d> map;
    const double limit = std::min(options_.stretch, kMostForeshortened);
    const bool isFacing = double(node.area) <= kMostForeshortened * double(Length(node.vectorArea));
    if (isFacing && axis != Vec3d()) map = ProjectedMap(mesh, axis);
    double stretch = map.empty() ? 0 : Stretch(mesh, map);
    if (!(stretch > 0 && stretch <= limit)) {
      chart.isProjected = false;
      map = ConformalMap(mesh);
      stretch = map.empty() ? 0 : Stretch(mesh, map);
      if (!(stretch > 0 && stretch <= options_.stretch)) return {};
    }
    *refusal = RefusalOf(mesh, map);
    if (refusal->IsFor(LongestOf(options_))) return {};
    if (!IsFull(map, double(node.area), options_.mostEmpty)) return {};
    chart.stretch = float(stretch);
    this->Keep(chart, mesh, map);
    return chart;
  }

  void Keep(const Chart& chart, const ChartMesh& mesh, const std::vector<Vec2d>& map) {
    Vec2d middle;
    for (const Vec2d& place : map) middle = middle + place * (1 / double(map.size()));
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
      const size_t face = size_t(chart.firstFace) + t;
      set_.corners[face] = mesh.triangles[t];
      for (size_t c = 0; c < 3; ++c) {
        set_.places[face][c] = Vec2f(map[size_t(mesh.triangles[t][c])] - middle);
      }
    }
  }

  const TriangleMesh& mesh_;
  const ClusterTree& tree_;
  const ChartOptions options_;
  const std::vector<int32_t> neighbours_;
  ChartSet set_;
};

}  // namespace

bool ChartSet::IsOf(const ChartOptions& other) const {
  return !charts.empty() && other.stretch == options.stretch &&
         other.mostEmpty == options.mostEmpty && LongestOf(other) >= leastLongest &&
         LongestOf(other) < mostLongest;
}

std::vector<int32_t> ChartOfFace(const ChartSet& set) {
  std::vector<int32_t> chartOfFace(set.places.size());
  for (size_t i = 0; i < set.charts.size(); ++i) {
    std::fill_n(chartOfFace.begin() + set.charts[i].firstFace, set.charts[i].faceCount, int32_t(i));
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
