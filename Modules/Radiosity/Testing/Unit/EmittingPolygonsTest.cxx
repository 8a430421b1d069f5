// Which emitting faces are one source.
#include "Radiosity/Core/EmittingPolygons.h"

#include <gtest/gtest.h>

#include "Common/Testing/TestScenes.h"
#include "Radiosity/Core/DirectLight.h"

namespace lambert {
namespace {

using namespace testing;

/// Adds a lamp at (x, y) in the plane z = 1 that shines down, of 2 n^2 triangles.
void AddLamp(Scene* scene, float x, float y, float width, float depth, int n, float emittance = 1) {
  AddQuad(&scene->mesh, {x, y, 1}, {0, depth, 0}, {width, 0, 0}, Spectrum(0.f), Spectrum(emittance),
          n, 1);
}

std::vector<EmittingPolygon> PolygonsOf(Scene* scene) {
  CompleteTables(scene);
  return FindEmittingPolygons(scene->mesh);
}

TEST(EmittingPolygons, ATessellatedLampIsOne) {
  Scene scene;
  AddLamp(&scene, 0.1f, 0.2f, 0.7f, 0.3f, 7);
  const std::vector<EmittingPolygon> polygons = PolygonsOf(&scene);
  ASSERT_EQ(polygons.size(), 1u);
  EXPECT_EQ(polygons[0].count, 4);
  EXPECT_NEAR(polygons[0].area, 0.21, 1e-6);
  EXPECT_LT(Length(polygons[0].normal - Vec3f(0, 0, -1)), 1e-6);
  EXPECT_LT(Length(polygons[0].Center() - Vec3f(0.45f, 0.35f, 1)), 1e-6);
  EXPECT_NEAR(polygons[0].LargestSize(), std::hypot(0.7, 0.3), 1e-6);
}

TEST(EmittingPolygons, OtherLampsAreOthers) {
  // Beside it one of another exitance, across a gap one of the same, and above one that stands.
  Scene scene;
  AddLamp(&scene, 0, 0, 1, 1, 2);
  AddLamp(&scene, 1, 0, 1, 1, 2, 2);
  AddLamp(&scene, -1.5f, 0, 1, 1, 2);
  AddQuad(&scene.mesh, {0, 0, 1}, {1, 0, 0}, {0, 0, 1}, Spectrum(0.f), Spectrum(1.f), 2, 1);
  const std::vector<EmittingPolygon> polygons = PolygonsOf(&scene);
  ASSERT_EQ(polygons.size(), 4u);
  for (const EmittingPolygon& polygon : polygons) EXPECT_NEAR(polygon.area, 1, 1e-6);
}

TEST(EmittingPolygons, WhatIsNotConvexStaysInFaces) {
  Scene scene;
  AddLamp(&scene, 0, 0, 1, 1, 1);
  AddLamp(&scene, 1, 0, 1, 1, 1);
  AddLamp(&scene, 0, 1, 1, 1, 1);
  const std::vector<EmittingPolygon> polygons = PolygonsOf(&scene);
  ASSERT_EQ(polygons.size(), 6u);
  for (const EmittingPolygon& polygon : polygons) EXPECT_EQ(polygon.count, 3);
}

// The same face twice gives twice the light: neither is joined to anything.
TEST(EmittingPolygons, DoubledFacesStayTwo) {
  Scene scene;
  AddLamp(&scene, 0, 0, 1, 1, 1);
  AddLamp(&scene, 0, 0, 1, 1, 1);
  float area = 0;
  for (const EmittingPolygon& polygon : PolygonsOf(&scene)) area += polygon.area;
  EXPECT_NEAR(area, 2, 1e-6);
}

// However fine the lamp, a few rays bring the exact light of what nothing hides.
TEST(EmittingPolygons, GiveTheLightOfTheirFaces) {
  std::vector<float> light;
  for (const int n : {1, 8}) {
    Scene scene;
    AddQuad(&scene.mesh, {-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, Spectrum(0.f));
    AddLamp(&scene, 0, 0, 1, 2, n);
    CompleteTables(&scene);
    const RayScene rayScene(scene.mesh);
    const DirectLight direct(scene, rayScene);
    int64_t rays = 0;
    light.push_back(
        direct.Sample({{0.3f, 0.4f, 0}, {0, 0, 1}, {0, 0, 1}}, 4, 1, &rays).irradiance.g);
  }
  EXPECT_NEAR(light[1], light[0], 1e-5 * double(light[0]));
}

}  // namespace
}  // namespace lambert
