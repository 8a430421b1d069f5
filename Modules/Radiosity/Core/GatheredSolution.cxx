#include "Radiosity/Core/GatheredSolution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
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
/// Triangles of more than this part of the receiving area are asked in their middle too.
constexpr double kProbedArea = 1.0 / 50000;
/// A round cuts at most this part of the triangles.
constexpr double kMostCut = 0.15;
/// Light beyond this many times the mean counts as that much: a lamp's socket must not take all
/// triangles.
constexpr double kBlazing = 20;
/// A triangle whose error is more than this many times the threshold is cut twice in a round.
constexpr double kCutTwice = 4;

double SquaredNorm(const Spectrum& s) {
  return double(s.r) * s.r + double(s.g) * s.g + double(s.b) * s.b;
}

/// The cut mesh and its light, from round to round.
class GatheredMesh {
 public:
  GatheredMesh(ElementHierarchy* hierarchy, const FinalGather& gather, float skip,
               const std::vector<uint8_t>& litSides, const FinalGatherOptions& options)
      : hierarchy_(hierarchy),
        gather_(gather),
        skip_(skip),
        options_(options),
        mesh_(hierarchy, litSides) {}

  void GatherAtNewPoints(int64_t* rays, const ProgressCallback& progress);
  void LearnNonlinearity();
  void ProbeLargeTriangles(int64_t* rays);
  bool CutTriangles(double wanted);
  RadiositySolution Deliver() const { return mesh_.Deliver(irradiance_); }

 private:
  /// A patch that was cut in this round, as it was: what its points would have interpolated.
  struct Before {
    std::vector<std::array<Vec3f, 3>> corners;
    std::vector<std::array<Spectrum, 3>> light;
    double difference = 0;  ///< largest squared difference between the corners of a triangle
  };

  double Difference(int64_t triangle) const;
  double Error(int64_t triangle) const;
  double Area(int64_t triangle) const;
  uint64_t Key(int64_t triangle) const;
  bool Receives(int64_t triangle) const;
  int32_t PatchOf(int64_t triangle);
  bool IsAtFloor(int32_t patch) const;

  ElementHierarchy* hierarchy_;
  const FinalGather& gather_;
  const float skip_;  ///< length that rays skip, m
  const FinalGatherOptions options_;
  RefinedMesh mesh_;
  std::unordered_map<uint64_t, GatheredLight> known_;
  std::vector<Spectrum> irradiance_;             ///< per point
  std::vector<float> variance_;                  ///< per point, of the irradiance
  std::unordered_map<uint64_t, double> probed_;  ///< by triangle: squared deviation in its middle
  std::vector<uint8_t> isNew_;                   ///< per point: gathered in this round
  std::vector<float> nonlinearity_;              ///< per patch
  std::vector<Before> before_;
  std::vector<int32_t> beforeOfPatch_;  ///< per patch: of the one it was cut from in this round; -1
};

