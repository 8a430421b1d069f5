// Scenes with known answers. Lengths in metres, exitance in W/m2; every polygon has a material of
// its own, by which quantities name it.
#pragma once

#include <vector>

#include "Common/Testing/TestScenes.h"

namespace lambert::testing {

using Polygon = std::vector<Vec3f>;

/// Materials of a scene of few polygons.
constexpr int kSource = 0, kReceiver = 1, kBlocker = 2;

/// Side of the square facet that stands for a point, m.
constexpr float kFacetSide = 0.02f;

/// Adds a planar convex polygon as a fan; its front is the counter-clockwise side.
inline void AddPolygon(TriangleMesh* mesh, const Polygon& corners, int material,
                       float exitance = 0) {
  const Vec3f normal = Normalize(Cross(corners[1] - corners[0], corners[2] - corners[0]));
  std::vector<int32_t> points;
  for (const Vec3f& corner : corners) points.push_back(AddPoint(mesh, corner, normal));
  for (size_t i = 2; i < points.size(); ++i) {
    AddFace(mesh, {points[0], points[i - 1], points[i]}, Spectrum(0.f), Spectrum(exitance),
            material);
  }
}

/// Front along u x v.
inline Polygon Rectangle(const Vec3f& origin, const Vec3f& u, const Vec3f& v) {
  return {origin, origin + u, origin + u + v, origin + v};
}
/// A rectangle [x, x + a] x [y, y + b] at height z, facing up or down.
inline Polygon Floor(float z, float a = 1, float b = 1, float x = 0, float y = 0) {
  return Rectangle({x, y, z}, {a, 0, 0}, {0, b, 0});
}
inline Polygon Ceiling(float z, float a = 1, float b = 1, float x = 0, float y = 0) {
  return Rectangle({x, y, z}, {0, b, 0}, {a, 0, 0});
}
/// A rectangle [0, w] x [0, h] of y and z in the plane x = 0, facing +x.
inline Polygon Wall(float w = 1, float h = 1) { return Rectangle({0, 0, 0}, {0, w, 0}, {0, 0, h}); }

constexpr int kDiscSectors = 32;
/// A regular polygon with the area of the disc about the z axis at height z, facing up or down.
inline Polygon Disc(float radius, float z, bool up) {
  const double step = (up ? 2 : -2) * kPi / kDiscSectors;
  const double rim = double(radius) * std::sqrt(std::abs(step) / std::sin(std::abs(step)));
  Polygon corners;
  for (int i = 0; i < kDiscSectors; ++i) {
    corners.push_back({float(rim * std::cos(step * i)), float(rim * std::sin(step * i)), z});
  }
  return corners;
}

/// A source of exitance 1 and a black receiver, with a black blocker between them or none.
inline Scene SourceAndReceiver(const Polygon& source, const Polygon& receiver,
                               const Polygon& blocker = {}) {
  Scene scene;
  AddPolygon(&scene.mesh, source, kSource, 1);
  AddPolygon(&scene.mesh, receiver, kReceiver);
  if (!blocker.empty()) AddPolygon(&scene.mesh, blocker, kBlocker);
  CompleteTables(&scene);
  return scene;
}

/// The facet that stands for a point.
inline Polygon Facet(const Vec3f& center, const Vec3f& normal) {
  Vec3f u, v;
  CoordinateSystem(normal, &u, &v);
  u *= kFacetSide, v *= kFacetSide;
  return Rectangle(center - (u + v) * 0.5f, u, v);
}

/// A sphere of exitance 1 about (0, 0, height) over a facet at the origin. Its facets have the
/// area of the true sphere: so has, by Cauchy's formula, its shadow in the mean over all
/// directions.
inline Scene SphereOverFacet(float radius, float height, const Vec3f& normal, int stacks) {
  Scene scene;
  AddSphere(&scene.mesh, {0, 0, 0}, radius, stacks, Spectrum(0.f), Spectrum(1.f), false, kSource);
  double area = 0;
  for (int64_t face = 0; face < scene.mesh.FaceCount(); ++face) area += scene.mesh.Area(face);
  const float grow = float(std::sqrt(4 * kPi * double(radius) * double(radius) / area));
  for (Vec3f& p : scene.mesh.positions) p = p * grow + Vec3f(0, 0, height);
  AddPolygon(&scene.mesh, Facet({0, 0, 0}, normal), kReceiver);
  CompleteTables(&scene);
  return scene;
}

/// A spherical bowl of radius 1 about the origin that opens at `angle` (radians) from -z, smooth,
/// its inside the front.
inline TriangleMesh BowlMesh(double angle, int rings, int sectors, float rho, float exitance) {
  TriangleMesh mesh;
  const auto point = [&](int ring, int sector) {
    const double t = angle * ring / rings, p = 2 * kPi * sector / sectors;
    const Vec3f d(float(std::sin(t) * std::cos(p)), float(std::sin(t) * std::sin(p)),
                  float(-std::cos(t)));
    return AddPoint(&mesh, d, -d);
  };
  std::vector<int32_t> inner(size_t(sectors), point(0, 0));
  for (int ring = 1; ring <= rings; ++ring) {
    std::vector<int32_t> outer;
    for (int sector = 0; sector < sectors; ++sector) outer.push_back(point(ring, sector));
    for (int sector = 0; sector < sectors; ++sector) {
      const size_t a = size_t(sector), b = size_t((sector + 1) % sectors);
      AddFace(&mesh, {inner[a], outer[a], outer[b]}, Spectrum(rho), Spectrum(exitance));
      if (ring > 1)
        AddFace(&mesh, {inner[a], outer[b], inner[b]}, Spectrum(rho), Spectrum(exitance));
    }
    inner = outer;
  }
  return mesh;
}

constexpr int kBowlRings = 16, kBowlSectors = 32;
/// A bowl whose inside sees itself with the form factor `self`. That of any hollow with a plane
/// opening is 1 - opening / inside; the rim is put where the facets have it exactly.
inline Scene Bowl(double self, float rho, float exitance) {
  double low = 0.01, high = kPi - 0.01;
  for (int step = 0; step < 60; ++step) {
    const double angle = (low + high) / 2;
    const TriangleMesh mesh = BowlMesh(angle, kBowlRings, kBowlSectors, rho, exitance);
    double inside = 0;
    for (int64_t face = 0; face < mesh.FaceCount(); ++face) inside += mesh.Area(face);
    const double rim = std::sin(angle);
    const double opening = kBowlSectors / 2.0 * std::sin(2 * kPi / kBowlSectors) * rim * rim;
    (1 - opening / inside < self ? low : high) = angle;
  }
  Scene scene;
  scene.mesh = BowlMesh(low, kBowlRings, kBowlSectors, rho, exitance);
  CompleteTables(&scene);
  return scene;
}

/// A furnace that is not convex: a room in which a box hangs, all of it emitting 1.
inline Scene FurnaceWithBox(float rho) {
  Scene scene;
  AddBox(&scene.mesh, {0, 0, 0}, {3, 2, 2}, BoxMaterials(rho, 1), true);
  AddBox(&scene.mesh, {0.5f, 0.5f, 0.3f}, {1.5f, 1.2f, 1.1f}, BoxMaterials(rho, 1), false);
  CompleteTables(&scene);
  return scene;
}

/// A closed cube of 4 m with a point light of 10,000 lm in its middle.
inline Scene LampInCube(float rho) {
  Scene scene;
  AddBox(&scene.mesh, {0, 0, 0}, {4, 4, 4}, BoxMaterials(rho), true);
  CompleteTables(&scene);
  Light lamp;
  lamp.position = {2, 2, 2};
  lamp.intensity = Spectrum(float(10000 / (4 * kPi) / kLumensPerWatt));
  scene.lights = {lamp};
  return scene;
}

}  // namespace lambert::testing
