// Small scenes for tests, built in memory. Every quad and box has its own points, with geometric
// normals.
#pragma once

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "Scene/Core/Scene.h"

namespace lambert::testing {

/// A mesh of points and triangles, otherwise as it is by default.
inline TriangleMesh MakeMesh(std::vector<Vec3f> positions,
                             std::vector<std::array<int32_t, 3>> triangles) {
  TriangleMesh mesh;
  mesh.positions = std::move(positions);
  mesh.triangles = std::move(triangles);
  mesh.Complete();
  return mesh;
}

/// Adds one point with a normal; returns its index.
inline int32_t AddPoint(TriangleMesh* mesh, const Vec3f& position, const Vec3f& normal) {
  mesh->positions.push_back(position);
  mesh->normals.push_back(normal);
  return int32_t(mesh->positions.size()) - 1;
}

/// Adds one face; it emits `emittance` (exitance, W/m2) from its front where that is not black.
inline void AddFace(TriangleMesh* mesh, const std::array<int32_t, 3>& points,
                    const Spectrum& reflectance, const Spectrum& emittance, int32_t materialId = 0,
                    int32_t partId = 0) {
  mesh->sourceCellId.push_back(mesh->FaceCount());
  mesh->triangles.push_back(points);
  mesh->reflectance.push_back(reflectance);
  mesh->emittance.push_back(emittance);
  mesh->faceFlags.push_back(emittance.IsBlack() ? 0 : kEmitsFront);
  mesh->materialId.push_back(materialId);
  mesh->partId.push_back(partId);
}

/// Adds a single triangle whose front is the counter-clockwise side.
inline void AddTriangle(TriangleMesh* mesh, const Vec3f& a, const Vec3f& b, const Vec3f& c,
                        const Spectrum& reflectance, const Spectrum& emittance = Spectrum(0.f)) {
  const Vec3f normal = Normalize(Cross(b - a, c - a));
  const int32_t first = AddPoint(mesh, a, normal);
  AddPoint(mesh, b, normal);
  AddPoint(mesh, c, normal);
  AddFace(mesh, {first, first + 1, first + 2}, reflectance, emittance);
}

/// Adds the parallelogram origin, origin + u, origin + u + v, origin + v as n x n x 2 triangles;
/// its front looks along u x v.
inline void AddQuad(TriangleMesh* mesh, const Vec3f& origin, const Vec3f& u, const Vec3f& v,
                    const Spectrum& reflectance, const Spectrum& emittance = Spectrum(0.f),
                    int n = 1, int32_t materialId = 0, int32_t partId = 0) {
  const Vec3f normal = Normalize(Cross(u, v));
  const int32_t first = int32_t(mesh->positions.size());
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      AddPoint(mesh, origin + u * (float(i) / float(n)) + v * (float(j) / float(n)), normal);
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int32_t a = first + j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      AddFace(mesh, {a, b, c}, reflectance, emittance, materialId, partId);
      AddFace(mesh, {a, c, d}, reflectance, emittance, materialId, partId);
    }
  }
}

/// The six sides of an axis-aligned box in the order -x, +x, -y, +y, -z (floor), +z (ceiling).
enum BoxSide { kMinusX = 0, kPlusX, kMinusY, kPlusY, kFloor, kCeiling };

/// Reflectance and exitance (W/m2) of the sides of a box, in the order of BoxSide.
struct BoxMaterials {
  std::array<Spectrum, 6> reflectance;
  std::array<Spectrum, 6> emittance;

  explicit BoxMaterials(float rho, float exitance = 0) {
    reflectance.fill(Spectrum(rho));
    emittance.fill(Spectrum(exitance));
  }
};

/// Adds a box of six quads of n x n x 2 triangles; fronts look inward (a room) or outward (a
/// thing). Material ids are `firstMaterialId` + the side.
inline void AddBox(TriangleMesh* mesh, const Vec3f& low, const Vec3f& high,
                   const BoxMaterials& materials, bool inward, int n = 1,
                   int32_t firstMaterialId = 0, int32_t partId = 0) {
  const Vec3f e = high - low;
  const Vec3f x(e.x, 0, 0), y(0, e.y, 0), z(0, 0, e.z);
  const std::array<std::array<Vec3f, 3>, 6> sides{{{low, y, z},  // u x v looks inward
                                                   {low + x, z, y},
                                                   {low, z, x},
                                                   {low + y, x, z},
                                                   {low, x, y},
                                                   {low + z, y, x}}};
  for (int side = 0; side < 6; ++side) {
    const auto& [origin, u, v] = sides[size_t(side)];
    AddQuad(mesh, origin, inward ? u : v, inward ? v : u, materials.reflectance[size_t(side)],
            materials.emittance[size_t(side)], n, firstMaterialId + side, partId);
  }
}

