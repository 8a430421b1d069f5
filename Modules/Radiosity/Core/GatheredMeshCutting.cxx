// Which triangles of a gathered solution are cut, and where.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"
#include "Radiosity/Core/GatheredMesh.h"
#include "Radiosity/Core/LightEdges.h"

namespace lambert {

namespace {

/// A round cuts at most this part of the triangles.
constexpr double kMostCut = 0.15;
/// Cutting ends at so many times the triangles of the beginning, or at the other where that is
/// more: light whose edges ask for still more of them is better left as it is.
constexpr double kMostGrowth = 3;
constexpr int64_t kMostTriangles = 300000;
/// A triangle whose error is more than this many times the threshold is cut twice in a round.
constexpr double kCutTwice = 4;
/// Changes of light up to this many times the variance of two points are taken for scatter.
constexpr double kScatter = 9;
/// An edge of light enters and leaves a patch with changes that are alike: the squared one is at
/// least this part of the other, and that of any third segment at most this part of the smaller.
constexpr double kAlike = 0.25, kThird = 0.25;
/// An edge is looked for down to this part of its patch's length; where it takes up more than the
/// other part of the patch's area it is no edge.
constexpr double kEdgeWidth = 1. / 32, kMostOfPatch = 1. / 3;
constexpr int kMostSteps = 8;
/// What stands on a patch is looked for where that is so many times as bright in one place as in
/// another. The strip along its foot is as wide as the length that rays skip: points ask for light
/// beside it, and nothing in it is seen.
constexpr double kContrast = 2;

}  // namespace

bool GatheredMesh::IsFull() const {
  return int64_t(mesh_.Triangles().size()) >
         std::max(kMostTriangles, int64_t(kMostGrowth * double(firstTriangles_)));
}

// Those that hold the most of the error, until what is left is what may be left.
std::vector<GatheredMesh::ChosenPatch> GatheredMesh::ChoosePatches(double wanted,
                                                                   double* threshold) {
  // What is to be gained from each triangle.
  const LightScale scale = this->MeasureLight();
  if (!(scale.mean > 0)) return {};
  const int64_t count = int64_t(mesh_.Triangles().size());
  std::vector<double> errors = this->Errors(scale);
  ParallelForEach(count, 1024, [&](int64_t t) {
    errors[size_t(t)] = this->IsAtFloor(t) ? 0 : errors[size_t(t)] / scale.area;
  });
  double total = 0;
  for (const double error : errors) total += error;
  const double allowed = wanted * wanted;
  if (total <= allowed) return {};
  std::vector<double> sorted = errors;
  std::sort(sorted.begin(), sorted.end(), std::greater<double>());
  const size_t most = size_t(kMostCut * double(count));
  double left = total;
  for (size_t i = 0; i < sorted.size(); ++i) {
    // A cut leaves about half of a jump's error.
    *threshold = sorted[i];
    if (left <= allowed / 2 || i >= most) break;
    left -= sorted[i];
  }

  // Their patches, each with all of its triangles.
  std::vector<ChosenPatch> chosen;
  std::unordered_map<int32_t, size_t> indexOfPatch;
  for (int64_t t = 0; t < count; ++t) {
    if (errors[size_t(t)] <= *threshold) continue;
    const int32_t patch = this->PatchOf(t);
    if (this->IsPatchAtFloor(patch)) continue;
    if (indexOfPatch.try_emplace(patch, chosen.size()).second) chosen.push_back({patch, 0, {}});
  }
  for (int64_t t = 0; t < count; ++t) {
    const LeafTriangle& triangle = mesh_.Triangles()[size_t(t)];
    const bool isWhole = triangle.patch < 0;
    const auto found = indexOfPatch.find(
        isWhole ? hierarchy_->Leaves().FindFacePatch(triangle.face, Side(triangle.side))
                : triangle.patch);
    if (found == indexOfPatch.end()) continue;
    ChosenPatch& own = chosen[found->second];
    own.triangles.push_back(t);
    own.error = std::max(own.error, errors[size_t(t)]);
  }
  return chosen;
}

// What the points of the parts would have been by interpolation.
void GatheredMesh::Remember(const std::vector<ChosenPatch>& chosen) {
  before_.assign(chosen.size(), {});
  for (size_t i = 0; i < chosen.size(); ++i) {
    for (const int64_t t : chosen[i].triangles) {
      std::array<Vec3f, 3> corners;
      std::array<Spectrum, 3> light;
      for (size_t c = 0; c < 3; ++c) {
        const size_t p = size_t(mesh_.PointsOfTriangles()[size_t(t)][c]);
        corners[c] = mesh_.Points()[p].position;
        light[c] = irradiance_[p];
      }
      before_[i].corners.push_back(corners);
      before_[i].light.push_back(light);
      before_[i].difference = std::max(before_[i].difference, this->Difference(t));
    }
  }
}

// Edges that only one of its triangles has.
std::vector<GatheredMesh::BorderSegment> GatheredMesh::BorderOf(
    const std::vector<int64_t>& triangles) const {
  std::map<std::array<int32_t, 2>, BorderSegment> border;
  for (const int64_t t : triangles) {
    const LeafTriangle& leaf = mesh_.Triangles()[size_t(t)];
    const auto& p = mesh_.PointsOfTriangles()[size_t(t)];
    const Vec3f front = hierarchy_->GetScene().mesh.FrontNormal(leaf.face);
    for (size_t c = 0; c < 3; ++c) {
      const size_t next = (c + 1) % 3;
      if (border.erase({p[next], p[c]}) > 0) continue;
      const double noise = double(variance_[size_t(p[c])]) + double(variance_[size_t(p[next])]);
      const double square = SquaredNorm(irradiance_[size_t(p[next])] - irradiance_[size_t(p[c])]);
      border[{p[c], p[next]}] = {{p[c], p[next]},
                                 {leaf.vertices[c], leaf.vertices[next]},
                                 leaf.side == kFront ? front : -front,
                                 std::max(0.0, square - kScatter * noise)};
    }
  }
  std::vector<BorderSegment> segments;
  for (const auto& [points, segment] : border) segments.push_back(segment);
  return segments;
}

// Patches on whose border light goes up in one place, down in another by about as much, and hardly
// changes elsewhere.
std::vector<GatheredMesh::Crossing> GatheredMesh::FindCrossings(
    const std::vector<ChosenPatch>& chosen, const std::vector<CutLines>& lines) const {
  std::vector<Crossing> crossings;
  for (size_t i = 0; i < chosen.size(); ++i) {
    if (lines[i]) continue;
    std::vector<BorderSegment> border = this->BorderOf(chosen[i].triangles);
    const size_t sorted = std::min<size_t>(3, border.size());
    std::partial_sort(border.begin(), border.begin() + int64_t(sorted), border.end(),
                      [](const BorderSegment& a, const BorderSegment& b) {
                        return a.change != b.change ? a.change > b.change : a.points < b.points;
                      });
    if (border.size() < 3 || !(border[1].change > 0)) continue;
    if (border[1].change < kAlike * border[0].change) continue;
    if (border[2].change > kThird * border[1].change) continue;
    const auto change = [&](const BorderSegment& s) {
      return irradiance_[size_t(s.points[1])] - irradiance_[size_t(s.points[0])];
    };
    const Spectrum up = change(border[0]), down = change(border[1]);
    if (up.r * down.r + up.g * down.g + up.b * down.b >= 0) continue;

    Crossing crossing{i, {}, 0, 0, {border[0], border[1]}, {}};
    Box3f box;
    for (const BorderSegment& s : border) {
      const Vec3f& position = mesh_.Points()[size_t(s.points[0])].position;
      crossing.middle += position / float(border.size());
      box.Include(position);
    }
    for (const int64_t t : chosen[i].triangles) crossing.area += this->Area(t);
    crossing.length = double(box.Diagonal());
    crossings.push_back(crossing);
  }
  return crossings;
}

// Two lines on both sides of each edge of light that crosses a patch for which there are none yet.
void GatheredMesh::FindEdges(const std::vector<ChosenPatch>& chosen, std::vector<CutLines>* lines,
                             int64_t* rays) const {
  // Where light changes on the borders; what two patches share is asked once.
  std::vector<Crossing> crossings = this->FindCrossings(chosen, *lines);
  std::vector<LitSegment> segments;
  std::map<std::array<int32_t, 2>, size_t> segmentOfPoints;
  for (Crossing& crossing : crossings) {
    for (size_t k = 0; k < 2; ++k) {
      const BorderSegment& border = crossing.segments[k];
      const int32_t from = std::min(border.points[0], border.points[1]);
      const int32_t to = std::max(border.points[0], border.points[1]);
      const auto [place, isNew] = segmentOfPoints.try_emplace({from, to}, segments.size());
      crossing.searched[k] = place->second;
      if (!isNew) continue;
      LitSegment segment{this->PlaceOf(from, crossing.middle, border.normal),
                         this->PlaceOf(to, crossing.middle, border.normal),
                         irradiance_[size_t(from)], irradiance_[size_t(to)], 0};
      double length = double(
          Length(mesh_.Points()[size_t(to)].position - mesh_.Points()[size_t(from)].position));
      for (; length > kEdgeWidth * crossing.length && segment.steps < kMostSteps; length /= 2) {
        ++segment.steps;
      }
      segments.push_back(segment);
    }
  }
  const std::vector<LightEdge> edges =
      FindLightEdges(gather_, segments, HashBits(seed_, mesh_.Points().size()), rays);

  // The line before what changes on the first segment, counter-clockwise, is the line behind it on
  // the second.
  for (const Crossing& crossing : crossings) {
    std::array<std::array<LeafBorderPlace, 2>, 2> places;  // By segment, in its direction.
    std::array<std::array<Vec3f, 2>, 2> positions;
    for (size_t k = 0; k < 2; ++k) {
      const BorderSegment& border = crossing.segments[k];
      const bool isForward = border.points[0] < border.points[1];
      LightEdge edge = edges[crossing.searched[k]];
      if (!isForward) edge = {1 - edge.high, 1 - edge.low};
      const Vec3f& a = mesh_.Points()[size_t(border.points[0])].position;
      const Vec3f& b = mesh_.Points()[size_t(border.points[1])].position;
      places[k][0] = {border.vertices[0], border.vertices[1], double(edge.low)};
      places[k][1] = {border.vertices[0], border.vertices[1], double(edge.high)};
      positions[k] = {a + (b - a) * edge.low, a + (b - a) * edge.high};
    }
    const double strip =
        0.5 *
        double(Length(Cross(positions[1][0] - positions[0][0], positions[1][1] - positions[0][1])));
    if (strip > kMostOfPatch * crossing.area) continue;
    (*lines)[crossing.chosen] = {LeafLine{places[0][0], places[1][1]},
                                 LeafLine{places[0][1], places[1][0]}};
  }
}

// Light at the corners of triangles, and in their middle where it was asked for.
std::vector<KnownLight> GatheredMesh::KnownIn(const std::vector<int64_t>& triangles) const {
  std::vector<KnownLight> places;
  std::vector<int32_t> points;
  for (const int64_t t : triangles) {
    const auto& corners = mesh_.PointsOfTriangles()[size_t(t)];
    points.insert(points.end(), corners.begin(), corners.end());
    const Middle* const middle = middleOfTriangle_[size_t(t)];
    if (middle) places.push_back({middle->position, middle->irradiance});
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  for (const int32_t p : points) {
    places.push_back({mesh_.Points()[size_t(p)].position, irradiance_[size_t(p)]});
  }
  return places;
}

// Before and behind the foot of what stands on a patch, where that tells light from dark.
GatheredMesh::CutLines GatheredMesh::FindContact(const ChosenPatch& chosen, int64_t* rays) const {
  // Whether there is light and dark.
  const std::vector<KnownLight> places = this->KnownIn(chosen.triangles);
  double least = std::numeric_limits<double>::max(), most = 0;
  for (const KnownLight& place : places) {
    const double light = std::sqrt(SquaredNorm(place.irradiance));
    least = std::min(least, light);
    most = std::max(most, light);
  }
  if (!(most > kContrast * least)) return {};

  // What stands there.
  const LeafTriangle& leaf = mesh_.Triangles()[size_t(chosen.triangles[0])];
  const Vec3f front = hierarchy_->GetScene().mesh.FrontNormal(leaf.face);
  const std::vector<ContactLine> lines =
      FindContactLines(gather_.Rays(), hierarchy_->Leaves().Corners(chosen.patch),
                       leaf.side == kFront ? front : -front, rays);
  const ContactLine* const line = TellingLine(lines, places);
  if (!line) return {};

  // Where both lines enter and leave; one may pass the patch by.
  std::vector<LeafLine> across;
  const std::vector<BorderSegment> border = this->BorderOf(chosen.triangles);
  for (const double offset : {-0.5 * double(skip_), 0.5 * double(skip_)}) {
    LeafLine ends;
    size_t found = 0;
    for (const BorderSegment& s : border) {
      std::array<double, 2> height;
      for (size_t k = 0; k < 2; ++k) {
        const Vec3f& position = mesh_.Points()[size_t(s.points[k])].position;
        height[k] = double(Dot(line->across, position - line->position)) - offset;
      }
      if ((height[0] > 0) == (height[1] > 0) || found == 2) continue;
      ends[found++] = {s.vertices[0], s.vertices[1], height[0] / (height[0] - height[1])};
    }
    if (found == 2) across.push_back(ends);
  }
  if (across.empty()) return {};
  return std::array<LeafLine, 2>{across.front(), across.back()};
}

std::vector<GatheredMesh::CutLines> GatheredMesh::FindContacts(
    const std::vector<ChosenPatch>& chosen, int64_t* rays) const {
  std::vector<CutLines> lines(chosen.size());
  std::vector<int64_t> cast(chosen.size(), 0);
  ParallelForEach(int64_t(chosen.size()), 16, [&](int64_t i) {
    lines[size_t(i)] = this->FindContact(chosen[size_t(i)], &cast[size_t(i)]);
  });
  for (const int64_t c : cast) *rays += c;
  return lines;
}

bool GatheredMesh::CutTriangles(double wanted, int64_t* rays) {
  double threshold = 0;
  const std::vector<ChosenPatch> chosen = this->ChoosePatches(wanted, &threshold);
  this->Remember(chosen);
  if (chosen.empty()) return false;
  std::vector<CutLines> lines = this->FindContacts(chosen, rays);
  this->FindEdges(chosen, &lines, rays);

  // Along a foot or an edge of light where there is one, else in halves.
  LeafMesh& leaves = hierarchy_->Leaves();
  std::vector<std::pair<int32_t, int32_t>> made;
  for (size_t i = 0; i < chosen.size(); ++i) {
    if (lines[i]) {
      for (const int32_t part : leaves.SplitAlong(chosen[i].patch, *lines[i])) {
        made.push_back({part, int32_t(i)});
      }
      continue;
    }
    for (const int32_t half : leaves.Split(chosen[i].patch)) {
      made.push_back({half, int32_t(i)});
      if (chosen[i].error < kCutTwice * threshold || this->IsPatchAtFloor(half)) continue;
      for (const int32_t quarter : leaves.Split(half)) made.push_back({quarter, int32_t(i)});
    }
  }
  beforeOfPatch_.assign(size_t(leaves.PatchCount()), -1);
  for (const auto& [patch, index] : made) beforeOfPatch_[size_t(patch)] = index;
  mesh_.Triangulate();
  this->RecallMiddles();
  return true;
}

}  // namespace lambert
