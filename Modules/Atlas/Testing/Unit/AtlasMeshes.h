// What the tests of the atlas share.
#pragma once

#include "Atlas/Core/ChartMesh.h"
#include "Clustering/Core/FaceClustering.h"
#include "Clustering/Testing/Unit/ClusteringMeshes.h"
#include "Scene/Core/RadiositySolution.h"

namespace lambert {

/// A mesh in the order of its clusters.
struct Clustered {
  TriangleMesh mesh;
  ClusterTree tree;

  explicit Clustered(TriangleMesh mesh_) : mesh(std::move(mesh_)) {
    tree = ClusterFaces(&mesh, {});
  }
};

/// A box without its lid, in metres, seen from outside; `lid` closes it.
inline TriangleMesh Box(const Vec3f& size, bool lid) {
  TriangleMesh box;
  for (const float z : {0.f, size.z}) {
    for (const Vec3f& p :
         {Vec3f(0, 0, z), Vec3f(size.x, 0, z), Vec3f(size.x, size.y, z), Vec3f(0, size.y, z)}) {
      box.positions.push_back(p);
    }
  }
  box.triangles = {{0, 2, 1}, {0, 3, 2}};
  for (int32_t i = 0; i < 4; ++i) {
    const int32_t next = (i + 1) % 4;
    box.triangles.push_back({i, next, next + 4});
    box.triangles.push_back({i, next + 4, i + 4});
  }
  if (lid) {
    box.triangles.push_back({4, 5, 6});
    box.triangles.push_back({4, 6, 7});
  }
  return box;
}

/// Adds points and triangles of another mesh, moved.
inline void Append(const TriangleMesh& other, const Vec3f& offset, TriangleMesh* mesh) {
  const int32_t first = int32_t(mesh->positions.size());
  for (const Vec3f& p : other.positions) mesh->positions.push_back(p + offset);
  for (const auto& t : other.triangles) {
    mesh->triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
}

/// Two flat grids of `cells` across, one 5 m above the other.
inline TriangleMesh TwoFlatGrids(int cells) {
  TriangleMesh mesh;
  const TriangleMesh plane = FlatGrid(cells);
  for (const float height : {0.f, 5.f}) Append(plane, {0, 0, height}, &mesh);
  mesh.Complete();
  return mesh;
}

/// Puts a triangle of a face into a solution, cut into four `depth` times, with light that depends
/// on the place alone.
template <class LightAt>
void AddRefined(int64_t face, const std::array<Vec3f, 3>& corners, int depth,
                const LightAt& lightAt, RadiositySolution* solution) {
  const auto& [a, b, c] = corners;
  if (depth > 0) {
    const Vec3f ab = (a + b) * 0.5f, bc = (b + c) * 0.5f, ca = (c + a) * 0.5f;
    AddRefined(face, {a, ab, ca}, depth - 1, lightAt, solution);
    AddRefined(face, {ab, b, bc}, depth - 1, lightAt, solution);
    AddRefined(face, {ca, bc, c}, depth - 1, lightAt, solution);
    AddRefined(face, {ab, bc, ca}, depth - 1, lightAt, solution);
    return;
  }
  const int32_t first = int32_t(solution->mesh.positions.size());
  for (const Vec3f& p : corners) {
    solution->mesh.positions.push_back(p);
    solution->irradiance.push_back(lightAt(p));
  }
  solution->mesh.triangles.push_back({first, first + 1, first + 2});
  solution->inputFaceId.push_back(face);
  solution->side.push_back(kFront);
}

inline std::array<Vec3f, 3> CornersOf(const TriangleMesh& mesh, int64_t face) {
  return {mesh.Corner(face, 0), mesh.Corner(face, 1), mesh.Corner(face, 2)};
}

/// All of a mesh as one chart.
inline ChartMesh WholeChart(TriangleMesh mesh) {
  mesh.surfaceId.assign(mesh.triangles.size(), 0);
  return MakeChartMesh(mesh, FindNeighbours(mesh), FacesFrom(0, int32_t(mesh.FaceCount())));
}

}  // namespace lambert
