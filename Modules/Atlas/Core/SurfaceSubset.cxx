#include "Atlas/Core/SurfaceSubset.h"

namespace lambert {
namespace {

/// The entries of `values` that are named; none of an array that is not there.
template <class T>
std::vector<T> Taken(const std::vector<T>& values, const std::vector<int64_t>& names) {
  std::vector<T> taken;
  if (values.empty()) return taken;
  taken.reserve(names.size());
  for (const int64_t name : names) taken.push_back(values[size_t(name)]);
  return taken;
}

/// The trees of the surfaces, on faces and surfaces that are numbered anew.
ClusterTree TakeTrees(const ClusterTree& tree, const std::vector<char>& isTaken,
                      std::vector<int64_t>* faces, std::vector<int32_t>* surfaces) {
  ClusterTree taken;
  for (size_t surface = 0; surface < tree.surfaceRoots.size(); ++surface) {
    if (!isTaken[surface]) continue;
    const ClusterNode& root = tree.nodes[size_t(tree.surfaceRoots[surface])];
    const int32_t number = int32_t(taken.surfaceRoots.size());
    AppendTree(tree, surface, int32_t(faces->size()), &taken);
    for (int32_t face = root.firstFace; face < root.firstFace + root.faceCount; ++face) {
      faces->push_back(face);
      surfaces->push_back(number);
    }
  }
  return taken;
}

}  // namespace

void AppendTree(const ClusterTree& tree, size_t surface, int32_t firstFace, ClusterTree* to) {
  const size_t first = size_t(tree.surfaceRoots[surface]);
  const size_t end = surface + 1 < tree.surfaceRoots.size() ? size_t(tree.surfaceRoots[surface + 1])
                                                            : tree.nodes.size();
  const int32_t nodeShift = int32_t(to->nodes.size()) - int32_t(first);
  const int32_t faceShift = firstFace - tree.nodes[first].firstFace;
  for (size_t node = first; node < end; ++node) {
    ClusterNode moved = tree.nodes[node];
    if (moved.parent >= 0) moved.parent += nodeShift;
    if (moved.child >= 0) moved.child += nodeShift;
    moved.firstFace += faceShift;
    to->nodes.push_back(moved);
  }
  to->surfaceRoots.push_back(int32_t(first) + nodeShift);
}

TriangleMesh TakeFaces(const TriangleMesh& mesh, const std::vector<int64_t>& faces,
                       std::vector<int64_t>* points) {
  // The points that they use, numbered anew.
  TriangleMesh taken;
  std::vector<int32_t> number(mesh.positions.size(), -1);
  std::vector<int64_t> used;
  for (const int64_t face : faces) {
    std::array<int32_t, 3> triangle = mesh.triangles[size_t(face)];
    for (int32_t& point : triangle) {
      int32_t& known = number[size_t(point)];
      if (known < 0) {
        known = int32_t(used.size());
        used.push_back(point);
      }
      point = known;
    }
    taken.triangles.push_back(triangle);
  }
  taken.positions = Taken(mesh.positions, used);
  taken.normals = Taken(mesh.normals, used);
  taken.uvs = Taken(mesh.uvs, used);

  // What stands at the faces.
  taken.reflectance = Taken(mesh.reflectance, faces);
  taken.emittance = Taken(mesh.emittance, faces);
  taken.faceFlags = Taken(mesh.faceFlags, faces);
  taken.materialId = Taken(mesh.materialId, faces);
  taken.partId = Taken(mesh.partId, faces);
  taken.surfaceId = Taken(mesh.surfaceId, faces);
  taken.sourceCellId = Taken(mesh.sourceCellId, faces);
  if (points) *points = std::move(used);
  return taken;
}

RadiositySolution TakeTriangles(const RadiositySolution& solution,
                                const std::vector<int64_t>& triangles) {
  RadiositySolution taken;
  std::vector<int64_t> points;
  taken.mesh = TakeFaces(solution.mesh, triangles, &points);
  taken.inputFaceId = Taken(solution.inputFaceId, triangles);
  taken.side = Taken(solution.side, triangles);
  taken.leafId = Taken(solution.leafId, triangles);
  taken.irradiance = Taken(solution.irradiance, points);
  taken.radiosity = Taken(solution.radiosity, points);
  taken.inputIrradiance = solution.inputIrradiance;
  return taken;
}

SurfaceSubset TakeSurfaces(const TriangleMesh& mesh, const ClusterTree& tree,
                           const RadiositySolution& solution, const std::vector<char>& isTaken) {
  // Faces and their trees.
  SurfaceSubset subset;
  std::vector<int64_t> faces;
  std::vector<int32_t> surfaces;
  subset.tree = TakeTrees(tree, isTaken, &faces, &surfaces);
  subset.mesh = TakeFaces(mesh, faces);
  subset.mesh.surfaceId = std::move(surfaces);

  // The light on them.
  std::vector<int64_t> numberOfFace(mesh.triangles.size(), -1), triangles;
  for (size_t i = 0; i < faces.size(); ++i) numberOfFace[size_t(faces[i])] = int64_t(i);
  for (size_t t = 0; t < solution.inputFaceId.size(); ++t) {
    if (numberOfFace[size_t(solution.inputFaceId[t])] >= 0) triangles.push_back(int64_t(t));
  }
  subset.solution = TakeTriangles(solution, triangles);
  subset.solution.inputIrradiance.clear();
  for (int64_t& face : subset.solution.inputFaceId) face = numberOfFace[size_t(face)];
  subset.inputFace = std::move(faces);
  return subset;
}

}  // namespace lambert