/// Gives the scene as many materials and parts as its faces name.
inline void CompleteTables(Scene* scene) {
  for (size_t face = 0; face < scene->mesh.triangles.size(); ++face) {
    const size_t material = size_t(scene->mesh.materialId[face]);
    const size_t part = size_t(scene->mesh.partId[face]);
    if (scene->materials.size() <= material) scene->materials.resize(material + 1);
    if (scene->parts.size() <= part) scene->parts.resize(part + 1);
    scene->materials[material].name = "material " + std::to_string(material);
    scene->materials[material].reflectance = scene->mesh.reflectance[face];
    scene->materials[material].emittance = scene->mesh.emittance[face];
    scene->parts[part].name = "part " + std::to_string(part);
  }
}

/// A closed cube [0, size]^3 seen from within: all sides reflect `rho`, the ceiling alone has the
/// exitance `emittance` (W/m2) and reflects nothing.
inline Scene BoxRoom(float size, float rho, float emittance, int n = 1) {
  Scene scene;
  BoxMaterials materials(rho);
  materials.reflectance[kCeiling] = Spectrum(0.f);
  materials.emittance[kCeiling] = Spectrum(emittance);
  AddBox(&scene.mesh, {0, 0, 0}, {size, size, size}, materials, true, n);
  CompleteTables(&scene);
  return scene;
}

/// A closed unit cube, wound inward, whose every face emits `emittance` (exitance, W/m2) inward and
/// reflects `rho`: its radiosity is emittance / (1 - rho) everywhere.
inline Scene FurnaceCube(float rho, float emittance = 1, int n = 1) {
  Scene scene;
  AddBox(&scene.mesh, {0, 0, 0}, {1, 1, 1}, BoxMaterials(rho, emittance), true, n);
  CompleteTables(&scene);
  return scene;
}

/// Adds a sphere of `stacks` x 2 `stacks` facets with smooth normals; fronts look outward or
/// inward.
inline void AddSphere(TriangleMesh* mesh, const Vec3f& center, float radius, int stacks,
                      const Spectrum& reflectance, const Spectrum& emittance = Spectrum(0.f),
                      bool inward = false, int32_t materialId = 0, int32_t partId = 0) {
  const int slices = 2 * stacks;
  const int32_t first = int32_t(mesh->positions.size());
  for (int j = 0; j <= stacks; ++j) {
    for (int i = 0; i < slices; ++i) {
      const double theta = kPi * j / stacks, phi = 2 * kPi * i / slices;
      const Vec3f d(float(std::sin(theta) * std::cos(phi)), float(std::sin(theta) * std::sin(phi)),
                    float(std::cos(theta)));
      AddPoint(mesh, center + d * radius, inward ? -d : d);
    }
  }
  const auto add = [&](int32_t a, int32_t b, int32_t c) {
    if (inward) std::swap(b, c);
    AddFace(mesh, {a, b, c}, reflectance, emittance, materialId, partId);
  };
  for (int j = 0; j < stacks; ++j) {
    for (int i = 0; i < slices; ++i) {
      const int32_t a = first + j * slices + i, b = first + j * slices + (i + 1) % slices;
      const int32_t c = a + slices, d = b + slices;
      if (j > 0) add(a, c, b);
      if (j < stacks - 1) add(b, c, d);
    }
  }
}

/// A sun of `size` radians across in the zenith, 1 W/m2, over a black screen at z = 1 that covers
/// x < 0 for 1 m.
inline Scene ScreenUnderSun(float size) {
  Scene scene;
  AddQuad(&scene.mesh, {-1, -1, 1}, {1, 0, 0}, {0, 2, 0}, Spectrum(0.f));
  CompleteTables(&scene);
  Light sun;
  sun.type = LightType::Directional;
  sun.intensity = Spectrum(1.f);
  sun.size = size;
  scene.lights = {sun};
  return scene;
}

/// What comes through beside the edge of that screen at `x` and z = 0, W/m2: the part of the disc
/// beyond a straight line, but for the square of its size.
inline double Penumbra(double x, double size) {
  const double t = std::min(1.0, std::max(-1.0, x / std::tan(size / 2)));
  return 0.5 + (t * std::sqrt(1 - t * t) + std::asin(t)) / kPi;
}

}  // namespace lambert::testing
