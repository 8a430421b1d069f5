#include "Radiosity/Core/GatheredSolution.h"

#include "Common/Core/Random.h"
#include "Radiosity/Core/GatheredMesh.h"

namespace lambert {

namespace {

/// Bounces that leaves gather before points do.
constexpr uint64_t kLeafRounds = 4;

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
    if (!self.mesh->CutTriangles(error, self.rays)) break;
    self.mesh->GatherAtPoints(self.rays, progress);
  }
}

RadiositySolution GatheredSolution::Deliver() const { return implementation_->mesh->Deliver(); }

}  // namespace lambert
