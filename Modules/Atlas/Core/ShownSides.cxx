#include "Atlas/Core/ShownSides.h"

#include <algorithm>
#include <array>
#include <string>
#include <unordered_map>

#include "Atlas/Core/SurfaceOpenings.h"
#include "Atlas/Core/SurfaceSubset.h"
#include "Common/Core/Error.h"
#include "Scene/Core/MeshTopology.h"

namespace lambert {
namespace {

/// Parts of the mean irradiance from which a second side shows: any, and one of a sheet.
constexpr double kDimmest = 0.1, kDimmestOfSheet = 1e-4;
/// Parts of a face and of its coordinates by which a triangle may lie beside it: rounding.
constexpr float kOnFace = 1e-5f;
/// Parts of its area: what the vector area of a flat surface has at least, and the holes of a bent
/// sheet. A cube that stands without a bottom has a fifth.
constexpr float kFlat = 0.5f;
constexpr double kOpen = 0.25;

struct SideLight {
  double power = 0, area = 0;  ///< W, m2

  double Mean() const { return area > 0 ? power / area : 0; }
};

/// By surface and side.
std::vector<std::array<SideLight, 2>> LightOfSurfaces(const TriangleMesh& mesh,
                                                      const RadiositySolution& solution) {
  if (mesh.surfaceId.size() != mesh.triangles.size()) {
    throw Error("The mesh does not tell the surfaces of its faces; cluster them first.");
  }
  int32_t count = 0;
  for (const int32_t surface : mesh.surfaceId) {
    if (surface < 0) throw Error("The mesh has a surface below 0; cluster its faces first.");
    count = std::max(count, surface + 1);
  }
  std::vector<std::array<SideLight, 2>> light(static_cast<size_t>(count));
  for (size_t t = 0; t < solution.mesh.triangles.size(); ++t) {
    const size_t surface = size_t(mesh.surfaceId[size_t(solution.inputFaceId[t])]);
    const double area = double(solution.mesh.Area(int64_t(t)));
    SideLight& side = light[surface][solution.side[t]];
    side.area += area;
    for (const int32_t p : solution.mesh.triangles[t]) {
      side.power += area / 3 * double(solution.irradiance[size_t(p)].Mean());
    }
  }
  return light;
}

/// Of two dark ones, the larger.
uint8_t BrighterSide(const std::array<SideLight, 2>& light) {
  const SideLight &front = light[kFront], &back = light[kBack];
  if (front.power == back.power) return back.area > front.area ? kBack : kFront;
  return back.power > front.power ? kBack : kFront;
}

/// Faces from `first` on, seen from behind: points of their own, whose normals are turned.
void TurnOver(size_t first, size_t end, ShownSides* shown) {
  TriangleMesh& mesh = shown->mesh;
  std::unordered_map<int32_t, int32_t> turned;
  for (size_t face = first; face < end; ++face) {
    for (int32_t& corner : mesh.triangles[face]) {
      const size_t old = size_t(corner);
      const auto [point, isNew] = turned.try_emplace(corner, int32_t(mesh.positions.size()));
      if (isNew) {
        mesh.positions.push_back(mesh.positions[old]);
        if (!mesh.normals.empty()) mesh.normals.push_back(mesh.normals[old] * -1.f);
        if (!mesh.uvs.empty()) mesh.uvs.push_back(mesh.uvs[old]);
        shown->inputPoint.push_back(shown->inputPoint[old]);
      }
      corner = point->second;
    }
    ReverseFace(&mesh, int64_t(face));
  }
}

}  // namespace

void RequireSameFaces(const TriangleMesh& mesh, const RadiositySolution& solution) {
  for (size_t t = 0; t < solution.inputFaceId.size(); ++t) {
    const int64_t face = solution.inputFaceId[t];
    if (face < 0 || face >= mesh.FaceCount()) {
      throw Error("The solution lies on face " + std::to_string(face) + ", which the mesh lacks.");
    }
    Box3f bounds;
    for (int c = 0; c < 3; ++c) bounds.Include(mesh.Corner(face, c));
    Vec3f middle;
    for (int c = 0; c < 3; ++c) middle += solution.mesh.Corner(int64_t(t), c) / 3.f;
    const float slack = kOnFace * (bounds.Diagonal() + Length(middle));
    const Vec3f below = bounds.low - middle, above = middle - bounds.high;
    if (std::max({below.x, below.y, below.z, above.x, above.y, above.z}) > slack) {
      throw Error("The solution is not of this mesh: triangle " + std::to_string(t) +
                  " lies beside its face " + std::to_string(face) +
                  "; cluster the faces before both solving and laying flat.");
    }
  }
}

std::vector<uint8_t> BrighterSidesOfSurfaces(const TriangleMesh& mesh,
                                             const RadiositySolution& solution) {
  std::vector<uint8_t> sides;
  for (const auto& light : LightOfSurfaces(mesh, solution)) sides.push_back(BrighterSide(light));
  return sides;
}

std::vector<bool> FindSheets(const TriangleMesh& mesh, const ClusterTree& tree,
                             const RadiositySolution& solution) {
  const std::vector<std::array<SideLight, 2>> lights = LightOfSurfaces(mesh, solution);
  if (lights.size() > tree.surfaceRoots.size()) {
    throw Error("The mesh has " + std::to_string(lights.size()) + " surfaces, its cluster tree " +
                std::to_string(tree.surfaceRoots.size()) + "; take both from one clustering.");
  }
  SideLight all;
  for (const auto& light : lights) {
    const SideLight& brighter = light[BrighterSide(light)];
    all.power += brighter.power;
    all.area += brighter.area;
  }
  const std::vector<SurfaceOpening> openings = FindOpenings(mesh);
  std::vector<bool> isSheet(tree.surfaceRoots.size(), false);
  for (size_t s = 0; s < lights.size(); ++s) {
    const uint8_t dimmer = uint8_t(1 - BrighterSide(lights[s]));
    if (openings[s].enclosedSide == dimmer) continue;
    const ClusterNode& root = tree.nodes[size_t(tree.surfaceRoots[s])];
    const bool isFlat = Length(root.vectorArea) > kFlat * root.area;
    const bool isBent = openings[s].holes > kOpen && !openings[s].isRoom;
    const double light = lights[s][dimmer].Mean();
    isSheet[s] = light > 0 && light >= (isFlat || isBent ? kDimmestOfSheet : kDimmest) * all.Mean();
  }
  return isSheet;
}

ShownSides ShowSides(const TriangleMesh& mesh, const ClusterTree& tree,
                     const SidesOfSurfaces& sides) {
  // First sides, then the others of sheets.
  ShownSides shown;
  const auto show = [&](size_t surface, uint8_t side) {
    const ClusterNode& root = tree.nodes[size_t(tree.surfaceRoots[surface])];
    AppendTree(tree, surface, int32_t(shown.inputFace.size()), &shown.tree);
    for (int32_t face = root.firstFace; face < root.firstFace + root.faceCount; ++face) {
      shown.inputFace.push_back(face);
      shown.side.push_back(side);
    }
    shown.inputSurface.push_back(int32_t(surface));
  };
  for (size_t s = 0; s < sides.first.size(); ++s) show(s, sides.first[s]);
  for (size_t s = 0; s < sides.first.size(); ++s) {
    if (sides.isSheet[s]) show(s, 1 - sides.first[s]);
  }

  // Each towards the side that it shows.
  shown.mesh = TakeFaces(mesh, shown.inputFace, &shown.inputPoint);
  for (size_t s = 0; s < shown.inputSurface.size(); ++s) {
    const size_t rootNode = size_t(shown.tree.surfaceRoots[s]);
    const size_t first = size_t(shown.tree.nodes[rootNode].firstFace);
    const size_t end = first + size_t(shown.tree.nodes[rootNode].faceCount);
    std::fill(shown.mesh.surfaceId.begin() + int64_t(first),
              shown.mesh.surfaceId.begin() + int64_t(end), int32_t(s));
    if (shown.side[first] == kFront) continue;
    TurnOver(first, end, &shown);
    const bool isLast = s + 1 == shown.inputSurface.size();
    const size_t endNode =
        isLast ? shown.tree.nodes.size() : size_t(shown.tree.surfaceRoots[s + 1]);
    for (size_t node = rootNode; node < endNode; ++node) {
      shown.tree.nodes[node].vectorArea = shown.tree.nodes[node].vectorArea * -1.f;
    }
  }
  for (size_t face = 0; face < shown.inputFace.size(); ++face) {
    if (!shown.mesh.Emits(int64_t(face), kFront)) shown.mesh.emittance[face] = Spectrum();
  }
  return shown;
}

std::optional<ShownSides> ShowBothSides(const TriangleMesh& mesh, const ClusterTree& tree,
                                        const RadiositySolution& solution) {
  RequireSameFaces(mesh, solution);
  const std::vector<bool> isSheet = FindSheets(mesh, tree, solution);
  if (std::find(isSheet.begin(), isSheet.end(), true) == isSheet.end()) return {};
  return ShowSides(mesh, tree, {BrighterSidesOfSurfaces(mesh, solution), isSheet});
}

RadiositySolution OntoShownSides(RadiositySolution solution, const std::vector<int64_t>& inputFace,
                                 const std::vector<uint8_t>& side) {
  // By face of the solved mesh and side: what shows it.
  std::vector<std::array<int64_t, 2>> shows;
  for (size_t face = 0; face < inputFace.size(); ++face) {
    const size_t input = size_t(inputFace[face]);
    if (input >= inputFace.size()) {
      throw Error("The mesh shows face " + std::to_string(inputFace[face]) +
                  ", which what was solved cannot have; it takes the output of vtkRadiosityAtlas.");
    }
    if (input >= shows.size()) shows.resize(input + 1, {-1, -1});
    shows[input][side[face]] = int64_t(face);
  }
  for (size_t t = 0; t < solution.inputFaceId.size(); ++t) {
    const size_t input = size_t(solution.inputFaceId[t]);
    const std::array<int64_t, 2> none = {-1, -1};
    const std::array<int64_t, 2>& sides = input < shows.size() ? shows[input] : none;
    const int64_t shown = sides[solution.side[t]], other = sides[1 - solution.side[t]];
    if (shown < 0 && other < 0) {
      throw Error("The solution lies on face " + std::to_string(input) +
                  ", which the mesh shows from neither side.");
    }
    solution.inputFaceId[t] = shown >= 0 ? shown : other;
    solution.side[t] = shown >= 0 ? kFront : kBack;
  }
  solution.inputIrradiance.clear();
  return solution;
}

}  // namespace lambert
