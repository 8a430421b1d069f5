// Face clusters: a binary tree over the triangles of every surface, built by collapsing the edges
// of the dual graph (thesis 4.2.2). One tree a surface; a surface is a connected piece of one
// material of one part.
#pragma once

#include <cstdint>
#include <vector>

#include "Common/Core/Progress.h"
#include "Common/Core/TriangleMesh.h"
#include "Scene/Core/Scene.h"

namespace lambert {

struct FaceClusteringOptions {
  /// k of equation (4.8): small values make planar clusters, large ones a balanced tree. Range [0,
  /// inf).
  double balance = 0.01;
};

/// A cluster: the faces [firstFace, firstFace + faceCount) of the reordered mesh.
struct ClusterNode {
  int32_t parent = -1;  ///< -1 at the root of a surface
  int32_t child =
      -1;  ///< first of two children, which stand side by side; -1 at a leaf, which is one face
  int32_t firstFace = 0;
  int32_t faceCount = 0;
  float area = 0;    ///< m2
  Vec3f vectorArea;  ///< sum of area-weighted front normals, m2 (4.9)
  Box3f bounds;      ///< world space
};

struct ClusterTree {
  std::vector<ClusterNode> nodes;     ///< the nodes of a surface lie together, its root first
  std::vector<int32_t> surfaceRoots;  ///< node of each surface's root, by surface id
};

struct FaceClusteringStatistics {
  int64_t surfaces = 0, nodes = 0;
  int64_t sharedTrees = 0;  ///< parts that took the tree of another part of the same mesh
  int64_t nonManifoldEdges = 0, inconsistentEdges = 0;  ///< cut: clusters do not cross them
  int32_t maximumDepth = 0;
  double maximumDepthOverLog =
      0;  ///< largest of depth / log2(faces) over surfaces of 64 faces or more
  double seconds = 0;
};

/// Clusters the faces of `mesh`, part by part; parts that are instances of one mesh are clustered
/// once (their transforms must be similarities of each other, else they are clustered on their
/// own). Reorders every per-face array of `mesh` into tree order and fills `surfaceId`. Surfaces in
/// parallel; the result does not depend on the number of threads. Throws Cancelled.
ClusterTree ClusterFaces(TriangleMesh* mesh, const std::vector<Part>& parts,
                         const FaceClusteringOptions& options = {},
                         FaceClusteringStatistics* statistics = nullptr,
                         const ProgressCallback& progress = {});

}  // namespace lambert
