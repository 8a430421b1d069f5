#include "Atlas/Core/RadiosityAtlas.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "Atlas/Core/ChartPacking.h"
#include "Atlas/Core/TexelRaster.h"
#include "Clustering/Core/ClusterFrame.h"
#include "Common/Core/Barycentric.h"
#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Common/Core/Timer.h"

namespace lambert {

namespace {

/// The part of the pages that charts are first thought to fill.
constexpr double kFirstFill = 0.7;
/// A chart may leave so much empty of its rectangle, of the area of all.
constexpr double kMostEmpty = 0.01;
/// Attempts at the size of the texels that fills the pages.
constexpr int kAttempts = 10;
/// Charts among which the next one is chosen at most, and about how often any is looked at in all.
constexpr size_t kMostWindow = 128, kLooks = 130000;
/// A way of packing that fills so much more than the best is not tried again.
constexpr double kBehind = 1.05;
/// The part of the pages that the next attempt aims at.
constexpr double kSafety = 0.99;
/// Texels a metre of the next attempt where all seems full, by those of the best: at least, at
/// most. It is good enough where it has this part of those that were too many.
constexpr double kStep = 1.0025, kStride = 1.01, kLeastFill = 0.9975;
/// Pages that an atlas may have where its texels' size is given.
constexpr int kMostPages = 256;
/// Texels around a chart that are its own, whatever the padding; and those by which it may be off,
/// as texture coordinates are in single precision.
constexpr double kLeastMargin = 0.5, kRounding = 1. / 256;
/// Texels at the edge of a chart that it touches in part.
constexpr double kTouched = 0.5;
/// Texels of a level that a lookup there takes in at most, to one side of its place.
constexpr double kReach = 1.5;

/// Texels around a chart that it takes.
double Margin(const AtlasOptions& options) {
  return std::max(kLeastMargin, double(PaddingOf(options))) + kRounding;
}

/// Texels a metre: those asked for, or as many as charts of `area`, m2, may fill the pages with.
double FirstDensity(const AtlasOptions& options, double area) {
  if (options.texelSize > 0) return 1 / options.texelSize;
  const double texels = kFirstFill * options.pages * double(options.pageSize) * options.pageSize;
  return area > 0 ? std::sqrt(texels / area) : 1;
}

/// A chart turned into its smallest rectangle.
struct Rectangle {
  Vec2d axis, low;  ///< its longer side; the corner that its texels begin at, along the sides
  double width = 0, height = 0;  ///< m

  Vec2d Inside(const Vec2f& place) const {
    const Vec2d p(place);
    return {p.x * axis.x + p.y * axis.y - low.x, p.y * axis.x - p.x * axis.y - low.y};
  }
};

Rectangle RectangleOf(const ChartSet& set, const Chart& chart) {
  std::vector<Vec2f> points;
  for (const int32_t f : set.FacesOf(chart)) {
    for (const Vec2f& place : set.places[size_t(f)]) points.push_back(place);
  }
  Rectangle rectangle;
  rectangle.axis = Vec2d(MinimumAreaRectangle(points).axis);
  Vec2d low = rectangle.Inside(points.front()), high = low;
  for (const Vec2f& point : points) {
    const Vec2d p = rectangle.Inside(point);
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  rectangle.low = low;
  rectangle.width = high.x - low.x;
  rectangle.height = high.y - low.y;
  return rectangle;
}

using Edge = std::array<Vec2d, 2>;

/// Edges of a single face of the chart, along the sides of its rectangle, m.
std::vector<Edge> BorderOf(const ChartSet& set, const Chart& chart, const Rectangle& rectangle) {
  struct Side {
    int32_t low, high;  ///< corners of the chart
    Edge edge;
    bool IsAlong(const Side& other) const { return low == other.low && high == other.high; }
  };
  std::vector<Side> sides;
  for (const int32_t face : set.FacesOf(chart)) {
    const auto& corners = set.corners[size_t(face)];
    const auto& places = set.places[size_t(face)];
    for (size_t c = 0; c < 3; ++c) {
      const size_t next = (c + 1) % 3;
      const auto [low, high] = std::minmax(corners[c], corners[next]);
      sides.push_back({low, high, {rectangle.Inside(places[c]), rectangle.Inside(places[next])}});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high) < std::tie(b.low, b.high);
  });
  std::vector<Edge> border;
  for (size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].IsAlong(sides[begin])) ++end;
    if (end - begin == 1) border.push_back(sides[begin].edge);
  }
  return border;
}

