#include "Atlas/Core/StoredAtlas.h"

#include <cmath>
#include <unordered_map>
#include <utility>

namespace lambert {
namespace {

/// As the atlas has them: first sides of all faces, then the others of sheets.
SidesOfSurfaces SidesOf(const StoredAtlas& stored, const TriangleMesh& mesh,
                        const ClusterTree& tree) {
  SidesOfSurfaces sides;
  for (const int32_t root : tree.surfaceRoots) {
    sides.first.push_back(stored.side[size_t(tree.nodes[size_t(root)].firstFace)]);
  }
  sides.isSheet.resize(sides.first.size(), false);
  for (size_t face = mesh.triangles.size(); face < stored.inputFace.size(); ++face) {
    const int64_t input = stored.inputFace[face];
    if (input < 0 || input >= mesh.FaceCount()) continue;
    sides.isSheet[size_t(mesh.surfaceId[size_t(input)])] = true;
  }
  return sides;
}

bool AreCornersOf(const TriangleMesh& mesh, const std::vector<std::array<Vec3f, 3>>& corners) {
  if (corners.size() != mesh.triangles.size()) return false;
  for (size_t face = 0; face < corners.size(); ++face) {
    for (size_t c = 0; c < 3; ++c) {
      if (!(corners[face][c] == mesh.Corner(int64_t(face), int(c)))) return false;
    }
  }
  return true;
}

/// Of all triangles, pages^2.
double AreaOnPages(const RadiosityAtlas& atlas) {
  double area = 0;
  for (const std::array<Vec2f, 3>& places : atlas.textureCoords) {
    const Vec2d u(places[1] - places[0]), v(places[2] - places[0]);
    area += 0.5 * std::abs(u.x * v.y - u.y * v.x);
  }
  return area;
}

}  // namespace

void CompleteAtlas(const TriangleMesh& mesh, RadiosityAtlas* atlas) {
  ChartSet& set = atlas->set;
  set.corners.resize(mesh.triangles.size());
  std::unordered_map<int32_t, int32_t> numbers;
  for (Chart& chart : set.charts) {
    numbers.clear();
    for (const int32_t face : set.FacesOf(chart)) {
      for (size_t c = 0; c < 3; ++c) {
        const int32_t point = mesh.triangles[size_t(face)][c];
        set.corners[size_t(face)][c] =
            numbers.try_emplace(point, int32_t(numbers.size())).first->second;
      }
    }
    chart.cornerCount = int32_t(numbers.size());
  }
  if (atlas->pages > 0) atlas->utilisation = AreaOnPages(*atlas) / atlas->pages;
}

bool IsAtlasOf(const StoredAtlas& stored, const TriangleMesh& mesh, const ClusterTree& tree) {
  if (stored.side.empty()) return AreCornersOf(mesh, stored.corners);
  if (stored.side.size() < mesh.triangles.size()) return false;
  const ShownSides shown = ShowSides(mesh, tree, SidesOf(stored, mesh, tree));
  return shown.inputFace == stored.inputFace && shown.side == stored.side &&
         AreCornersOf(shown.mesh, stored.corners);
}

std::optional<ShownSides> ShowStoredSides(const TriangleMesh& mesh, const ClusterTree& tree,
                                          const RadiositySolution& solution, StoredAtlas* stored) {
  if (stored->side.empty()) return {};
  SidesOfSurfaces sides = SidesOf(*stored, mesh, tree);
  const std::vector<uint8_t> brighter = BrighterSidesOfSurfaces(mesh, solution);
  for (size_t s = 0; s < brighter.size(); ++s) {
    if (!sides.isSheet[s]) sides.first[s] = brighter[s];
  }
  ShownSides shown = ShowSides(mesh, tree, sides);

  // Faces that are wound the other way now (ReverseFace).
  for (size_t face = 0; face < shown.side.size(); ++face) {
    if (shown.side[face] == stored->side[face]) continue;
    std::swap(stored->corners[face][1], stored->corners[face][2]);
    std::swap(stored->atlas.textureCoords[face][1], stored->atlas.textureCoords[face][2]);
    std::swap(stored->atlas.set.corners[face][1], stored->atlas.set.corners[face][2]);
  }
  stored->side = shown.side;
  return shown;
}

}  // namespace lambert
