// Where the error of a solution sits: what it delivers in the middle of every triangle, against a
// path trace there.
#pragma once

#include <cstdint>
#include <vector>

#include "Common/Core/Progress.h"
#include "Reference/Core/PathTracedIrradiance.h"
#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"

namespace lambert {

struct ErrorMapOptions {
  int samples = 1024;  ///< paths a triangle, [2, inf), rounded up to a multiple of 16
  uint64_t seed = 1;
};

/// An entry a triangle of the solution's mesh, at its centroid.
struct ErrorMap {
  std::vector<IrradianceEstimate> reference;  ///< W/m2, for the interpolated normal
  /// Signed, below 0 where the solution is too dark: (E - Eref) / max(Eref, mean Eref), of the
  /// bands' means; the mean is over the receiving area of the mesh. It is the bounded error of the
  /// contract (SolutionError::bounded) before it is squared, with the reference's noise in it. 0 on
  /// faces that emit, which do not count unless all do.
  std::vector<float> relativeError;
};

/// Compares what `solution` delivers with a path trace of `scene`, whose mesh it solved. Sides that
/// it does not model are no triangles of it, and are not shown. Without light the error is 0.
/// Throws Error where the triangles do not lie on the faces of the scene that they name, and for
/// fewer than 2 samples; Cancelled.
ErrorMap MapError(const Scene& scene, const RadiositySolution& solution,
                  const ErrorMapOptions& options = {}, const ProgressCallback& progress = {});

}  // namespace lambert
