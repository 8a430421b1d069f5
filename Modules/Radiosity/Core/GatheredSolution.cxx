#include "Radiosity/Core/GatheredSolution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <unordered_map>

#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"
#include "Radiosity/Core/RefinedMesh.h"

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
/// Bounces that leaves gather before points do.
constexpr uint64_t kLeafRounds = 4;
/// Of the triangles of a size at least so many, and one to so many, are asked in their middle; all
/// are where they hold more than this part of the squared error that is wanted.
constexpr size_t kLeastProbes = 32, kProbedPart = 16;
constexpr double kProbedError = 0.05;
/// Tells the key of a triangle's middle from that of a point.
constexpr uint64_t kMiddle = 0x6d6964646c65;
/// A round cuts at most this part of the triangles.
constexpr double kMostCut = 0.15;
/// Cutting ends at so many times the triangles of the beginning, or at the other where that is
/// more: light whose edges ask for still more of them is better left as it is.
constexpr double kMostGrowth = 3;
constexpr int64_t kMostTriangles = 300000;
/// A triangle whose error is more than this many times the threshold is cut twice in a round.
constexpr double kCutTwice = 4;

/// The cut mesh and its light, from round to round.
class GatheredMesh {
 public:
  GatheredMesh(ElementHierarchy* hierarchy, const FinalGather& gather, float skip,
               const std::vector<uint8_t>& litSides, const GatheredPointsOptions& options)
      : hierarchy_(hierarchy),
        gathered_(gather, options),
        skip_(skip),
        mesh_(hierarchy, litSides),
        firstTriangles_(int64_t(mesh_.Triangles().size())) {}

  void GatherAtPoints(int64_t* rays, const ProgressCallback& progress);
  void Improve(double noise, int64_t* rays, const ProgressCallback& progress) {
    gathered_.Improve(noise, rays, progress);
  }
  void LearnNonlinearity();
  void ProbeMiddles(double wanted, int64_t* rays);
  bool CutTriangles(double wanted);
  RadiositySolution Deliver() const { return mesh_.Deliver(irradiance_); }

 private:
  /// A patch that was cut in this round, as it was: what its points would have interpolated.
  struct Before {
    std::vector<std::array<Vec3f, 3>> corners;
    std::vector<std::array<Spectrum, 3>> light;
    double difference = 0;  ///< largest squared difference between the corners of a triangle
  };

  /// Of what receives: its area, m2, mean irradiance and mean square (W/m2, norm over bands).
  struct LightScale {
    double area = 0, mean = 0, meanSquare = 0;
  };
  LightScale MeasureLight() const;
  double MeanLight(int64_t triangle) const;
  void Probe(const std::vector<int64_t>& triangles, int64_t* rays);
  double Difference(int64_t triangle) const;
  double Error(int64_t triangle, const LightScale& scale) const;
  double Area(int64_t triangle) const;
  uint64_t Key(int64_t triangle) const;
  bool Receives(int64_t triangle) const;
  int32_t PatchOf(int64_t triangle);
  bool IsAtFloor(int64_t triangle) const;
  bool IsPatchAtFloor(int32_t patch) const;

  ElementHierarchy* hierarchy_;
  GatheredPoints gathered_;
  const float skip_;  ///< length that rays skip, m
  RefinedMesh mesh_;
  const int64_t firstTriangles_;
  std::vector<Spectrum> irradiance_;  ///< per point
  std::vector<float> variance_;       ///< per point, of the irradiance
  /// What is found in the middle of a triangle: its squared deviation from what the corners
  /// interpolate, and the norm of the irradiance, W/m2.
  struct Middle {
    double deviation = 0, light = 0;
  };
  std::unordered_map<uint64_t, Middle> probed_;  ///< by triangle
  std::vector<uint8_t> isNew_;                   ///< per point: gathered in this round
  std::vector<float> nonlinearity_;              ///< per patch
  std::vector<Before> before_;
  std::vector<int32_t> beforeOfPatch_;  ///< per patch: of the one it was cut from in this round; -1
};

