// Matrix radiosity: all form factors between the elements of a uniform mesh, solved by Gauss-Seidel
// iteration (goral1984; thesis 3.1.1). Quadratic in time and memory: a baseline.
#pragma once

#include <cstdint>

#include "Common/Core/Progress.h"
#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"

namespace lambert {

struct MatrixRadiosityOptions {
  double elementSize = 0;   ///< longest edge of an element, m; 0: 1/50 of the scene's diagonal
  int visibilityRays = 4;   ///< rays between two elements that something may stand between, [1, 16]
  int skyRays = 256;        ///< rays to the sky an element, [1, inf)
  double tolerance = 1e-4;  ///< of the solution of the equations, relative, (0, 1)
  int64_t memoryLimit = int64_t(4) << 30;  ///< bytes that the form factors may take
};

/// Solves and delivers light at the vertices of the elements: the mean of the elements about each,
/// weighted by angle. `scene` needs point normals. Throws Error for options out of range and,
/// naming elements and bytes, where the form factors would not fit; Cancelled.
RadiositySolution SolveMatrixRadiosity(const Scene& scene,
                                       const MatrixRadiosityOptions& options = {},
                                       SolverStatistics* statistics = nullptr,
                                       const ProgressCallback& progress = {});

}  // namespace lambert
