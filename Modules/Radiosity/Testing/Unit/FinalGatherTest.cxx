// The light that leaves have in balance, whatever links made of it before.
#include "Radiosity/Core/FinalGather.h"

#include <gtest/gtest.h>

#include "SolverScenes.h"

namespace lambert {
namespace {

/// One bounce at a place in the middle of the floor of a cube of 1 m, W/m2, once its leaves are in
/// balance; links had left `before` all around them.
float BounceInCube(float reflectance, float emittance, float before) {
  testing::ModelledScene modelled;
  testing::AddBox(&modelled.scene.mesh, {0, 0, 0}, {1, 1, 1},
                  testing::BoxMaterials(reflectance, emittance), true);
  modelled.Model();
  ElementLight light;
  light.Grow(*modelled.hierarchy);
  for (VectorIrradiance& irradiance : light.irradiance) irradiance.isotropic = Spectrum(before);
  FinalGather gather(*modelled.hierarchy, *modelled.rayScene, &light);
  int64_t rays = 0;
  gather.GatherAtLeaves(1024, 1, 1, &rays);
  EXPECT_GT(rays, 0);
  BounceRays bounce;
  bounce.count = 4096;
  return gather.Bounces({{{0.5f, 0.5f, 0}, {0, 0, 1}, {0, 0, 1}, 0}}, bounce, &rays)[0].Mean().g;
}

TEST(FinalGather, NoLightStaysInAClosedThing) {
  // In eight bounces it would lose a seventh.
  EXPECT_EQ(BounceInCube(0.98f, 0, 10), 0);
}

TEST(FinalGather, LightIsFollowedToTheLastBounce) {
  // A furnace receives 1 / (1 - 0.9) W/m2 and reflects 9 of them, 4 in the first six bounces. What
  // is near sends one ray to the emitters, which scatters by half of what it brings.
  EXPECT_NEAR(BounceInCube(0.9f, 1, 0), 9, 0.05);
  EXPECT_EQ(BounceInCube(0.9f, 1, 50), BounceInCube(0.9f, 1, 0));
}

}  // namespace
}  // namespace lambert
