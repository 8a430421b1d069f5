// What neighbours found of the light at a place, against fields that are known.
#include "Radiosity/Core/IrradianceFilter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "Common/Core/Random.h"
#include "Common/Testing/TestScenes.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {
namespace {

/// A grid of samples on the floor, 1 cm apart, whose light is `field(x, y)` plus uniform noise.
template <class Field>
std::vector<IrradianceSample> Floor(int across, const Field& field, float noise, float reach) {
  std::vector<IrradianceSample> samples;
  Random random(1);
  for (int y = 0; y < across; ++y) {
    for (int x = 0; x < across; ++x) {
      const float light = field(0.01f * float(x), 0.01f * float(y));
      IrradianceSample sample;
      sample.position = {0.01f * float(x), 0.01f * float(y), 0};
      sample.normal = {0, 0, 1};
      sample.irradiance = Spectrum(light + noise * (2 * random.Uniform() - 1));
      sample.rays = 4;
      // Uniform noise has a third of its square as variance; of each ray four times as much.
      sample.variance = 3 * 4 * noise * noise / 3;
      sample.reach = reach;
      samples.push_back(sample);
    }
  }
  return samples;
}

// A plane is kept as it is, at the border too, but for what holds slopes back: in a corner a
// fifth of what the mean of the neighbours would be off by (0.15, 3.6 / m over 4 cm).
TEST(IrradianceFilter, KeepsASlope) {
  const auto slope = [](float x, float y) { return 1 + 2 * x + 3 * y; };
  const std::vector<IrradianceSample> samples = Floor(20, slope, 0, 0.1f);
  const SampleNeighbours neighbours(samples, 0);
  for (int32_t i = 0; i < int32_t(samples.size()); ++i) {
    const Vec3f& p = samples[size_t(i)].position;
    const float found = FilterIrradiance(samples, neighbours, i).irradiance.g;
    EXPECT_NEAR(found, slope(p.x, p.y), 0.2 * 0.15) << p.x << " " << p.y;
  }
}

// Noise falls by about the root of the samples within reach, and the filter says by how much.
TEST(IrradianceFilter, SmoothsNoiseAndKnowsHowMuchIsLeft) {
  const std::vector<IrradianceSample> samples = Floor(
      30, [](float, float) { return 1.f; }, 0.5f, 0.1f);
  const SampleNeighbours neighbours(samples, 0);
  double squares = 0, said = 0;
  for (int32_t i = 0; i < int32_t(samples.size()); ++i) {
    const FilteredIrradiance light = FilterIrradiance(samples, neighbours, i);
    squares += std::pow(double(light.irradiance.g) - 1, 2) / double(samples.size());
    said += double(light.variance) / 3 / double(samples.size());
  }
  // A sample alone is off by 0.29; 33 of them, weighed unevenly, by at least 0.29 / 6.
  EXPECT_LT(std::sqrt(squares), 0.29 / 3);
  EXPECT_GT(std::sqrt(squares), 0.29 / 6);
  // 900 overlapping means have some 30 independent ones: the variance is known to a half.
  EXPECT_NEAR(said / squares, 1, 0.5);
}

// A step farther away than samples reach is not blurred: two rooms on both sides of a wall.
TEST(IrradianceFilter, MixesNothingBeyondItsReach) {
  const auto rooms = [](float x, float) { return x < 0.095f ? 1.f : 0.f; };
  std::vector<IrradianceSample> samples = Floor(20, rooms, 0, 0.1f);
  for (IrradianceSample& s : samples) s.reach = std::abs(s.position.x - 0.095f);
  const SampleNeighbours neighbours(samples, 0);
  for (int32_t i = 0; i < int32_t(samples.size()); ++i) {
    EXPECT_EQ(FilterIrradiance(samples, neighbours, i).irradiance.g,
              samples[size_t(i)].irradiance.g);
  }
}

// In a corner, where samples reach nowhere, the nearest smooth noise as far as they agree.
TEST(IrradianceFilter, AsksTheNearestWhereNoneLiesWithinReach) {
  const std::vector<IrradianceSample> samples = Floor(
      30, [](float, float) { return 1.f; }, 0.5f, 1e-6f);
  const SampleNeighbours neighbours(samples, 0);
  double squares = 0;
  for (int32_t i = 0; i < int32_t(samples.size()); ++i) {
    const FilteredIrradiance light = FilterIrradiance(samples, neighbours, i);
    squares += std::pow(double(light.irradiance.g) - 1, 2) / double(samples.size());
  }
  // A sample alone is off by 0.29; nine that all were heard by a third of that.
  EXPECT_LT(std::sqrt(squares), 0.29 / 1.7);
}

// They do not where light changes by more than rays scatter: behind a wall it stays dark.
TEST(IrradianceFilter, HearsNoneOfTheNearestAcrossAStep) {
  const auto rooms = [](float x, float) { return x < 0.095f ? 1.f : 0.f; };
  std::vector<IrradianceSample> samples = Floor(20, rooms, 0, 1e-6f);
  Random random(2);
  for (IrradianceSample& s : samples) {
    s.irradiance *= 1 + 0.2f * (2 * random.Uniform() - 1);
    s.variance = 3 * 4 * 0.04f / 3;
  }
  const SampleNeighbours neighbours(samples, 0);
  for (int32_t i = 0; i < int32_t(samples.size()); ++i) {
    const float found = FilterIrradiance(samples, neighbours, i).irradiance.g;
    if (samples[size_t(i)].position.x < 0.095f) {
      EXPECT_GT(found, 0.7f);
    } else {
      EXPECT_LT(found, 0.02f);
    }
  }
}

// A wall's samples tell nothing of the floor, nor do those of its other side.
TEST(IrradianceFilter, AsksThoseThatLookTheSameWay) {
  std::vector<IrradianceSample> samples = Floor(
      5, [](float, float) { return 1.f; }, 0, 1.f);
  const size_t floor = samples.size();
  for (size_t i = 0; i < floor; ++i) {
    IrradianceSample below = samples[i], wall = samples[i];
    below.normal = {0, 0, -1};
    wall.normal = {1, 0, 0};
    below.irradiance = wall.irradiance = Spectrum(9.f);
    samples.push_back(below);
    samples.push_back(wall);
  }
  const SampleNeighbours neighbours(samples, 0);
  for (int32_t i = 0; i < int32_t(floor); ++i) {
    for (const int32_t* n = neighbours.begin(i); n != neighbours.end(i); ++n) {
      EXPECT_LT(*n, int32_t(floor));
      EXPECT_NE(*n, i);
    }
    EXPECT_NEAR(FilterIrradiance(samples, neighbours, i).irradiance.g, 1, 1e-5);
  }
}

// A sample alone is what it is, and as uncertain as its rays.
TEST(IrradianceFilter, LeavesALoneSampleAsItIs) {
  IrradianceSample lone;
  lone.normal = {0, 0, 1};
  lone.irradiance = {1, 2, 3};
  lone.variance = 8, lone.rays = 4, lone.reach = 1;
  const std::vector<IrradianceSample> samples(1, lone);
  const FilteredIrradiance light = FilterIrradiance(samples, SampleNeighbours(samples, 0), 0);
  EXPECT_EQ(light.irradiance, lone.irradiance);
  // 4 rays of variance 8 and two, thought of beforehand, of |E|^2 = 14: their mean over 4 rays.
  EXPECT_NEAR(light.variance, (4 * 8 + 2 * 14) / 6.0 / 4, 1e-5);
}

// Rays that all found the same are still as uncertain as light usually is, the fewer they are.
TEST(IrradianceFilter, FewRaysThatFindNothingAreNotSureOfIt) {
  IrradianceSample dark;
  dark.normal = {0, 0, 1};
  dark.rays = 8, dark.reach = 1;
  const std::vector<IrradianceSample> samples(1, dark);
  const FilteredIrradiance light = FilterIrradiance(samples, SampleNeighbours(samples, 0), 0, 3);
  EXPECT_EQ(light.irradiance, Spectrum());
  EXPECT_NEAR(light.variance, 2 * 9 / 10.0 / 8, 1e-5);
}

TEST(IrradianceFilter, HearsNobodyAcrossASheet) {
  // Places on a floor, on a sheet a centimetre above its half x > 0, below that sheet, and one that
  // is as high where there is none.
  Scene scene;
  testing::AddQuad(&scene.mesh, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, Spectrum(0.5f));
  testing::AddQuad(&scene.mesh, {0, -1, 0.01f}, {1, 0, 0}, {0, 2, 0}, Spectrum(0.5f));
  testing::CompleteTables(&scene);
  scene.mesh.Complete();
  const RayScene rayScene(scene.mesh);
  enum { Floor, Above, Below, High, Kinds };
  const Vec3f places[Kinds] = {{-0.05f, 0, 0}, {0.05f, 0, 0.01f}, {0.05f, 0, 0}, {-0.1f, 0, 0.01f}};
  std::vector<IrradianceSample> samples;
  for (int i = 0; i < 4; ++i) {
    for (const Vec3f& place : places) {
      samples.push_back({place + Vec3f(0, 0.05f * float(i), 0), {0, 0, 1}, Spectrum(1.f), 0, 4, 1});
    }
  }
  int64_t rays = 0;
  const SampleNeighbours all(samples, 0), seen(samples, 0, &rayScene, &rays);
  EXPECT_GT(rays, 0);
  const auto hears = [&](const SampleNeighbours& neighbours, int32_t own, int kind) {
    return std::any_of(neighbours.begin(own), neighbours.end(own),
                       [&](int32_t other) { return other % Kinds == kind; });
  };
  for (int32_t i = 0; i < int32_t(samples.size()); i += Kinds) {
    EXPECT_TRUE(hears(all, i + Below, Above));
    EXPECT_FALSE(hears(seen, i + Below, Above));
    EXPECT_FALSE(hears(seen, i + Above, Below));
    EXPECT_TRUE(hears(seen, i + Floor, Below));
    EXPECT_TRUE(hears(seen, i + Floor, High));
  }
}

}  // namespace
}  // namespace lambert
