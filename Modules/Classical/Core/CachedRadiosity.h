// The modern baseline: light cached by elements, found by paths, and gathered at the points by
// rays that end in the cache. What light-map bakers do, as fast and as right as it gets.
#pragma once

#include <cstdint>

#include "Common/Core/Progress.h"
#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"

namespace lambert {

struct CachedRadiosityOptions {
  double elementSize = 0;  ///< of cells, m, [0, inf); 0: 1/50 of the scene's diagonal
  double outputSize = 0;   ///< longest edge of the output, m, [0, inf); 0: the element size. A very
                           ///< large one leaves the mesh as it is.
  int paths = 32;          ///< of each lit side of a cell, [1, inf)
  int gatherRays = 64;     ///< of each output point, [1, inf)
  int emitterRays = 16;    ///< of each output point, to emitting faces, [1, inf)
  uint64_t seed = 1;
};

/// Light at the scene's points and those of its uniform mesh, on lit sides. Deterministic for any
/// number of threads. Throws Error for options without meaning and for elements too small to be
/// held, Cancelled.
RadiositySolution SolveCachedRadiosity(const Scene& scene,
                                       const CachedRadiosityOptions& options = {},
                                       SolverStatistics* statistics = nullptr,
                                       const ProgressCallback& progress = {});

}  // namespace lambert