/// Charts at a number of texels a metre.
class Layout {
 public:
  Layout(const ChartSet& set, const AtlasOptions& options) : set_(set), options_(options) {
    rectangles_.resize(set.charts.size());
    borders_.resize(set.charts.size());
    ParallelForEach(int64_t(set.charts.size()), 16, [&](int64_t i) {
      const Chart& chart = set.charts[size_t(i)];
      rectangles_[size_t(i)] = RectangleOf(set, chart);
      borders_[size_t(i)] = BorderOf(set, chart, rectangles_[size_t(i)]);
    });
    for (const Rectangle& r : rectangles_) longest_ = std::max(longest_, r.width);
    for (const auto& p : set.places) {
      const Vec2d u(p[1] - p[0]), v(p[2] - p[0]);
      area_ += 0.5 * std::abs(u.x * v.y - u.y * v.x);
    }
  }

  /// Texels a metre at which the longest chart still fits on a page.
  double MostDensity() const { return longest_ > 0 ? LongestChart(options_) / longest_ : 1; }
  double Area() const { return area_; }
  size_t ChartCount() const { return set_.charts.size(); }

  /// Throws Error where a chart is longer than a page, or all take too many pages.
  void RequireRoom(double density) const {
    const double page = double(options_.pageSize) * options_.pageSize;
    if (longest_ > 0 && density > this->MostDensity()) {
      throw Error("A chart of " + std::to_string(longest_) + " m is longer than a page of " +
                  std::to_string(options_.pageSize) +
                  " texels; take larger pages or larger texels.");
    }
    if (area_ * density * density > kMostPages * page) {
      throw Error("Texels so small would take more than " + std::to_string(kMostPages) +
                  " pages; take larger ones or larger pages.");
    }
  }

  Packing Pack(double density, const PackingWay& way) const {
    return PackCharts(this->Charts(density), options_.pageSize, way);
  }
  std::vector<Packing> Pack(double density, const std::vector<PackingWay>& ways) const {
    const std::vector<TurnedChart> charts = this->Charts(density);
    std::vector<Packing> packed(ways.size());
    ParallelForEach(int64_t(ways.size()), 1, [&](int64_t i) {
      packed[size_t(i)] = PackCharts(charts, options_.pageSize, ways[size_t(i)]);
    });
    return packed;
  }
  /// Pages and parts of one that are full.
  double Fill(const Packing& packing) const {
    return packing.pages - 1 + double(packing.lastHeight) / double(options_.pageSize);
  }

  /// By how much `density` may grow so that charts take `factor` times as many texels as they do in
  /// `packing`: those within them by its square, those around them in proportion.
  double Growth(double density, const Packing& packing, double factor) const {
    const double taken = double(packing.takenTexels), within = area_ * density * density;
    const double around = std::max(0., taken - within);
    if (!(within > 0)) return std::sqrt(factor);
    return (std::sqrt(around * around + 4 * within * factor * taken) - around) / (2 * within);
  }

  /// Texels from the lower left corner of what the chart takes, amid which it lies.
  Vec2d TexelsOf(size_t chart, const Vec2f& place, double density) const {
    return rectangles_[chart].Inside(place) * density + this->Corner(chart, density);
  }
  /// The texels that it takes in all.
  std::array<int, 2> Size(size_t chart, double density) const {
    const double margin = 2 * Margin(options_);
    return {int(std::ceil(rectangles_[chart].width * density + margin)),
            int(std::ceil(rectangles_[chart].height * density + margin))};
  }

 private:
  std::vector<TurnedChart> Charts(double density) const {
    std::vector<TurnedChart> charts(set_.charts.size());
    ParallelForEach(int64_t(charts.size()), 16, [&](int64_t i) {
      charts[size_t(i)] = TurnFourWays(this->Mask(size_t(i), density));
    });
    return charts;
  }

  /// Of its rectangle amid the texels that it takes.
  Vec2d Corner(size_t chart, double density) const {
    const Rectangle& r = rectangles_[chart];
    const std::array<int, 2> size = this->Size(chart, density);
    return Vec2d(size[0] - r.width * density, size[1] - r.height * density) * 0.5;
  }