void GatheredMesh::GatherAtNewPoints(int64_t* rays, const ProgressCallback& progress) {
  // The points that no round before has seen.
  const std::vector<RefinedMesh::Point>& points = mesh_.Points();
  irradiance_.assign(points.size(), {});
  variance_.assign(points.size(), 0);
  isNew_.assign(points.size(), 0);
  std::vector<float> areas(points.size(), 0);
  for (size_t t = 0; t < mesh_.Triangles().size(); ++t) {
    const float share = float(this->Area(int64_t(t))) / 3;
    for (const int32_t p : mesh_.PointsOfTriangles()[t]) areas[size_t(p)] += share;
  }
  std::vector<GatherPoint> places;
  std::vector<size_t> owners;
  for (size_t p = 0; p < points.size(); ++p) {
    const auto found = known_.find(points[p].key);
    if (found != known_.end()) {
      irradiance_[p] = found->second.irradiance;
      variance_[p] = found->second.variance;
      continue;
    }
    const RefinedMesh::Point& point = points[p];
    const Vec3f inward = point.inside - point.position;
    const float least = kInsetOverSkip * skip_ / std::max(Length(inward), 1e-30f);
    places.push_back({point.position + inward * std::min(kMostInset, std::max(kInset, least)),
                      point.normal, point.insideNormal, areas[p]});
    owners.push_back(p);
    isNew_[p] = 1;
  }

  // Their light.
  const auto gathered = gather_.At(places, options_, rays, progress);
  for (size_t i = 0; i < owners.size(); ++i) {
    irradiance_[owners[i]] = gathered[i].irradiance;
    variance_[owners[i]] = gathered[i].variance;
    known_[points[owners[i]].key] = gathered[i];
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

// Squared error of interpolation times area: a jump of height h somewhere in a triangle leaves
// about h^2 / 6 in the mean.
double GatheredMesh::Error(int64_t triangle) const {
  const int32_t patch = mesh_.Triangles()[size_t(triangle)].patch;
  const double part = patch >= 0 && size_t(patch) < nonlinearity_.size()
                          ? double(nonlinearity_[size_t(patch)])
                          : double(kFirstNonlinearity);
  const double known = part * part * this->Difference(triangle) / 6;
  const auto probed = probed_.find(this->Key(triangle));
  return this->Area(triangle) * std::max(known, probed == probed_.end() ? 0 : probed->second);
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

// Large triangles may hold a shadow that none of their corners lies in: they are asked in their
// middle.
void GatheredMesh::ProbeLargeTriangles(int64_t* rays) {
  const int64_t count = int64_t(mesh_.Triangles().size());
  double area = 0;
  for (int64_t t = 0; t < count; ++t) area += this->Receives(t) ? this->Area(t) : 0;
  std::vector<GatherPoint> places;
  std::vector<int64_t> owners;
  for (int64_t t = 0; t < count; ++t) {
    if (!this->Receives(t) || this->Area(t) < kProbedArea * area || probed_.count(this->Key(t))) {
      continue;
    }
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
    places.push_back(place);
    owners.push_back(t);
  }
  const auto gathered = gather_.At(places, options_, rays);
  for (size_t i = 0; i < owners.size(); ++i) {
    Spectrum expected;
    double noise = double(gathered[i].variance);
    for (const int32_t p : mesh_.PointsOfTriangles()[size_t(owners[i])]) {
      expected += irradiance_[size_t(p)] / 3.f;
      noise += double(variance_[size_t(p)]) / 9;
    }
    const double deviation = SquaredNorm(gathered[i].irradiance - expected);
    probed_[this->Key(owners[i])] = std::max(0.0, deviation - kScatter * noise);
  }
}

int32_t GatheredMesh::PatchOf(int64_t triangle) {
  const LeafTriangle& t = mesh_.Triangles()[size_t(triangle)];
  return t.patch >= 0 ? t.patch : hierarchy_->Leaves().FacePatch(t.face, Side(t.side));
}

bool GatheredMesh::IsAtFloor(int32_t patch) const {
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

// Cuts the triangles that hold the most of the error, until what is left is what may be left.
bool GatheredMesh::CutTriangles(double wanted) {
  // Area and light of what receives.
  const int64_t count = int64_t(mesh_.Triangles().size());
  std::vector<double> areas(size_t(count), 0), lights(size_t(count), 0);
  double area = 0, mean = 0;
  for (int64_t t = 0; t < count; ++t) {
    if (!this->Receives(t)) continue;
    areas[size_t(t)] = this->Area(t);
    for (const int32_t p : mesh_.PointsOfTriangles()[size_t(t)]) {
      lights[size_t(t)] += std::sqrt(SquaredNorm(irradiance_[size_t(p)])) / 3;
    }
    area += areas[size_t(t)];
    mean += areas[size_t(t)] * lights[size_t(t)];
  }
  if (!(mean > 0)) return false;
  mean /= area;

  // Errors as fractions of the whole: of the mean square, where what blazes counts as a multiple of
  // the mean, and of each place's own light.
  double square = 0;
  for (int64_t t = 0; t < count; ++t) {
    const double light = std::min(lights[size_t(t)], kBlazing * mean);
    square += areas[size_t(t)] * light * light;
  }
  std::vector<double> errors(size_t(count), 0);
  double total = 0;
  for (int64_t t = 0; t < count; ++t) {
    if (!(areas[size_t(t)] > 0)) continue;
    const double light = lights[size_t(t)];
    const double calm = std::min(1.0, kBlazing * mean / std::max(light, mean));
    const double error = this->Error(t);
    const double bound = std::max(light, mean);
    errors[size_t(t)] = std::max(error * calm * calm / square, error / (bound * bound * area));
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
    if (this->IsAtFloor(patch)) continue;
    for (const int32_t half : hierarchy_->Leaves().Split(patch)) {
      made.push_back({half, index});
      if (error < kCutTwice * threshold || this->IsAtFloor(half)) continue;
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
      : gather(*hierarchy, rayScene, light), rays(rays_) {
    for (uint64_t round = 0; round < 2 && options.leafRays > 0; ++round) {
      gather.GatherAtLeaves(options.leafRays, HashBits(options.gather.seed, round), rays);
    }
    mesh.reset(new GatheredMesh(hierarchy, gather, rayScene.Epsilon(), litSides, options.gather));
  }

  FinalGather gather;
  std::unique_ptr<GatheredMesh> mesh;
  int64_t* rays;
};

GatheredSolution::GatheredSolution(ElementHierarchy* hierarchy, ElementLight* light,
                                   const RayScene& rayScene, const std::vector<uint8_t>& litSides,
                                   const GatheredSolutionOptions& options, int64_t* rays)
    : implementation_(new Implementation(hierarchy, light, rayScene, litSides, options, rays)) {}

GatheredSolution::~GatheredSolution() = default;

void GatheredSolution::Refine(double error, int rounds, const ProgressCallback& progress) {
  Implementation& self = *implementation_;
  self.mesh->GatherAtNewPoints(self.rays, progress);
  for (int round = 0; round < rounds; ++round) {
    self.mesh->LearnNonlinearity();
    self.mesh->ProbeLargeTriangles(self.rays);
    if (!self.mesh->CutTriangles(error)) break;
    self.mesh->GatherAtNewPoints(self.rays, progress);
  }
}

RadiositySolution GatheredSolution::Deliver() const { return implementation_->mesh->Deliver(); }

}  // namespace lambert
