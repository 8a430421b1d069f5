// Light straight from the sources: however few the rays, none is lost or found in the mean.
#include "Radiosity/Core/DirectLight.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Common/Testing/TestScenes.h"
#include "Radiosity/Core/GatheredPoints.h"
#include "Radiosity/Core/LitSides.h"

namespace lambert {
namespace {

/// Adds a black floor of 8 m, and 1 m above its middle a lamp of `length` m by 1 m that shines
/// down.
void AddFloorAndLamp(Scene* scene, float length) {
  testing::AddQuad(&scene->mesh, {-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, Spectrum(0.f), Spectrum(0.f), 1,
                   0);
  testing::AddQuad(&scene->mesh, {0, -0.5f, 1}, {0, 1, 0}, {length, 0, 0}, Spectrum(0.f),
                   Spectrum(1.f), 1, 1);
}

GatherPoint OnFloor(float x, float y) { return {{x, y, 0}, {0, 0, 1}, {0, 0, 1}}; }

TEST(DirectLight, FewRaysSeeAsMuchAsMany) {
  // A long lamp, the near end of which is hidden: nearly all of its light comes from there.
  Scene scene;
  AddFloorAndLamp(&scene, 6);
  testing::AddQuad(&scene.mesh, {-1, -2, 0.9f}, {0, 4, 0}, {2.5f, 0, 0}, Spectrum(0.f));
  testing::CompleteTables(&scene);
  const RayScene rayScene(scene.mesh);
  const DirectLight direct(scene, rayScene);
  const GatherPoint at = OnFloor(0, 0);
  int64_t rays = 0;
  const float expected = direct.Sample(at, 1 << 16, 1, &rays).irradiance.r;
  ASSERT_GT(expected, 0.001f);
  for (const int count : {1, 2, 4, 8}) {
    constexpr int kTimes = 20000;
    double mean = 0;
    for (uint64_t seed = 0; seed < kTimes; ++seed) {
      mean += double(direct.Sample(at, count, seed, &rays).irradiance.r) / kTimes;
    }
    EXPECT_NEAR(mean, expected, 0.1 * double(expected)) << count << " rays";
  }
}

TEST(GatheredPoints, LittleLightIsNotLost) {
  // A hole in a screen shows every place of the floor a small part of the lamp.
  Scene scene;
  AddFloorAndLamp(&scene, 1);
  constexpr float kHole = 0.04f, kWide = 6;
  const float middle = 0.5f;
  const Spectrum black(0.f);
  testing::AddQuad(&scene.mesh, {middle - kWide, -kWide, 0.5f}, {kWide - kHole, 0, 0},
                   {0, 2 * kWide, 0}, black);
  testing::AddQuad(&scene.mesh, {middle + kHole, -kWide, 0.5f}, {kWide - kHole, 0, 0},
                   {0, 2 * kWide, 0}, black);
  testing::AddQuad(&scene.mesh, {middle - kHole, -kWide, 0.5f}, {2 * kHole, 0, 0},
                   {0, kWide - kHole, 0}, black);
  testing::AddQuad(&scene.mesh, {middle - kHole, kHole, 0.5f}, {2 * kHole, 0, 0},
                   {0, kWide - kHole, 0}, black);
  testing::CompleteTables(&scene);
  scene.mesh.Complete();
  const ClusterTree tree = ClusterFaces(&scene.mesh, scene.parts);
  const RayScene rayScene(scene.mesh);
  int64_t rays = 0;
  const std::vector<uint8_t> lit = FindLitSides(scene, tree, rayScene, &rays);
  const ElementHierarchy hierarchy(scene, tree, lit, {});
  ElementLight light;
  light.Grow(hierarchy);
  const FinalGather gather(hierarchy, rayScene, &light);
  std::vector<GatheredPoints::Point> points;
  constexpr int kAcross = 100;
  for (int i = 0; i < kAcross * kAcross; ++i) {
    const float x = 0.2f + 0.6f * float(i % kAcross) / kAcross;
    const float y = -0.3f + 0.6f * float(i / kAcross) / kAcross;
    points.push_back({uint64_t(i), OnFloor(x, y), false});
  }
  GatheredPoints gathered(gather, {});
  double mean = 0, expected = 0;
  for (const GatheredPoints::Light& at : gathered.At(points, &rays)) {
    mean += double(at.irradiance.r);
  }
  for (size_t i = 0; i < points.size(); ++i) {
    expected += double(gather.Direct().Sample(points[i].at, 1024, i, &rays).irradiance.r);
  }
  ASSERT_GT(expected, 0);
  EXPECT_NEAR(mean / expected, 1, 0.06);
}

TEST(DirectLight, ThePenumbraOfASun) {
  const float size = 0.04f;
  const Scene scene = testing::ScreenUnderSun(size);
  const RayScene rays(scene.mesh);
  const DirectLight direct(scene, rays);
  for (const float x : {-0.03f, -0.01f, 0.f, 0.005f, 0.015f, 0.03f}) {
    double sum = 0;
    constexpr int kRepeats = 64;
    for (int k = 0; k < kRepeats; ++k) {
      int64_t cast = 0;
      sum += double(direct.Sample(OnFloor(x, 0), 64, uint64_t(k), &cast).irradiance.g);
      EXPECT_EQ(cast, 16);
    }
    // 1024 rays, by 4 standard errors at most were they not spread.
    EXPECT_NEAR(sum / kRepeats, testing::Penumbra(double(x), double(size)), 4 * 0.5 / 32);
  }
}

}  // namespace
}  // namespace lambert