  // The border takes the texels that it touches, and those of the padding around them; what is not
  // near it lies within or without.
  ChartMask Mask(size_t index, double density) const {
    const auto [width, height] = this->Size(index, density);
    const Vec2d corner = this->Corner(index, density);
    std::vector<Edge> border = borders_[index];
    ChartMask mask(width, height);
    for (Edge& edge : border) {
      edge = {edge[0] * density + corner, edge[1] * density + corner};
      ForEachCrossing(edge[0], edge[1], [&](int x, int y) { mask.Cross(x, y); });
    }
    mask.FillBetweenCrossings();
    for (const Edge& edge : border) {
      ForEachColumnNear(edge, Margin(options_), width, height,
                        [&](int x, int low, int high) { mask.Take(x, low, high); });
    }
    return mask;
  }

  const ChartSet& set_;
  const AtlasOptions& options_;
  std::vector<Rectangle> rectangles_;
  std::vector<std::vector<Edge>> borders_;
  double longest_ = 0, area_ = 0;
};

void RequireAtlasOptions(const AtlasOptions& options) {
  if (options.pageSize < 16 || options.pageSize > 16384) {
    throw Error("A page of an atlas has 16 to 16384 texels along a side.");
  }
  if (options.pages < 1) throw Error("An atlas has at least one page.");
  if (!(options.texelSize >= 0 && std::isfinite(options.texelSize))) {
    throw Error("The size of a texel is 0 m or more.");
  }
  if (options.mipLevels < 0 || options.mipLevels > 5) {
    throw Error("Charts are kept apart for 0 to 5 levels of mip maps.");
  }
  if (options.padding < 0 || options.padding > 64 || 4 * options.padding > options.pageSize) {
    throw Error("The padding of a chart is 0 to 64 texels, and a quarter of a page at most.");
  }
  if (4 * PaddingOf(options) > options.pageSize) {
    throw Error(std::to_string(options.mipLevels) + " levels of mip maps need a padding of " +
                std::to_string(PaddingOf(options)) +
                " texels, over a quarter of a page; take larger pages or fewer levels.");
  }
}

/// Charts among which the next one is chosen, where there are so many.
int WindowFor(size_t charts) {
  return int(std::min(kMostWindow, std::max<size_t>(1, kLooks / std::max<size_t>(1, charts))));
}

/// One chart after the other.
std::vector<PackingWay> SimpleWays() {
  return {{PackingOrder::Widest, 1},
          {PackingOrder::LargestArea, 1},
          {PackingOrder::LargestPerimeter, 1},
          {PackingOrder::Longest, 1}};
}
/// And with a choice of the next one, which takes longest.
std::vector<PackingWay> AllWays(size_t charts) {
  const std::vector<PackingWay> simple = SimpleWays();
  std::vector<PackingWay> ways = {{PackingOrder::Widest, WindowFor(charts), 1},
                                  {PackingOrder::LargestArea, WindowFor(charts), 1}};
  ways.insert(ways.end(), simple.begin(), simple.end());
  return ways;
}

/// Those that fill no more.
void KeepWaysUpTo(double most, const std::vector<double>& fills, std::vector<PackingWay>* ways) {
  std::vector<PackingWay> kept;
  for (size_t i = 0; i < ways->size(); ++i) {
    if (fills[i] <= most) kept.push_back((*ways)[i]);
  }
  *ways = std::move(kept);
}

/// The smallest texels whose charts do not need more pages than there may be.
double FillPages(const Layout& layout, const AtlasOptions& options, Packing* packing,
                 const ProgressCallback& progress) {
  double density = std::min(layout.MostDensity(), FirstDensity(options, layout.Area())), best = 0;
  double tooDense = std::numeric_limits<double>::max();
  std::vector<PackingWay> ways = AllWays(layout.ChartCount());
  for (int attempt = 0; attempt < kAttempts && best < layout.MostDensity(); ++attempt) {
    const double fraction = 0.6 + 0.4 * double(attempt) / kAttempts;
    if (!Report(progress, fraction, "packing charts")) throw Cancelled();
    // At first only what is quick, to tell about how much fits; then what does not fall behind.
    std::vector<Packing> all = layout.Pack(density, attempt == 0 ? SimpleWays() : ways);
    std::vector<double> fills;
    fills.reserve(all.size());
    for (const Packing& each : all) fills.push_back(layout.Fill(each));
    const size_t lowest = size_t(std::min_element(fills.begin(), fills.end()) - fills.begin());
    const double fill = fills[lowest];
    Packing packed = std::move(all[lowest]);
    if (attempt > 0) KeepWaysUpTo(kBehind * fill, fills, &ways);
    const double next = density * layout.Growth(density, packed, kSafety * options.pages / fill);
    if (packed.pages <= options.pages) {
      best = density;
      *packing = std::move(packed);
    } else if (attempt > 0) {
      tooDense = density;
    }
    if (best > kLeastFill * tooDense) break;
    // As this attempt was full, or else between what fitted and what did not.
    const bool isBetween = next > kStep * best && next < tooDense;
    const double middle = 0.5 * (best + tooDense);
    density = isBetween ? next : best > 0 ? std::min(middle, kStride * best) : middle;
    density = std::min(layout.MostDensity(), density);
  }
  return best;
}

}  // namespace

