#include "Atlas/Core/StoredAtlas.h"

#include <algorithm>
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

///@{ What a face of the atlas is of, and the side of it that it winds towards.
int64_t InputFaceOf(const StoredAtlas& stored, size_t face) {
  return stored.inputFace.empty() ? int64_t(face) : stored.inputFace[face];
}
uint8_t SideOf(const StoredAtlas& stored, size_t face) {
  return stored.side.empty() ? uint8_t(kFront) : stored.side[face];
}
///@}

/// Whether every face is one of the mesh, from one of its sides, and none is there twice.
bool AreSomeFacesOf(const StoredAtlas& stored, const TriangleMesh& mesh) {
  std::vector<std::array<bool, 2>> isTaken(mesh.triangles.size(), {false, false});
  for (size_t face = 0; face < stored.corners.size(); ++face) {
    const int64_t input = InputFaceOf(stored, face);
    if (input < 0 || input >= mesh.FaceCount()) return false;
    const uint8_t side = SideOf(stored, face);
    if (isTaken[size_t(input)][side]) return false;
    isTaken[size_t(input)][side] = true;
    std::array<Vec3f, 3> corners = stored.corners[face];
    if (side == kBack) std::swap(corners[1], corners[2]);
    for (size_t c = 0; c < 3; ++c) {
      if (!(corners[c] == mesh.Corner(input, int(c)))) return false;
    }
  }
  return true;
}

/// Winds a face of the atlas the other way (ReverseFace).
void TurnOver(size_t face, StoredAtlas* stored) {
  std::swap(stored->corners[face][1], stored->corners[face][2]);
  std::swap(stored->atlas.textureCoords[face][1], stored->atlas.textureCoords[face][2]);
  std::swap(stored->atlas.set.corners[face][1], stored->atlas.set.corners[face][2]);
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
  if (stored.isOfChosen) return AreSomeFacesOf(stored, mesh);
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

  // Faces that are wound the other way now.
  for (size_t face = 0; face < shown.side.size(); ++face) {
    if (shown.side[face] != stored->side[face]) TurnOver(face, stored);
  }
  stored->side = shown.side;
  return shown;
}

std::vector<bool> FindLaidSurfaces(const StoredAtlas& stored, const TriangleMesh& mesh) {
  std::vector<bool> isFaceLaid(mesh.triangles.size(), false);
  for (size_t face = 0; face < stored.corners.size(); ++face) {
    isFaceLaid[size_t(InputFaceOf(stored, face))] = true;
  }
  std::vector<bool> isLaid;
  for (size_t face = 0; face < isFaceLaid.size(); ++face) {
    const size_t surface = size_t(mesh.surfaceId[face]);
    if (surface >= isLaid.size()) isLaid.resize(surface + 1, true);
    isLaid[surface] = isLaid[surface] && isFaceLaid[face];
  }
  return isLaid;
}

std::optional<ShownSides> ShowSidesOfChosen(const TriangleMesh& mesh, const ClusterTree& tree,
                                            const RadiositySolution& solution,
                                            const StoredAtlas& stored) {
  SidesOfSurfaces sides;
  sides.first = BrighterSidesOfSurfaces(mesh, solution);
  sides.isSheet = FindSheets(mesh, tree, solution);
  std::vector<std::array<bool, 2>> isLaid(sides.isSheet.size(), {false, false});
  for (size_t face = 0; face < stored.side.size(); ++face) {
    const size_t surface = size_t(mesh.surfaceId[size_t(InputFaceOf(stored, face))]);
    isLaid[surface][stored.side[face]] = true;
    if (isLaid[surface][kFront] && isLaid[surface][kBack]) sides.isSheet[surface] = true;
  }
  if (std::find(sides.isSheet.begin(), sides.isSheet.end(), true) == sides.isSheet.end()) return {};
  return ShowSides(mesh, tree, sides);
}

std::vector<int64_t> FindLaidFaces(const TriangleMesh& mesh, const ShownSides* shown,
                                   StoredAtlas* stored) {
  // By face of the mesh: that which shows its other side.
  std::vector<int64_t> other(mesh.triangles.size(), -1);
  const size_t faces = shown ? shown->inputFace.size() : mesh.triangles.size();
  for (size_t face = other.size(); face < faces; ++face) {
    other[size_t(shown->inputFace[face])] = int64_t(face);
  }

  const auto windsTowards = [&](size_t face) {
    return shown ? shown->side[face] : uint8_t(kFront);
  };
  std::vector<int64_t> laid(faces, -1);
  for (size_t face = 0; face < stored->corners.size(); ++face) {
    size_t shows = size_t(InputFaceOf(*stored, face));
    const uint8_t side = SideOf(*stored, face);
    if (!stored->side.empty() && other[shows] >= 0 && windsTowards(shows) != side) {
      shows = size_t(other[shows]);
    }
    laid[shows] = int64_t(face);
    if (windsTowards(shows) != side) TurnOver(face, stored);
  }
  return laid;
}

RadiosityAtlas TakeFacesOfAtlas(const RadiosityAtlas& atlas, const std::vector<int64_t>& faces) {
  RadiosityAtlas taken;
  taken.pageSize = atlas.pageSize;
  taken.padding = atlas.padding;
  taken.texelSize = atlas.texelSize;

  // Their charts, numbered by their first faces, and pages that are not empty.
  const std::vector<int32_t> chartOfFace = ChartOfFace(atlas.set);
  std::vector<int32_t> number(atlas.set.charts.size(), -1), charts;
  std::vector<bool> isNeeded(size_t(atlas.pages), false);
  std::vector<std::vector<int32_t>> facesOfChart;
  for (size_t face = 0; face < faces.size(); ++face) {
    const size_t stored = size_t(faces[face]), chart = size_t(chartOfFace[stored]);
    if (number[chart] < 0) {
      number[chart] = int32_t(charts.size());
      charts.push_back(int32_t(chart));
      facesOfChart.emplace_back();
      isNeeded[size_t(atlas.pageOfChart[chart])] = true;
    }
    facesOfChart[size_t(number[chart])].push_back(int32_t(face));
    taken.textureCoords.push_back(atlas.textureCoords[stored]);
    taken.set.corners.push_back(atlas.set.corners[stored]);
  }
  std::vector<int32_t> page(isNeeded.size(), -1);
  for (size_t p = 0; p < page.size(); ++p) {
    if (isNeeded[p]) page[p] = taken.pages++;
  }
  taken.set.places.resize(faces.size());
  for (size_t i = 0; i < charts.size(); ++i) {
    Chart chart = atlas.set.charts[size_t(charts[i])];
    chart.first = int32_t(taken.set.faces.size());
    chart.faceCount = int32_t(facesOfChart[i].size());
    taken.set.charts.push_back(chart);
    taken.set.faces.insert(taken.set.faces.end(), facesOfChart[i].begin(), facesOfChart[i].end());
    taken.pageOfChart.push_back(page[size_t(atlas.pageOfChart[size_t(charts[i])])]);
  }
  if (taken.pages > 0) taken.utilisation = AreaOnPages(taken) / taken.pages;
  return taken;
}

}  // namespace lambert
