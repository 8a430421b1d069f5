#include "Radiosity/Core/GatheredSolution.h"

#include "Common/Core/Random.h"
#include "Radiosity/Core/GatheredMesh.h"

namespace lambert {

namespace {

/// Bounces that leaves gather before points do: the first forget what links made of the light, the
/// mean of the others stays.
constexpr uint64_t kForgettingRounds = 5, kLeafRounds = 8;

}  // namespace

struct GatheredSolution::Implementation {
  Implementation(ElementHierarchy* hierarchy, ElementLight* light, const RayScene& rayScene,
                 const std::vector<uint8_t>& litSides, const GatheredSolutionOptions& options,
                 int64_t* rays_)
      : gather(*hierarchy, rayScene, light),
        leafRays(options.leafRays),
        seed(options.points.seed),
        rays(rays_) {
    for (uint64_t round = 1; round <= kLeafRounds && leafRays > 0; ++round) {
      this->GatherAtLeaves(round >= kForgettingRounds ? leafRays : leafRays / 2,
                           round <= kForgettingRounds, HashBits(seed, round));
    }
    mesh.reset(new GatheredMesh(hierarchy, gather, rayScene.Epsilon(), litSides, options.points));
  }

  /// Joins what they find to what they have, by rays; or forgets that.
  void GatherAtLeaves(int count, bool forgets, uint64_t roundSeed) {
    joinedRays = forgets ? count : joinedRays + count;
    gather.GatherAtLeaves(count, double(count) / joinedRays, roundSeed, rays);
  }

  FinalGather gather;
  std::unique_ptr<GatheredMesh> mesh;
  int leafRays;
  int joinedRays = 0;  ///< of the rounds that leaves have the mean of
  const uint64_t seed;
  uint64_t calls = 0;  ///< of Gather
  int64_t* rays;
};

GatheredSolution::GatheredSolution(ElementHierarchy* hierarchy, ElementLight* light,
                                   const RayScene& rayScene, const std::vector<uint8_t>& litSides,
                                   const GatheredSolutionOptions& options, int64_t* rays)
    : implementation_(new Implementation(hierarchy, light, rayScene, litSides, options, rays)) {}

GatheredSolution::~GatheredSolution() = default;

void GatheredSolution::Gather(double noise, const ProgressCallback& progress) {
  Implementation& self = *implementation_;
  if (self.calls++ > 0 && self.leafRays > 0) {
    self.leafRays *= 2;
    self.GatherAtLeaves(self.leafRays, false, HashBits(self.seed, kLeafRounds + self.calls));
  }
  self.mesh->Improve(noise, self.rays, progress);
  self.mesh->GatherAtPoints(self.rays, progress);
}

bool GatheredSolution::Cut(double error, const ProgressCallback& progress) {
  Implementation& self = *implementation_;
  if (self.mesh->IsFull()) return false;
  self.mesh->LearnNonlinearity();
  self.mesh->ProbeMiddles(error, self.rays);
  if (!self.mesh->CutTriangles(error, self.rays)) return false;
  self.mesh->GatherAtPoints(self.rays, progress);
  return true;
}

bool GatheredSolution::IsFull() const { return implementation_->mesh->IsFull(); }

RadiositySolution GatheredSolution::Deliver() const { return implementation_->mesh->Deliver(); }

}  // namespace lambert