bool AtlasOptions::operator==(const AtlasOptions& other) const {
  return std::tie(stretch, pageSize, pages, texelSize, padding, mipLevels, density) ==
         std::tie(other.stretch, other.pageSize, other.pages, other.texelSize, other.padding,
                  other.mipLevels, other.density);
}

int PaddingOf(const AtlasOptions& options) {
  if (options.mipLevels == 0) return options.padding;
  return std::max(options.padding, int(std::ceil(kReach * std::exp2(options.mipLevels))));
}

int LongestChart(const AtlasOptions& options) {
  return options.pageSize - 2 * PaddingOf(options) - 2;
}

ChartOptions ChartOptionsOf(const ClusterTree& tree, const AtlasOptions& options) {
  RequireAtlasOptions(options);
  double area = 0;
  for (const int32_t root : tree.surfaceRoots) area += double(tree.nodes[size_t(root)].area);

  // None longer than a page, where the texels are as small as they will be about.
  ChartOptions chartOptions;
  chartOptions.stretch = options.stretch;
  chartOptions.longest = LongestChart(options) / FirstDensity(options, area);
  chartOptions.mostEmpty = kMostEmpty * area;
  chartOptions.margin = (Margin(options) + kTouched) / FirstDensity(options, area);
  return chartOptions;
}

RadiosityAtlas MakeRadiosityAtlas(const TriangleMesh& mesh, const ClusterTree& tree,
                                  const AtlasOptions& options, const ProgressCallback& progress) {
  const ChartOptions chartOptions = ChartOptionsOf(tree, options);
  Timer timer;
  ChartSet set = CutIntoCharts(mesh, tree, chartOptions, [&](double fraction, const char* stage) {
    return Report(progress, 0.6 * fraction, stage);
  });
  const double chartSeconds = timer.Seconds();
  RadiosityAtlas atlas = PackAtlas(std::move(set), options, progress);
  atlas.chartSeconds = chartSeconds;
  return atlas;
}

RadiosityAtlas PackAtlas(ChartSet set, const AtlasOptions& options,
                         const ProgressCallback& progress) {
  RequireAtlasOptions(options);
  RadiosityAtlas atlas;
  atlas.set = std::move(set);

  // How large texels are, and where charts lie at that.
  Timer timer;
  const Layout layout(atlas.set, options);
  Packing packing;
  double density = 0;
  if (options.texelSize > 0) {
    density = 1 / options.texelSize;
    layout.RequireRoom(density);
    packing = layout.Pack(density, {PackingOrder::Widest, WindowFor(layout.ChartCount()), 1});
  } else if (!atlas.set.charts.empty()) {
    density = FillPages(layout, options, &packing, progress);
    if (!(density > 0)) {
      throw Error("The " + std::to_string(atlas.set.charts.size()) + " charts do not fit on " +
                  std::to_string(options.pages) + " page(s) of " +
                  std::to_string(options.pageSize) + " texels; give more or larger pages.");
    }
  }

  // Their places on the pages.
  atlas.pages = packing.pages;
  atlas.pageSize = options.pageSize;
  atlas.padding = PaddingOf(options);
  atlas.texelSize = density > 0 ? 1 / density : 0;
  atlas.pageOfChart.resize(atlas.set.charts.size());
  atlas.textureCoords.resize(atlas.set.places.size());
  ParallelForEach(int64_t(atlas.set.charts.size()), 16, [&](int64_t i) {
    const Chart& chart = atlas.set.charts[size_t(i)];
    const ChartPlace& place = packing.places[size_t(i)];
    atlas.pageOfChart[size_t(i)] = place.page;
    for (const int32_t f : atlas.set.FacesOf(chart)) {
      for (size_t c = 0; c < 3; ++c) {
        Vec2d p = layout.TexelsOf(size_t(i), atlas.set.places[size_t(f)][c], density);
        std::array<int, 2> size = layout.Size(size_t(i), density);
        for (int turn = 0; turn < place.turns; ++turn) {
          p = {size[1] - p.y, p.x};
          std::swap(size[0], size[1]);
        }
        atlas.textureCoords[size_t(f)][c] =
            Vec2f((p + Vec2d(place.x, place.y)) * (1 / double(options.pageSize)));
      }
    }
  });
  if (atlas.pages > 0) {
    atlas.utilisation = layout.Area() * density * density /
                        (double(atlas.pages) * options.pageSize * options.pageSize);
  }
  atlas.packSeconds = timer.Seconds();
  return atlas;
}

