// The truth at the vertices of a scene, and how far a solution is from it there.
#pragma once

#include <string>
#include <vector>

#include "BenchScenes.h"
#include "Reference/Core/PathTracedIrradiance.h"
#include "Reference/Core/SolutionError.h"
#include "Reference/Core/VertexReceivers.h"
#include "Scene/Core/RadiositySolution.h"

namespace lambert {

struct BenchReferenceOptions {
  int receivers = 3000;  ///< vertices, a random choice of those that receive light, [1, inf)
  int paths = 4096;      ///< at each of them, [2, inf)
  uint64_t seed = 1;
  std::string folder;  ///< where references are kept for the next bench; empty: nowhere
};

/// Path-traced light at vertices, each on one side of a face of BenchScene::scene.
struct BenchReference {
  std::vector<VertexReceiver> receivers;
  std::vector<IrradianceEstimate> light;  ///< one a receiver
};

/// Traces the reference, or reads it where an earlier bench left one of the same scene and options.
/// Throws Error where the scene receives no light or the folder cannot be written.
BenchReference TraceBenchReference(const BenchScene& scene, const BenchReferenceOptions& options);

/// The error of `solution` at the receivers. It solved `scene.scene`, or `scene.Coarsest()` where
/// `ofCoarsest`. A receiver on a side that the solution does not model counts as 0.
SolutionError MeasureAtReceivers(const BenchScene& scene, const BenchReference& reference,
                                 const RadiositySolution& solution, bool ofCoarsest);

}  // namespace lambert
