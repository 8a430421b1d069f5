// Solutions of known content for tests of what reads them.
#pragma once

#include <algorithm>

#include "Common/Testing/TestScenes.h"
#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"

namespace lambert::testing {

/// A furnace whose floor does not emit, so that there is something to measure at. Its floor
/// reflects nothing: with the other walls black too, the floor's irradiance is the exitance 1 of
/// what it sees.
inline Scene BlackFurnace() {
  Scene scene;
  BoxMaterials materials(0, 1);
  materials.emittance[kFloor] = Spectrum(0.f);
  AddBox(&scene.mesh, {0, 0, 0}, {1, 1, 1}, materials, true, 2);
  CompleteTables(&scene);
  return scene;
}

/// A solution of `scene` in which every side of every face receives `irradiance` (W/m2, each band):
/// each face cut into n^2 triangles, both sides or the front alone.
inline RadiositySolution FlatSolution(const Scene& scene, float irradiance, int n,
                                      bool bothSides = true) {
  const TriangleMesh& mesh = scene.mesh;
  RadiositySolution solution;
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    for (const Side side : {kFront, kBack}) {
      if (side == kBack && !bothSides) continue;
      const Vec3f a = mesh.Corner(face, 0);
      const Vec3f u = (mesh.Corner(face, 1) - a) / float(n),
                  v = (mesh.Corner(face, 2) - a) / float(n);
      const Vec3f normal = mesh.FrontNormal(face) * (side == kFront ? 1.f : -1.f);
      const auto point = [&](int i, int j) {
        solution.mesh.positions.push_back(a + u * float(i) + v * float(j));
        solution.mesh.normals.push_back(normal);
        solution.irradiance.push_back(Spectrum(irradiance));
        const Spectrum emitted =
            mesh.Emits(face, side) ? mesh.emittance[size_t(face)] : Spectrum(0.f);
        solution.radiosity.push_back(mesh.reflectance[size_t(face)] * irradiance + emitted);
        return int32_t(solution.mesh.positions.size()) - 1;
      };
      const auto triangle = [&](int32_t p, int32_t q, int32_t r) {
        if (side == kBack) std::swap(q, r);
        solution.mesh.triangles.push_back({p, q, r});
        solution.mesh.reflectance.push_back(mesh.reflectance[size_t(face)]);
        solution.mesh.emittance.push_back(mesh.emittance[size_t(face)]);
        solution.mesh.faceFlags.push_back(mesh.Emits(face, side) ? kEmitsFront : 0);
        solution.inputFaceId.push_back(face);
        solution.side.push_back(side);
      };
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i + j < n; ++i) {
          const int32_t p = point(i, j), q = point(i + 1, j), r = point(i, j + 1);
          triangle(p, q, r);
          if (i + j + 1 < n) triangle(q, point(i + 1, j + 1), r);
        }
      }
    }
  }
  solution.mesh.Complete();
  return solution;
}

/// The exact solution of a black furnace, but that one patch of 25 of its floor is 100 % too
/// bright.
inline RadiositySolution WithBrightPatch(const Scene& blackFurnace) {
  RadiositySolution solution = FlatSolution(blackFurnace, 1, 6, false);
  for (size_t i = 0; i < solution.irradiance.size(); ++i) {
    const Vec3f& p = solution.mesh.positions[i];
    if (p.z == 0 && std::max(p.x, p.y) < 0.3f) solution.irradiance[i] = Spectrum(2.f);
  }
  return solution;
}

}  // namespace lambert::testing