std::vector<Vec2f> SplitAtCharts(const RadiosityAtlas& atlas, TriangleMesh* mesh,
                                 std::vector<int64_t>* points) {
  TriangleMesh split;
  std::vector<Vec2f> textureCoords;
  std::vector<std::array<int32_t, 3>> triangles(mesh->triangles.size());
  std::map<std::array<int32_t, 2>, int32_t> pointOfCorner;  // By place in the chart and old point.
  for (const Chart& chart : atlas.set.charts) {
    pointOfCorner.clear();
    for (const int32_t face : atlas.set.FacesOf(chart)) {
      const size_t f = size_t(face);
      for (size_t c = 0; c < 3; ++c) {
        const int32_t old = mesh->triangles[f][c];
        const auto [place, isNew] = pointOfCorner.try_emplace({atlas.set.corners[f][c], old},
                                                              int32_t(split.positions.size()));
        triangles[f][c] = place->second;
        if (!isNew) continue;
        split.positions.push_back(mesh->positions[size_t(old)]);
        if (!mesh->normals.empty()) split.normals.push_back(mesh->normals[size_t(old)]);
        if (!mesh->uvs.empty()) split.uvs.push_back(mesh->uvs[size_t(old)]);
        textureCoords.push_back(atlas.textureCoords[f][c]);
        if (points) points->push_back(old);
      }
    }
  }
  mesh->positions = std::move(split.positions);
  mesh->normals = std::move(split.normals);
  mesh->uvs = std::move(split.uvs);
  mesh->triangles = std::move(triangles);
  return textureCoords;
}

std::array<float, 3> WeightsInFace(const TriangleMesh& mesh, int64_t face, const Vec3f& place) {
  const Vec3d p(place), a(mesh.Corner(face, 0)), b(mesh.Corner(face, 1)), c(mesh.Corner(face, 2));
  const Vec3d weights = BarycentricWeights(a, b, c, p).value_or(Vec3d{1, 0, 0});
  return {float(weights.x), float(weights.y), float(weights.z)};
}

Vec2f PlaceOnPage(const TriangleMesh& mesh, const RadiosityAtlas& atlas, int64_t face,
                  const Vec3f& place) {
  const std::array<float, 3> w = WeightsInFace(mesh, face, place);
  const auto& corners = atlas.textureCoords[size_t(face)];
  return corners[0] * w[0] + corners[1] * w[1] + corners[2] * w[2];
}

std::vector<int32_t> FacesOfTexels(const RadiosityAtlas& atlas, int page) {
  const int size = atlas.pageSize;
  std::vector<int32_t> faces(size_t(size) * size_t(size), -1);
  for (size_t i = 0; i < atlas.set.charts.size(); ++i) {
    if (atlas.pageOfChart[i] != page) continue;
    const Chart& chart = atlas.set.charts[i];
    for (const int32_t f : atlas.set.FacesOf(chart)) {
      std::array<Vec2d, 3> corners;
      for (size_t c = 0; c < 3; ++c) {
        corners[c] = Vec2d(atlas.textureCoords[size_t(f)][c]) * double(size);
      }
      ForEachTexelOf(corners, size,
                     [&](int x, int y) { faces[size_t(y) * size_t(size) + size_t(x)] = f; });
    }
  }
  return faces;
}

}  // namespace lambert
