#include "Radiosity/Core/GatheredMesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "Common/Core/Barycentric.h"
#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"
#include "Radiosity/Core/MiddleTrends.h"
#include "Radiosity/Core/VertexFitting.h"

namespace lambert {

namespace {

/// Light is asked for this far toward the middle of the triangles at a point, so that corners do
/// not see through walls.
constexpr float kInset = 1e-3f, kMostInset = 0.1f;
/// At least this many times the length that rays skip: within it they would pass what they should
/// meet.
constexpr float kInsetOverSkip = 8;
/// Of the difference between a triangle's corners, the part that is taken for error before anything
/// is known: some of it is a slope, which interpolation gets right.
constexpr float kFirstNonlinearity = 0.7f;
constexpr float kLeastNonlinearity = 0.05f;
/// Differences up to this many times the variance of a triangle's corners are taken for scatter.
constexpr double kScatter = 3;
/// Of triangles that are alike at least so many, and one to so many, are asked in their middle;
/// those of which no others are may hold this part of the squared error that is wanted.
constexpr size_t kLeastProbes = 32, kProbedPart = 16;
constexpr double kUnprobedError = 0.1;
/// Errors below this part of the wanted one are alike.
constexpr double kLeastError = 1. / 64;
/// Tells the key of a triangle's middle from that of a point.
constexpr uint64_t kMiddle = 0x6d6964646c65;

}  // namespace

void GatheredMesh::GatherAtPoints(int64_t* rays, const ProgressCallback& progress) {
  // The points, each a little within its triangles.
  const std::vector<RefinedMesh::Point>& points = mesh_.Points();
  std::vector<GatheredPoints::Point> places(points.size());
  ParallelForEach(int64_t(points.size()), 1024, [&](int64_t p) {
    const RefinedMesh::Point& point = points[size_t(p)];
    places[size_t(p)] = {point.key, this->PlaceOf(int32_t(p), point.inside, point.insideNormal),
                         false};
  });
  for (size_t t = 0; t < mesh_.Triangles().size(); ++t) {
    const float share = this->Receives(int64_t(t)) ? float(this->Area(int64_t(t))) / 3 : 0;
    for (const int32_t p : mesh_.PointsOfTriangles()[t]) places[size_t(p)].at.area += share;
  }

  // Their light.
  const std::vector<GatheredPoints::Light> lights = gathered_.At(places, rays, progress);
  irradiance_.resize(points.size());
  variance_.resize(points.size());
  isNew_.resize(points.size());
  for (size_t p = 0; p < points.size(); ++p) {
    irradiance_[p] = lights[p].irradiance;
    variance_[p] = lights[p].variance;
    isNew_[p] = lights[p].isNew;
  }
}

// A point, drawn a little toward what lies inside.
GatherPoint GatheredMesh::PlaceOf(int32_t index, const Vec3f& inside, const Vec3f& normal) const {
  const RefinedMesh::Point& point = mesh_.Points()[size_t(index)];
  const Vec3f inward = inside - point.position;
  const float least = kInsetOverSkip * skip_ / std::max(Length(inward), 1e-30f);
  const Vec3f place = point.position + inward * std::min(kMostInset, std::max(kInset, least));
  return {place, point.normal, normal, 0};
}

// Largest squared difference between two corners, beyond what their scatter explains.
double GatheredMesh::Difference(int64_t triangle) const {
  const auto& p = mesh_.PointsOfTriangles()[size_t(triangle)];
  double most = 0;
  const double noise = double(variance_[size_t(p[0])]) + double(variance_[size_t(p[1])]) +
                       double(variance_[size_t(p[2])]);
  for (size_t c = 0; c < 3; ++c) {
    const Spectrum &a = irradiance_[size_t(p[c])], &b = irradiance_[size_t(p[(c + 1) % 3])];
    most = std::max(most, SquaredNorm(a - b));
  }
  return std::max(0.0, most - kScatter * noise);
}

double GatheredMesh::Area(int64_t triangle) const {
  const auto& p = mesh_.PointsOfTriangles()[size_t(triangle)];
  const std::vector<RefinedMesh::Point>& points = mesh_.Points();
  const Vec3f& a = points[size_t(p[0])].position;
  return 0.5 * double(Length(
                   Cross(points[size_t(p[1])].position - a, points[size_t(p[2])].position - a)));
}

// Squared relative error of interpolation as its corners tell it: a jump of height h somewhere in a
// triangle leaves about h^2 / 6 in the mean.
double GatheredMesh::ErrorOfCorners(int64_t triangle, const LightScale& scale) const {
  const int32_t patch = mesh_.Triangles()[size_t(triangle)].patch;
  const double part = patch >= 0 && size_t(patch) < nonlinearity_.size()
                          ? double(nonlinearity_[size_t(patch)])
                          : double(kFirstNonlinearity);
  return part * part * this->Difference(triangle) / 6 *
         ErrorWeight(this->DarkestLight(triangle), scale.mean, scale.meanSquare);
}

// The same times area; or what its middle tells, if that is more.
double GatheredMesh::Error(int64_t triangle, const LightScale& scale) const {
  double error = this->ErrorOfCorners(triangle, scale);
  if (const Middle* const middle = middleOfTriangle_[size_t(triangle)]) {
    error = std::max(error, this->ErrorOfMiddle(triangle, *middle, scale));
  }
  return this->Area(triangle) * error;
}

// Of every triangle; 0 where it does not count.
std::vector<double> GatheredMesh::Errors(const LightScale& scale) const {
  std::vector<double> errors(mesh_.Triangles().size(), 0);
  ParallelForEach(int64_t(errors.size()), 1024, [&](int64_t t) {
    if (this->Receives(t)) errors[size_t(t)] = this->Error(t, scale);
  });
  return errors;
}

// The same, not times area, as its middle tells it.
double GatheredMesh::ErrorOfMiddle(int64_t triangle, const Middle& middle,
                                   const LightScale& scale) const {
  const double darkest =
      std::min(this->DarkestLight(triangle), std::sqrt(SquaredNorm(middle.irradiance)));
  return middle.deviation * ErrorWeight(darkest, scale.mean, scale.meanSquare);
}

bool GatheredMesh::Receives(int64_t triangle) const {
  return receives_[size_t(mesh_.Triangles()[size_t(triangle)].face)];
}

uint64_t GatheredMesh::Key(int64_t triangle) const {
  uint64_t key = 0;
  for (const int32_t p : mesh_.PointsOfTriangles()[size_t(triangle)]) {
    key = HashBits(key, mesh_.Points()[size_t(p)].key);
  }
  return key;
}

// A triangle may hold a light or a shadow that none of its corners lies in. Of all that are alike
// in size, in what their corners tell, and in whether something lies close to them, some are asked
// in their middle, or in that place.
void GatheredMesh::ProbeSome(double wanted, int64_t* rays) {
  // Triangles that were not asked before, by an octave of area and of error, and by what is close.
  alike_.clear();
  const LightScale scale = this->MeasureLight();
  if (!(scale.mean > 0)) return;
  std::map<std::array<int, 3>, AlikeTriangles> classes;
  closePlaceOf_ = closePlaces_.InTriangles(mesh_, hierarchy_->Leaves());
  const std::vector<double> errors = this->Errors(scale);
  for (int64_t t = 0; t < int64_t(mesh_.Triangles().size()); ++t) {
    const double area = this->Area(t);
    if (!this->Receives(t) || !(area > 0) || middleOfTriangle_[size_t(t)]) continue;
    const double squared = errors[size_t(t)] / (area * wanted * wanted);
    const int error = int(std::floor(std::log2(std::max(squared, kLeastError * kLeastError)) / 2));
    const int isClose = closePlaceOf_[size_t(t)] ? 1 : 0;
    classes[{std::ilogb(area), error, isClose}].triangles.push_back(t);
  }

  // A few of each.
  std::vector<int64_t> few;
  for (auto& [key, alike] : classes) {
    std::vector<int64_t>& triangles = alike.triangles;
    std::sort(triangles.begin(), triangles.end(), [&](int64_t a, int64_t b) {
      const uint64_t hashA = HashBits(uint64_t(a)), hashB = HashBits(uint64_t(b));
      return hashA < hashB;
    });
    alike.asked =
        std::min(triangles.size(), std::max(kLeastProbes, triangles.size() / kProbedPart));
    few.insert(few.end(), triangles.begin(), triangles.begin() + int64_t(alike.asked));
    alike_.push_back(std::move(alike));
  }
  this->Probe(few, rays);
}

// All of those that have something to tell are asked, until those that are left hold too little to
// count.
void GatheredMesh::ProbeRest(double wanted, int64_t* rays) {
  const LightScale scale = this->MeasureLight();
  for (AlikeTriangles& alike : alike_) {
    for (size_t i = 0; i < alike.asked; ++i) {
      const int64_t t = alike.triangles[i];
      const double error = this->ErrorOfMiddle(t, *middleOfTriangle_[size_t(t)], scale);
      alike.error += this->Area(t) / scale.area * error / double(alike.asked);
    }
  }
  std::sort(alike_.begin(), alike_.end(), [](const AlikeTriangles& a, const AlikeTriangles& b) {
    return a.error != b.error ? a.error < b.error : a.triangles < b.triangles;
  });
  double left = 0;
  std::vector<int64_t> rest;
  for (const AlikeTriangles& alike : alike_) {
    left += alike.error * double(alike.triangles.size() - alike.asked);
    if (left < kUnprobedError * wanted * wanted) continue;
    rest.insert(rest.end(), alike.triangles.begin() + int64_t(alike.asked), alike.triangles.end());
  }
  alike_.clear();
  this->Probe(rest, rays);
}

// Those of triangles that were left as they are when others were cut.
void GatheredMesh::RecallMiddles() {
  middleOfTriangle_.resize(mesh_.Triangles().size());
  ParallelForEach(int64_t(mesh_.Triangles().size()), 1024, [&](int64_t t) {
    const auto probed = probed_.find(this->Key(t));
    middleOfTriangle_[size_t(t)] = probed != probed_.end() ? &probed->second : nullptr;
  });
}

// Of its corners.
Vec3f GatheredMesh::WeightsOfMiddle(int64_t triangle) const {
  const Vec3f middle{1.f / 3, 1.f / 3, 1.f / 3};
  const ClosePlace* const close = closePlaceOf_[size_t(triangle)];
  if (!close) return middle;
  const auto& p = mesh_.PointsOfTriangles()[size_t(triangle)];
  const auto at = [&](size_t corner) { return mesh_.Points()[size_t(p[corner])].position; };
  return BarycentricWeights(at(0), at(1), at(2), close->position).value_or(middle);
}

// How far the light in the middle of triangles is from what their corners interpolate.
void GatheredMesh::Probe(const std::vector<int64_t>& triangles, int64_t* rays) {
  std::vector<GatheredPoints::Point> places;
  for (const int64_t t : triangles) {
    GatherPoint place;
    const Vec3f weights = this->WeightsOfMiddle(t);
    for (size_t c = 0; c < 3; ++c) {
      const int32_t p = mesh_.PointsOfTriangles()[size_t(t)][c];
      const RefinedMesh::Point& point = mesh_.Points()[size_t(p)];
      place.position += point.position * weights[int(c)];
      place.normal += point.normal * weights[int(c)];
    }
    const LeafTriangle& leaf = mesh_.Triangles()[size_t(t)];
    const Vec3f front = hierarchy_->GetScene().mesh.FrontNormal(leaf.face);
    place.normal = Normalize(place.normal);
    place.geometricNormal = leaf.side == kFront ? front : -front;
    place.area = float(this->Area(t));
    places.push_back({HashBits(this->Key(t), kMiddle), place, true});
  }
  const std::vector<GatheredPoints::Light> gathered = gathered_.At(places, rays);
  for (size_t i = 0; i < triangles.size(); ++i) {
    const int64_t t = triangles[i];
    const Vec3f weights = this->WeightsOfMiddle(t);
    Spectrum expected;
    double noise = double(gathered[i].variance);
    for (size_t c = 0; c < 3; ++c) {
      const size_t p = size_t(mesh_.PointsOfTriangles()[size_t(t)][c]);
      const float weight = weights[int(c)];
      expected += irradiance_[p] * weight;
      noise += double(weight * weight) * double(variance_[p]);
    }
    const double deviation = SquaredNorm(gathered[i].irradiance - expected);
    Middle& middle = probed_[this->Key(t)];
    middleOfTriangle_[size_t(t)] = &middle;
    middle = {places[i].at.position, gathered[i].irradiance,
              std::max(0.0, deviation - kScatter * noise), !closePlaceOf_[size_t(t)]};
  }
}

// By the triangles whose middles were asked.
MiddleTrends GatheredMesh::FindTrends(const std::vector<MiddleTrends::Kind>& kinds) const {
  MiddleTrends trends;
  for (size_t t = 0; t < kinds.size(); ++t) {
    const Middle* const middle = middleOfTriangle_[t];
    if (!middle || !middle->isCentred) continue;
    trends.Add(kinds[t], double(middle->irradiance.Mean()),
               double(this->MeanOfCorners(int64_t(t)).Mean()));
  }
  return trends;
}

RadiositySolution GatheredMesh::Deliver() const {
  // What is not known in the middle of a triangle is what others tell that are alike.
  std::vector<FittedTriangle> triangles(mesh_.Triangles().size());
  std::vector<MiddleTrends::Kind> kinds(triangles.size());
  const LightScale scale = this->MeasureLight();
  ParallelForEach(int64_t(triangles.size()), 1024, [&](int64_t t) {
    const double error = scale.mean > 0 ? this->ErrorOfCorners(t, scale) : 0;
    kinds[size_t(t)] = MiddleTrends::KindOf(this->Area(t), error, this->IsNew(t));
  });
  const MiddleTrends trends = this->FindTrends(kinds);
  ParallelForEach(int64_t(triangles.size()), 1024, [&](int64_t t) {
    FittedTriangle& triangle = triangles[size_t(t)];
    triangle.points = mesh_.PointsOfTriangles()[size_t(t)];
    triangle.area = float(this->Area(t));
    const Middle* const middle = middleOfTriangle_[size_t(t)];
    const bool isKnown = middle && middle->isCentred;
    triangle.middle = isKnown ? middle->irradiance
                              : this->MeanOfCorners(t) * float(1 + trends.Of(kinds[size_t(t)]));
  });
  return mesh_.Deliver(FitVertices(irradiance_, triangles));
}

int32_t GatheredMesh::PatchOf(int64_t triangle) {
  const LeafTriangle& t = mesh_.Triangles()[size_t(triangle)];
  return t.patch >= 0 ? t.patch : hierarchy_->Leaves().FacePatch(t.face, Side(t.side));
}

// Nothing more is to be had from cutting it.
bool GatheredMesh::IsAtFloor(int64_t triangle) const {
  Box3f box;
  for (const int32_t p : mesh_.PointsOfTriangles()[size_t(triangle)]) {
    box.Include(mesh_.Points()[size_t(p)].position);
  }
  return box.Diagonal() < hierarchy_->Floor(mesh_.Triangles()[size_t(triangle)].face);
}

bool GatheredMesh::IsPatchAtFloor(int32_t patch) const {
  Box3f box;
  for (const Vec3f& corner : hierarchy_->Leaves().Corners(patch)) box.Include(corner);
  return box.Diagonal() < hierarchy_->Floor(hierarchy_->Leaves().PatchFace(patch));
}

// What the new points say of the interpolation that they replace.
void GatheredMesh::LearnNonlinearity() {
  nonlinearity_.resize(size_t(hierarchy_->Leaves().PatchCount()), kFirstNonlinearity);
  if (before_.empty()) return;
  std::vector<double> deviation(before_.size(), 0);
  const auto& triangles = mesh_.Triangles();
  for (size_t t = 0; t < triangles.size(); ++t) {
    const int32_t patch = triangles[t].patch;
    if (patch < 0 || beforeOfPatch_[size_t(patch)] < 0) continue;
    const size_t index = size_t(beforeOfPatch_[size_t(patch)]);
    const Before& before = before_[index];
    for (const int32_t p : mesh_.PointsOfTriangles()[t]) {
      if (!isNew_[size_t(p)]) continue;
      // In the triangle of before that holds it.
      const Vec3f& x = mesh_.Points()[size_t(p)].position;
      float most = std::numeric_limits<float>::lowest();
      Spectrum expected;
      for (size_t k = 0; k < before.corners.size(); ++k) {
        const auto& c = before.corners[k];
        const auto w = BarycentricWeights(c[0], c[1], c[2], x);
        const float least = w ? std::min({w->x, w->y, w->z}) : most;
        if (least <= most) continue;
        most = least;
        const auto& e = before.light[k];
        expected = e[0] * w->x + e[1] * w->y + e[2] * w->z;
      }
      deviation[index] = std::max(deviation[index], SquaredNorm(irradiance_[size_t(p)] - expected));
    }
  }
  for (size_t patch = 0; patch < beforeOfPatch_.size(); ++patch) {
    const int32_t index = beforeOfPatch_[patch];
    if (index < 0) continue;
    const double difference = before_[size_t(index)].difference;
    nonlinearity_[patch] =
        difference > 0
            ? std::min(1.f, std::max(kLeastNonlinearity,
                                     float(std::sqrt(deviation[size_t(index)] / difference))))
            : 1.f;
  }
}

// It came from the last cut: where most is wrong.
bool GatheredMesh::IsNew(int64_t triangle) const {
  const auto& points = mesh_.PointsOfTriangles()[size_t(triangle)];
  return std::any_of(points.begin(), points.end(), [&](int32_t p) { return isNew_[size_t(p)]; });
}

Spectrum GatheredMesh::MeanOfCorners(int64_t triangle) const {
  Spectrum mean;
  for (const int32_t p : mesh_.PointsOfTriangles()[size_t(triangle)]) {
    mean += irradiance_[size_t(p)] / 3.f;
  }
  return mean;
}

double GatheredMesh::MeanLight(int64_t triangle) const {
  double light = 0;
  for (const int32_t p : mesh_.PointsOfTriangles()[size_t(triangle)]) {
    light += std::sqrt(SquaredNorm(irradiance_[size_t(p)])) / 3;
  }
  return light;
}

// A bright triangle that a shadow ends in is wrong where it is dark.
double GatheredMesh::DarkestLight(int64_t triangle) const {
  double darkest = std::numeric_limits<double>::max();
  for (const int32_t p : mesh_.PointsOfTriangles()[size_t(triangle)]) {
    darkest = std::min(darkest, std::sqrt(SquaredNorm(irradiance_[size_t(p)])));
  }
  return darkest;
}

// Of what receives; what blazes counts as a multiple of the mean.
GatheredMesh::LightScale GatheredMesh::MeasureLight() const {
  LightScale scale;
  const size_t count = mesh_.Triangles().size();
  std::vector<double> areas(count, 0), lights(count, 0);
  ParallelForEach(int64_t(count), 1024, [&](int64_t t) {
    if (!this->Receives(t)) return;
    areas[size_t(t)] = this->Area(t);
    lights[size_t(t)] = this->MeanLight(t);
  });
  for (size_t t = 0; t < count; ++t) {
    scale.area += areas[t];
    scale.mean += areas[t] * lights[t];
  }
  if (!(scale.mean > 0)) return {};
  scale.mean /= scale.area;
  for (size_t t = 0; t < count; ++t) {
    const double light = std::min(lights[t], kBlazing * scale.mean);
    scale.meanSquare += areas[t] * light * light / scale.area;
  }
  return scale;
}

}  // namespace lambert
