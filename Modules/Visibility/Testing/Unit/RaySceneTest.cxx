// What rays that leave a surface meet nearer than the length that others skip.
#include "Visibility/Core/RayScene.h"

#include <gtest/gtest.h>

#include "Common/Core/Random.h"
#include "Common/Testing/TestScenes.h"

namespace lambert {
namespace {

/// A cube of `size` m about the origin, in a scene whose diagonal is 20 m.
Scene SmallCubeInLargeScene(float size) {
  Scene scene;
  const float a = size / 2;
  const Spectrum grey(0.5f);
  TriangleMesh* mesh = &scene.mesh;
  for (const float side : {-a, a}) {
    testing::AddQuad(mesh, {side, -a, -a}, {0, size, 0}, {0, 0, size}, grey);
    testing::AddQuad(mesh, {-a, side, -a}, {0, 0, size}, {size, 0, 0}, grey);
    testing::AddQuad(mesh, {-a, -a, side}, {size, 0, 0}, {0, size, 0}, grey);
  }
  testing::AddQuad(mesh, {-8, -6, -4}, {16, 0, 0}, {0, 12, 0}, grey);
  testing::CompleteTables(&scene);
  return scene;
}

TEST(RayScene, NoneLeavesASmallClosedThing) {
  // Not much larger than what rays skip: those that start near its walls would pass them.
  const float size = 4e-4f;
  const Scene scene = SmallCubeInLargeScene(size);
  const RayScene rays(scene.mesh);
  ASSERT_LT(rays.Epsilon(), size);
  ASSERT_GT(2 * rays.Epsilon(), size);
  int leaving = 0;
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const RayStart start{{size * 0.9f * (random.Uniform() - 0.5f),
                          size * 0.9f * (random.Uniform() - 0.5f), -size / 2},
                         {0, 0, 1}};
    const Vec3f direction = CosineHemisphere(random.Uniform(), random.Uniform());
    if (direction.z < 0.2f) continue;  // So flat are those that rounding may bring to the floor.
    EXPECT_LT(rays.Closest(start, direction).distance, 2 * size);
    EXPECT_TRUE(rays.Occluded(start, direction, 1));
    leaving += rays.Closest(start.position, direction).face < 0;
  }
  EXPECT_GT(leaving, 100);
}

TEST(RayScene, WhatLiesUponASurfaceIsPassed) {
  // A second floor upon the first, less than rays skip above it, and a wall over both.
  Scene scene;
  const Spectrum grey(0.5f);
  testing::AddQuad(&scene.mesh, {-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, grey);
  testing::AddQuad(&scene.mesh, {-4, -4, 5e-5f}, {8, 0, 0}, {0, 8, 0}, grey);
  testing::AddQuad(&scene.mesh, {-4, -4, 2}, {0, 8, 0}, {8, 0, 0}, grey);
  testing::CompleteTables(&scene);
  const RayScene rays(scene.mesh);
  ASSERT_GT(rays.Epsilon(), 5e-5f);
  const RayStart start{{0.3f, 0.2f, 0}, {0, 0, 1}};
  EXPECT_NEAR(rays.Closest(start, {0, 0, 1}).distance, 2, 1e-5);
  EXPECT_FALSE(rays.Occluded(start, Vec3f(0.3f, 0.2f, 1.5f)));
  EXPECT_TRUE(rays.Occluded(start, Vec3f(0.3f, 0.2f, 2.5f)));
  EXPECT_TRUE(rays.OccludedNear(start, {0, 0, 1}));
  EXPECT_FALSE(rays.OccludedNear({{0.3f, 0.2f, 5e-5f}, {0, 0, 1}}, {0, 0, 1}));
}

}  // namespace
}  // namespace lambert
