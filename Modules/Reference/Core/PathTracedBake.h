// Light at the vertices of a mesh by path tracing, as a method: what a light baker does, and what
// every other method is timed against.
#pragma once

#include <cstdint>

#include "Common/Core/Progress.h"
#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"

namespace lambert {

struct PathTracedBakeOptions {
  int samples = 256;  ///< paths a lit side of a vertex, [1, inf)
  uint64_t seed = 1;
};

/// Traces paths at the vertices of the mesh of `scene` as it is, each drawn a hair into its
/// triangles (VertexReceivers). Few paths first, on both sides of every vertex; the others only at
/// the corners of faces to whose side some of them bring light, or that emit there. Each lit side
/// is delivered, a back as a reversed copy; a face that light reaches on neither side is delivered
/// black, by its front. Points are shared by the faces of one surface (of one material, where the
/// mesh has no surfaces) and side; the radiosity of a point takes the mean reflectance and
/// emittance of its faces.
///
/// `statistics`, where given: patch elements are the sides of vertices that took all samples; one
/// entry of the history; no powers, which light at vertices does not tell. The light depends on the
/// options and the scene alone, for any number of threads. Throws Error for fewer than 1 sample and
/// for a mesh without normals, Cancelled.
RadiositySolution BakePathTraced(const Scene& scene, const PathTracedBakeOptions& options = {},
                                 SolverStatistics* statistics = nullptr,
                                 const ProgressCallback& progress = {});

}  // namespace lambert
