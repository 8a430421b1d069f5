// Some surfaces of a solved scene, as a scene of their own.
#pragma once

#include <vector>

#include "Clustering/Core/FaceClustering.h"
#include "Common/Core/TriangleMesh.h"
#include "Scene/Core/RadiositySolution.h"

namespace lambert {

struct SurfaceSubset {
  TriangleMesh mesh;  ///< the faces of the surfaces, in the order of `tree`
  ClusterTree tree;   ///< surfaces are numbered anew, in their order
  RadiositySolution
      solution;  ///< its triangles on these faces, and their points; no inputIrradiance
  std::vector<int64_t> inputFace;  ///< by face: of the solved mesh
};

/// The surfaces s for which `isTaken[s]`. `mesh` is in the order of `tree`.
SurfaceSubset TakeSurfaces(const TriangleMesh& mesh, const ClusterTree& tree,
                           const RadiositySolution& solution, const std::vector<char>& isTaken);

/// Puts the tree of a surface behind those of `to`, on faces from `firstFace` on.
void AppendTree(const ClusterTree& tree, size_t surface, int32_t firstFace, ClusterTree* to);

/// The faces of `mesh` that are named, in that order, with the points that they use.
TriangleMesh TakeFaces(const TriangleMesh& mesh, const std::vector<int64_t>& faces,
                       std::vector<int64_t>* points = nullptr);

/// The triangles of `solution` that are named, in that order, with the points that they use; its
/// inputIrradiance as it is.
RadiositySolution TakeTriangles(const RadiositySolution& solution,
                                const std::vector<int64_t>& triangles);

}  // namespace lambert
