#include "Classical/Core/ShaftBlockers.h"

#include <gtest/gtest.h>

#include "Common/Core/Random.h"
#include "Common/Testing/TestScenes.h"

namespace lambert {
namespace {

Vec3f RandomPoint(Random* random, float scale) {
  const float x = random->Uniform(), y = random->Uniform();
  return (Vec3f(x, y, random->Uniform()) - Vec3f(0.5f, 0.5f, 0.5f)) * scale;
}

// Seeded triangles and groups: no shaft is called open through which a ray of the hierarchy is
// blocked, and trying the few faces of a shaft tells the same as the hierarchy.
TEST(ShaftBlockers, AgreeWithTheHierarchyOfRays) {
  Scene scene;
  Random random(5);
  for (int i = 0; i < 40; ++i) {
    const Vec3f a = RandomPoint(&random, 2);
    testing::AddTriangle(&scene.mesh, a, a + RandomPoint(&random, 1), a + RandomPoint(&random, 1),
                         Spectrum(0.5f));
  }
  const RayScene rays(scene.mesh);
  std::vector<std::vector<Vec3f>> groups(60);
  for (auto& group : groups) {
    const Vec3f centre = RandomPoint(&random, 2);
    for (int i = 0; i < 5; ++i) group.push_back(centre + RandomPoint(&random, 0.2f));
  }
  const ShaftBlockers shafts(scene.mesh, rays.Epsilon(), groups);
  int open = 0, tried = 0, differing = 0;
  for (int32_t a = 0; a < 60; ++a) {
    for (int32_t b = 0; b < 60; ++b) {
      const ShaftBlockers::Faces faces = shafts.Between(a, b);
      open += faces.IsOpen() ? 1 : 0;
      if (faces.IsCrowd()) continue;
      for (const Vec3f& from : groups[size_t(a)]) {
        for (const Vec3f& to : groups[size_t(b)]) {
          const bool blocked = rays.Occluded(from, to);
          if (faces.IsOpen()) {
            ASSERT_FALSE(blocked);
          }
          differing += blocked != shafts.IsBlocked(faces, {from, to}) ? 1 : 0;
          ++tried;
        }
      }
    }
  }
  EXPECT_GT(open, 300);
  EXPECT_GT(tried, 20000);
  // Rays within 1e-6 of an edge, or whose ends lie within the tolerance of a face, may differ: none
  // to a few of tens of thousands.
  EXPECT_LE(differing, 3);
}

// Between two walls of a convex room there is nothing; a screen in the middle is found.
TEST(ShaftBlockers, AScreenBetweenWalls) {
  Scene scene;
  testing::AddBox(&scene.mesh, {0, 0, 0}, {1, 1, 1}, testing::BoxMaterials(0.5f), true);
  const std::vector<std::vector<Vec3f>> groups{{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}},
                                               {{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}},
                                               {{0, 0, 0}, {1, 0, 0}, {1, 0.2f, 0}, {0, 0.2f, 0}}};
  EXPECT_TRUE(ShaftBlockers(scene.mesh, 1e-5f, groups).Between(0, 1).IsOpen());
  testing::AddQuad(&scene.mesh, {0.5f, 0.4f, 0.4f}, {0, 0.2f, 0}, {0, 0, 0.2f}, Spectrum(0.5f));
  const ShaftBlockers shafts(scene.mesh, 1e-5f, groups);
  const ShaftBlockers::Faces faces = shafts.Between(0, 1);
  ASSERT_EQ(faces.count, 2);
  EXPECT_TRUE(shafts.IsBlocked(faces, {{0, 0.5f, 0.5f}, {1, 0.5f, 0.5f}}));
  EXPECT_TRUE(shafts.IsBlocked(faces, {{1, 0.5f, 0.5f}, {0, 0.5f, 0.5f}}));
  EXPECT_FALSE(shafts.IsBlocked(faces, {{0, 0.1f, 0.5f}, {1, 0.1f, 0.5f}}));
  EXPECT_FALSE(shafts.IsBlocked(faces, {{0, 0.5f, 0.5f}, {0.4f, 0.5f, 0.5f}}));
}

}  // namespace
}  // namespace lambert
