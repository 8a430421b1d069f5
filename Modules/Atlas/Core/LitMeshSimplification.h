// Fewer triangles for the same light: the mesh that refinement left, decimated where light is even
// (willmott2000, 3.5.1 and 9.3.3).
#pragma once

#include <cstdint>

#include "Common/Core/Progress.h"
#include "Scene/Core/RadiositySolution.h"

namespace lambert {

struct LitMeshSimplificationOptions {
  /// By how much irradiance and radiosity may change anywhere, (0, 1]: in every band a fraction of
  /// what is delivered there or of the mean of the mesh, whichever is more (the means of the
  /// bands), as the bounded error counts it.
  double tolerance = 0.02;
};

struct LitMeshSimplificationStatistics {
  int64_t trianglesBefore = 0, trianglesAfter = 0;
  int64_t pointsBefore = 0, pointsAfter = 0;
};

/// Takes points out of `solution` while the light that is interpolated between those left stays
/// within the tolerance, and the surface where it is: a point goes only inside one face of the
/// solved mesh, along the straight edge between two, or along a free one. Corners of that mesh
/// stay. Borders stay closed: two surfaces that meet in an edge lose a point of it together, where
/// light allows it on both; where more meet, or two are wound against each other, points of the
/// edge stay. Points that are left keep all that they had, triangles their face, side and
/// materials; `leafId` is empty, since a triangle then spans several leaves. Triangles that are no
/// part of a manifold stay as they are. The result does not depend on threads. Throws Error for a
/// tolerance out of range; Cancelled.
RadiositySolution SimplifyLitMesh(const RadiositySolution& solution,
                                  const LitMeshSimplificationOptions& options = {},
                                  LitMeshSimplificationStatistics* statistics = nullptr,
                                  const ProgressCallback& progress = {});

}  // namespace lambert
