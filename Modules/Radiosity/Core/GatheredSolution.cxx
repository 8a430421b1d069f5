#include "Radiosity/Core/GatheredSolution.h"

#include <algorithm>

#include "Common/Core/Random.h"
#include "Common/Core/Timer.h"
#include "Radiosity/Core/FinalGather.h"
#include "Radiosity/Core/GatheredMesh.h"

namespace lambert {

namespace {

/// Rays of every point and of a leaf of mean area over the hemisphere, times the error; what their
/// scatter may leave, of the wanted error.
constexpr double kFirstRays = 0.4, kLeafRays = 3.2, kNoiseShare = 0.7;
constexpr int kLeastFirstRays = 2, kLeastLeafRays = 16, kMostLeafRays = 256;
/// No point casts more than so many times the rays of the first round.
constexpr int kMostOfFirst = 32;

/// Blotches are seen where the rest of a coarse solution is not: scatter is kept low there too.
constexpr double kMostNoise = 0.08;

/// Each round of cuts may add as much scatter as the first gather leaves. Where points of several
/// rounds are improved together, so many times that is what all may leave.
constexpr double kNoiseOfRounds = 1.5;

/// Points that are gathered at to predict how long all take, and the reserve for what they leave
/// out (leaves).
constexpr int64_t kTrialPoints = 1024;
constexpr double kTrialReserve = 1.2;

}  // namespace

double NoiseFor(double error) { return std::min(kMostNoise, kNoiseShare * error); }

GatheredSolutionOptions GatherFor(double error) {
  GatheredSolutionOptions options;
  options.leafRays = std::clamp(int(kLeafRays / error), kLeastLeafRays, kMostLeafRays);
  GatheredPointsOptions& points = options.points;
  points.noise = NoiseFor(error);
  points.firstRays = kLeastFirstRays;
  while (points.firstRays < kFirstRays / error) points.firstRays *= 2;
  points.mostRays = kMostOfFirst * points.firstRays;
  points.directRays = std::min(64, std::max(4, int(0.4 / error)));
  points.penumbraRays = std::min(256, std::max(6, int(0.6 / error)));
  return options;
}

double PredictGatherSeconds(const ElementHierarchy& hierarchy, const RayScene& rayScene,
                            const ElementLight& light, double error) {
  const TriangleMesh& mesh = hierarchy.GetScene().mesh;
  std::vector<GatheredPoints::Point> points;
  for (int64_t i = 0; i < kTrialPoints; ++i) {
    const int64_t face = mesh.FaceCount() * i / kTrialPoints;
    const Vec3f normal = mesh.FrontNormal(face);
    const Vec3f center = (mesh.Corner(face, 0) + mesh.Corner(face, 1) + mesh.Corner(face, 2)) / 3.f;
    points.push_back({uint64_t(i), {center, normal, normal}, false});
  }
  const Timer timer;
  ElementLight trial = light;
  int64_t rays = 0;
  const FinalGather gather(hierarchy, rayScene, &trial);
  GatheredPoints trialPoints(gather, GatherFor(error).points);
  trialPoints.At(points, &rays);
  const double all = double(mesh.PointCount()) + 2.0 * hierarchy.Leaves().PatchCount();
  return kTrialReserve * timer.Seconds() * all / kTrialPoints;
}

struct GatheredSolution::Implementation {
  Implementation(ElementHierarchy* hierarchy, ElementLight* light, const RayScene& rayScene,
                 const std::vector<uint8_t>& litSides, const GatheredSolutionOptions& options,
                 int64_t* rays_)
      : gather(*hierarchy, rayScene, light),
        leafRays(options.leafRays),
        seed(options.points.seed),
        rays(rays_) {
    if (leafRays > 0) gather.GatherAtLeaves(leafRays, 1, HashBits(seed, 1), rays);
    mesh.reset(new GatheredMesh(hierarchy, gather, rayScene.Epsilon(), litSides, options.points));
  }

  FinalGather gather;
  std::unique_ptr<GatheredMesh> mesh;
  int leafRays;  ///< of the rounds that leaves have the mean of
  const uint64_t seed;
  uint64_t improved = 0;  ///< so many times
  int64_t* rays;
};

GatheredSolution::GatheredSolution(ElementHierarchy* hierarchy, ElementLight* light,
                                   const RayScene& rayScene, const std::vector<uint8_t>& litSides,
                                   const GatheredSolutionOptions& options, int64_t* rays)
    : implementation_(new Implementation(hierarchy, light, rayScene, litSides, options, rays)) {}

GatheredSolution::~GatheredSolution() = default;

void GatheredSolution::Gather(const ProgressCallback& progress) {
  Implementation& self = *implementation_;
  self.mesh->GatherAtPoints(self.rays, progress);
}

void GatheredSolution::Improve(const GatheredPointsOptions& options,
                               const ProgressCallback& progress) {
  // Half as many as they had, joined to them.
  Implementation& self = *implementation_;
  const uint64_t improved = ++self.improved;
  if (self.leafRays > 0) {
    const int more = (self.leafRays + 1) / 2;
    self.leafRays += more;
    self.gather.GatherAtLeaves(more, double(more) / self.leafRays,
                               HashBits(self.seed, improved + 1), self.rays);
  }
  GatheredPointsOptions ofAll = options;
  ofAll.noise = kNoiseOfRounds * options.noise;
  self.mesh->Improve(ofAll, self.rays, progress);
  self.mesh->GatherAtPoints(self.rays, progress);
}

// What some middles tell counts at once, and where more are asked in the next round.
bool GatheredSolution::Cut(double error, const ProgressCallback& progress) {
  Implementation& self = *implementation_;
  if (self.mesh->IsFull()) return false;
  if (!self.mesh->HasProbedSome()) self.mesh->ProbeSome(error, self.rays);
  self.mesh->ProbeRest(error, self.rays);
  if (!self.mesh->CutTriangles(error, self.rays)) return false;
  self.mesh->GatherAtPoints(self.rays, progress);
  self.mesh->LearnNonlinearity();
  self.mesh->ProbeSome(error, self.rays);
  return true;
}

bool GatheredSolution::IsFull() const { return implementation_->mesh->IsFull(); }

RadiositySolution GatheredSolution::Deliver() const { return implementation_->mesh->Deliver(); }

}  // namespace lambert