void GatheredMesh::GatherAtPoints(int64_t* rays, const ProgressCallback& progress) {
  // The points, each a little within its largest triangle.
  const std::vector<RefinedMesh::Point>& points = mesh_.Points();
  std::vector<GatheredPoints::Point> places(points.size());
  ParallelForEach(int64_t(points.size()), 1024, [&](int64_t p) {
    const RefinedMesh::Point& point = points[size_t(p)];
    const Vec3f inward = point.inside - point.position;
    const float least = kInsetOverSkip * skip_ / std::max(Length(inward), 1e-30f);
    const Vec3f place = point.position + inward * std::min(kMostInset, std::max(kInset, least));
    places[size_t(p)] = {point.key, {place, point.normal, point.insideNormal, 0}};
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

// Squared relative error of interpolation times area: a jump of height h somewhere in a triangle
// leaves about h^2 / 6 in the mean; or what its middle tells, if that is more.
double GatheredMesh::Error(int64_t triangle, const LightScale& scale) const {
  const int32_t patch = mesh_.Triangles()[size_t(triangle)].patch;
  const double part = patch >= 0 && size_t(patch) < nonlinearity_.size()
                          ? double(nonlinearity_[size_t(patch)])
                          : double(kFirstNonlinearity);
  const double light = this->MeanLight(triangle);
  double error = part * part * this->Difference(triangle) / 6 *
                 ErrorWeight(light, scale.mean, scale.meanSquare);
  const auto probed = probed_.find(this->Key(triangle));
  if (probed != probed_.end()) {
    const double brightest = std::max(light, probed->second.light);
    error = std::max(
        error, probed->second.deviation * ErrorWeight(brightest, scale.mean, scale.meanSquare));
  }
  return this->Area(triangle) * error;
}

bool GatheredMesh::Receives(int64_t triangle) const {
  const LeafTriangle& leaf = mesh_.Triangles()[size_t(triangle)];
  return !hierarchy_->GetScene().mesh.Emits(leaf.face, Side(leaf.side));
}

uint64_t GatheredMesh::Key(int64_t triangle) const {
  uint64_t key = 0;
  for (const int32_t p : mesh_.PointsOfTriangles()[size_t(triangle)]) {
    key = HashBits(key, mesh_.Points()[size_t(p)].key);
  }
  return key;
}

// A triangle may hold a light or a shadow that none of its corners lies in. Of every size some are
// asked in their middle; where those tell of an error that counts, all of that size are.
void GatheredMesh::ProbeMiddles(double wanted, int64_t* rays) {
  // Triangles by size, an octave of area a class; those that were asked before stay as they are.
  const LightScale scale = this->MeasureLight();
  if (!(scale.mean > 0)) return;
  std::map<int, std::vector<int64_t>> classes;
  for (int64_t t = 0; t < int64_t(mesh_.Triangles().size()); ++t) {
    if (!this->Receives(t) || !(this->Area(t) > 0) || probed_.count(this->Key(t))) continue;
    classes[std::ilogb(this->Area(t))].push_back(t);
  }

  // A few of each.
  std::vector<int64_t> few;
  std::map<int, std::pair<size_t, size_t>> fewOfClass;
  for (auto& [size, triangles] : classes) {
    std::sort(triangles.begin(), triangles.end(), [&](int64_t a, int64_t b) {
      const uint64_t hashA = HashBits(uint64_t(a)), hashB = HashBits(uint64_t(b));
      return hashA < hashB;
    });
    const size_t count =
        std::min(triangles.size(), std::max(kLeastProbes, triangles.size() / kProbedPart));
    fewOfClass[size] = {few.size(), few.size() + count};
    few.insert(few.end(), triangles.begin(), triangles.begin() + int64_t(count));
  }
  this->Probe(few, rays);

  // All of the classes that have something to tell.
  std::vector<int64_t> rest;
  for (const auto& [size, triangles] : classes) {
    const auto& [begin, end] = fewOfClass[size];
    double error = 0;
    for (size_t i = begin; i < end; ++i) {
      const Middle& middle = probed_[this->Key(few[i])];
      const double light = std::max(middle.light, this->MeanLight(few[i]));
      error += this->Area(few[i]) / scale.area * middle.deviation *
               ErrorWeight(light, scale.mean, scale.meanSquare);
    }
    error *= double(triangles.size()) / double(end - begin);
    if (error < kProbedError * wanted * wanted) continue;
    rest.insert(rest.end(), triangles.begin() + int64_t(end - begin), triangles.end());
  }
  this->Probe(rest, rays);
}

// How far the light in the middle of triangles is from what their corners interpolate.
void GatheredMesh::Probe(const std::vector<int64_t>& triangles, int64_t* rays) {
  std::vector<GatheredPoints::Point> places;
  for (const int64_t t : triangles) {
    GatherPoint place;
    for (const int32_t p : mesh_.PointsOfTriangles()[size_t(t)]) {
      const RefinedMesh::Point& point = mesh_.Points()[size_t(p)];
      place.position += point.position / 3.f;
      place.normal += point.normal;
    }
    const LeafTriangle& leaf = mesh_.Triangles()[size_t(t)];
    const Vec3f front = hierarchy_->GetScene().mesh.FrontNormal(leaf.face);
    place.normal = Normalize(place.normal);
    place.geometricNormal = leaf.side == kFront ? front : -front;
    place.area = float(this->Area(t));
    places.push_back({HashBits(this->Key(t), kMiddle), place});
  }
  const std::vector<GatheredPoints::Light> gathered = gathered_.At(places, rays);
  for (size_t i = 0; i < triangles.size(); ++i) {
    Spectrum expected;
    double noise = double(gathered[i].variance);
    for (const int32_t p : mesh_.PointsOfTriangles()[size_t(triangles[i])]) {
      expected += irradiance_[size_t(p)] / 3.f;
      noise += double(variance_[size_t(p)]) / 9;
    }
    const double deviation = SquaredNorm(gathered[i].irradiance - expected);
    probed_[this->Key(triangles[i])] = {std::max(0.0, deviation - kScatter * noise),
                                        std::sqrt(SquaredNorm(gathered[i].irradiance))};
  }
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
        const Vec3f normal = Cross(c[1] - c[0], c[2] - c[0]);
        const float square = LengthSquared(normal);
        if (!(square > 0)) continue;
        const float w1 = Dot(Cross(x - c[0], c[2] - c[0]), normal) / square;
        const float w2 = Dot(Cross(c[1] - c[0], x - c[0]), normal) / square;
        const float least = std::min({1 - w1 - w2, w1, w2});
        if (least <= most) continue;
        most = least;
        const auto& e = before.light[k];
        expected = e[0] * (1 - w1 - w2) + e[1] * w1 + e[2] * w2;
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

double GatheredMesh::MeanLight(int64_t triangle) const {
  double light = 0;
  for (const int32_t p : mesh_.PointsOfTriangles()[size_t(triangle)]) {
    light += std::sqrt(SquaredNorm(irradiance_[size_t(p)])) / 3;
  }
  return light;
}

// Of what receives; what blazes counts as a multiple of the mean.
GatheredMesh::LightScale GatheredMesh::MeasureLight() const {
  LightScale scale;
  const int64_t count = int64_t(mesh_.Triangles().size());
  for (int64_t t = 0; t < count; ++t) {
    if (!this->Receives(t)) continue;
    scale.area += this->Area(t);
    scale.mean += this->Area(t) * this->MeanLight(t);
  }
  if (!(scale.mean > 0)) return {};
  scale.mean /= scale.area;
  for (int64_t t = 0; t < count; ++t) {
    if (!this->Receives(t)) continue;
    const double light = std::min(this->MeanLight(t), kBlazing * scale.mean);
    scale.meanSquare += this->Area(t) * light * light / scale.area;
  }
  return scale;
}

// Cuts the triangles that hold the most of the error, until what is left is what may be left.
bool GatheredMesh::CutTriangles(double wanted) {
  // What errors are measured by.
  const LightScale scale = this->MeasureLight();
  if (!(scale.mean > 0)) return false;
  const int64_t count = int64_t(mesh_.Triangles().size());
  if (count > std::max(kMostTriangles, int64_t(kMostGrowth * double(firstTriangles_))))
    return false;
  std::vector<double> errors(size_t(count), 0);
  double total = 0;
  for (int64_t t = 0; t < count; ++t) {
    if (!this->Receives(t) || this->IsAtFloor(t)) continue;
    errors[size_t(t)] = this->Error(t, scale) / scale.area;
    total += errors[size_t(t)];
  }
  const double allowed = wanted * wanted;
  if (total <= allowed) return false;
  std::vector<double> sorted = errors;
  std::sort(sorted.begin(), sorted.end(), std::greater<double>());
  const size_t most = size_t(kMostCut * double(count));
  double left = total, threshold = 0;
  for (size_t i = 0; i < sorted.size(); ++i) {
    // A cut leaves about half of a jump's error.
    threshold = sorted[i];
    if (left <= allowed / 2 || i >= most) break;
    left -= sorted[i];
  }

  // The patches, each with its triangles as they are.
  std::unordered_map<int32_t, std::pair<int32_t, double>> chosen;
  before_.clear();
  std::vector<int32_t> order;
  for (int64_t t = 0; t < count; ++t) {
    if (errors[size_t(t)] <= threshold) continue;
    const int32_t patch = this->PatchOf(t);
    if (chosen.count(patch)) continue;
    chosen[patch] = {int32_t(order.size()), errors[size_t(t)]};
    order.push_back(patch);
  }
  before_.resize(order.size());
  for (int64_t t = 0; t < count; ++t) {
    const LeafTriangle& triangle = mesh_.Triangles()[size_t(t)];
    const int32_t patch = triangle.patch >= 0 ? triangle.patch
                                              : hierarchy_->Leaves().FindFacePatch(
                                                    triangle.face, Side(triangle.side));
    const auto found = patch >= 0 ? chosen.find(patch) : chosen.end();
    if (found == chosen.end()) continue;
    Before& before = before_[size_t(found->second.first)];
    found->second.second = std::max(found->second.second, errors[size_t(t)]);
    std::array<Vec3f, 3> corners;
    std::array<Spectrum, 3> corner;
    for (size_t c = 0; c < 3; ++c) {
      const size_t p = size_t(mesh_.PointsOfTriangles()[size_t(t)][c]);
      corners[c] = mesh_.Points()[p].position;
      corner[c] = irradiance_[p];
    }
    before.corners.push_back(corners);
    before.light.push_back(corner);
    before.difference = std::max(before.difference, this->Difference(t));
  }

  // Cut.
  std::vector<std::pair<int32_t, int32_t>> made;
  for (const int32_t patch : order) {
    const auto& [index, error] = chosen[patch];
    if (this->IsPatchAtFloor(patch)) continue;
    for (const int32_t half : hierarchy_->Leaves().Split(patch)) {
      made.push_back({half, index});
      if (error < kCutTwice * threshold || this->IsPatchAtFloor(half)) continue;
      for (const int32_t quarter : hierarchy_->Leaves().Split(half))
        made.push_back({quarter, index});
    }
  }
  beforeOfPatch_.assign(size_t(hierarchy_->Leaves().PatchCount()), -1);
  for (const auto& [patch, index] : made) beforeOfPatch_[size_t(patch)] = index;
  if (made.empty()) return false;
  mesh_.Triangulate();
  return true;
}

}  // namespace

struct GatheredSolution::Implementation {
  Implementation(ElementHierarchy* hierarchy, ElementLight* light, const RayScene& rayScene,
                 const std::vector<uint8_t>& litSides, const GatheredSolutionOptions& options,
                 int64_t* rays_)
      : gather(*hierarchy, rayScene, light),
        leafRays(options.leafRays),
        seed(options.points.seed),
        rays(rays_) {
    // What links made of the light is forgotten over some bounces; the last decides how it
    // scatters.
    for (uint64_t round = 1; round <= kLeafRounds && leafRays > 0; ++round) {
      gather.GatherAtLeaves(round == kLeafRounds ? leafRays : leafRays / 2, HashBits(seed, round),
                            rays);
    }
    mesh.reset(new GatheredMesh(hierarchy, gather, rayScene.Epsilon(), litSides, options.points));
  }

  FinalGather gather;
  std::unique_ptr<GatheredMesh> mesh;
  int leafRays;
  const uint64_t seed;
  uint64_t calls = 0;  ///< of Refine
  int64_t* rays;
};

GatheredSolution::GatheredSolution(ElementHierarchy* hierarchy, ElementLight* light,
                                   const RayScene& rayScene, const std::vector<uint8_t>& litSides,
                                   const GatheredSolutionOptions& options, int64_t* rays)
    : implementation_(new Implementation(hierarchy, light, rayScene, litSides, options, rays)) {}

GatheredSolution::~GatheredSolution() = default;

void GatheredSolution::Refine(double error, double noise, int rounds,
                              const ProgressCallback& progress) {
  Implementation& self = *implementation_;
  if (self.calls++ > 0) {
    self.leafRays *= 2;
    self.gather.GatherAtLeaves(self.leafRays, HashBits(self.seed, kLeafRounds + self.calls),
                               self.rays);
  }
  self.mesh->Improve(noise, self.rays, progress);
  self.mesh->GatherAtPoints(self.rays, progress);
  for (int round = 0; round < rounds; ++round) {
    self.mesh->LearnNonlinearity();
    self.mesh->ProbeMiddles(error, self.rays);
    if (!self.mesh->CutTriangles(error)) break;
    self.mesh->GatherAtPoints(self.rays, progress);
  }
}

RadiositySolution GatheredSolution::Deliver() const { return implementation_->mesh->Deliver(); }

}  // namespace lambert
