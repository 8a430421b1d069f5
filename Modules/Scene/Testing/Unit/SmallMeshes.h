// Small meshes that the scene tests clean up.
#pragma once

#include <cmath>
#include <vector>

#include "Common/Testing/TestScenes.h"
#include "Scene/Core/SceneAssembly.h"

namespace lambert::testing {

/// Unit square in z = 0, front up.
inline TriangleMesh MakeSquare() {
  return MakeMesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
}

/// Axis-aligned cube of side 2 `half` about `center`, 8 points, wound outward.
inline TriangleMesh MakeCube(float half = 0.5f, Vec3f center = {}) {
  std::vector<Vec3f> p;
  for (int i = 0; i < 8; ++i) {
    p.push_back(center + Vec3f(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half));
  }
  return MakeMesh(std::move(p), {{0, 2, 3},
                                 {0, 3, 1},
                                 {4, 5, 7},
                                 {4, 7, 6},
                                 {0, 1, 5},
                                 {0, 5, 4},
                                 {2, 6, 7},
                                 {2, 7, 3},
                                 {0, 4, 6},
                                 {0, 6, 2},
                                 {1, 3, 7},
                                 {1, 7, 5}});
}

/// Capped cylinder about z, `sides` around, of the points of its two rings and two cap centres;
/// wound outward.
inline TriangleMesh MakeCylinder(int sides) {
  std::vector<Vec3f> p{{0, 0, 0}, {0, 0, 1}};
  std::vector<std::array<int32_t, 3>> t;
  for (int i = 0; i < sides; ++i) {
    const float angle = float(2 * kPi) * float(i) / float(sides);
    const int32_t a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % sides);
    p.push_back({std::cos(angle), std::sin(angle), 0});
    p.push_back({std::cos(angle), std::sin(angle), 1});
    t.insert(t.end(), {{a, b, b + 1}, {a, b + 1, a + 1}, {0, b, a}, {1, a + 1, b + 1}});
  }
  return MakeMesh(std::move(p), std::move(t));
}

/// A strip of `quads` quadrilaterals bent to a ring and twisted by half a turn.
inline TriangleMesh MakeMoebiusStrip(int quads) {
  std::vector<Vec3f> p;
  std::vector<std::array<int32_t, 3>> t;
  for (int i = 0; i < quads; ++i) {
    const float angle = float(2 * kPi) * float(i) / float(quads), twist = angle / 2;
    for (const float s : {-0.3f, 0.3f}) {
      const float radius = 1 + s * std::cos(twist);
      p.push_back({radius * std::cos(angle), radius * std::sin(angle), s * std::sin(twist)});
    }
    const bool last = i + 1 == quads;
    const int32_t a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    t.insert(t.end(), {{a, c, d}, {a, d, b}});
  }
  return MakeMesh(std::move(p), std::move(t));
}

inline void MakeEmit(TriangleMesh* mesh, uint8_t sides = kEmitsFront) {
  mesh->emittance.assign(mesh->triangles.size(), Spectrum(1.f));
  mesh->faceFlags.assign(mesh->triangles.size(), sides);
}

/// Reverses the winding as a file would have it: the emission stays with the (new) front.
inline void FlipWinding(TriangleMesh* mesh, size_t face) {
  std::swap(mesh->triangles[face][1], mesh->triangles[face][2]);
}

inline void Append(const TriangleMesh& from, TriangleMesh* to) {
  const int32_t base = int32_t(to->positions.size());
  to->positions.insert(to->positions.end(), from.positions.begin(), from.positions.end());
  for (size_t face = 0; face < from.triangles.size(); ++face) {
    const auto& t = from.triangles[face];
    to->triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
    to->reflectance.push_back(Spectrum(from.reflectance[face]));
    to->emittance.push_back(Spectrum(from.emittance[face]));
    to->faceFlags.push_back(uint8_t(from.faceFlags[face]));
    to->materialId.push_back(int32_t(from.materialId[face]));
    to->partId.push_back(0);
    to->sourceCellId.push_back(int64_t(to->sourceCellId.size()));
  }
}

/// One part of one mesh, one material.
inline SceneAssembly MakeAssembly(TriangleMesh mesh) {
  SceneAssembly assembly;
  assembly.meshes.push_back(std::move(mesh));
  assembly.parts.emplace_back();
  assembly.materials.emplace_back();
  assembly.materials.back().name = "paint";
  return assembly;
}

}  // namespace lambert::testing
