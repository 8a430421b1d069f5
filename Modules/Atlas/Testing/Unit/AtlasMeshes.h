// What the tests of the atlas share.
#pragma once

#include "Atlas/Core/ChartMesh.h"
#include "Clustering/Core/FaceClustering.h"
#include "Clustering/Testing/Unit/ClusteringMeshes.h"

namespace lambert {

/// A mesh in the order of its clusters.
struct Clustered {
  TriangleMesh mesh;
  ClusterTree tree;

  explicit Clustered(TriangleMesh mesh_) : mesh(std::move(mesh_)) {
    tree = ClusterFaces(&mesh, {});
  }
};

/// All of a mesh as one chart.
inline ChartMesh WholeChart(TriangleMesh mesh) {
  mesh.surfaceId.assign(mesh.triangles.size(), 0);
  return MakeChartMesh(mesh, FindNeighbours(mesh), 0, int32_t(mesh.FaceCount()));
}

}  // namespace lambert
