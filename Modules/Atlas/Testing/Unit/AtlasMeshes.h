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

/// Two flat grids of `cells` across, one 5 m above the other.
inline TriangleMesh TwoFlatGrids(int cells) {
  TriangleMesh mesh;
  const TriangleMesh plane = FlatGrid(cells);
  for (const float height : {0.f, 5.f}) {
    const int32_t first = int32_t(mesh.positions.size());
    for (const Vec3f& p : plane.positions) mesh.positions.push_back(p + Vec3f(0, 0, height));
    for (const auto& t : plane.triangles) {
      mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
  }
  mesh.Complete();
  return mesh;
}

/// All of a mesh as one chart.
inline ChartMesh WholeChart(TriangleMesh mesh) {
  mesh.surfaceId.assign(mesh.triangles.size(), 0);
  return MakeChartMesh(mesh, FindNeighbours(mesh), FacesFrom(0, int32_t(mesh.FaceCount())));
}

}  // namespace lambert
