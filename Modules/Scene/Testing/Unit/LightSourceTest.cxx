// Lights without geometry against closed forms: over an open facet nothing but their samples and
// their radiance counts.
#include "Scene/Core/LightSource.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lambert {
namespace {

Light MakeLight(LightType type, const Spectrum& intensity) {
  Light light;
  light.type = type;
  light.intensity = intensity;
  return light;
}

/// Irradiance of a facet that nothing stands before: by the samples, and by rays over its
/// hemisphere that all escape.
Spectrum OpenIrradiance(const std::vector<Light>& lights, const Vec3f& x, const Vec3f& n,
                        int rays = 16384) {
  const LightSources sources(lights);
  Spectrum sum = sources.Irradiance({x, n, n}, rays, 1, [](const LightSample&) { return true; });
  Vec3f u, v;
  CoordinateSystem(n, &u, &v);
  for (int i = 0; i < rays; ++i) {
    const Vec3f d =
        CosineHemisphere((float(i) + 0.5f) / float(rays), RadicalInverse(uint32_t(i), 0));
    sum += sources.Radiance(u * d.x + v * d.y + n * d.z) * (float(kPi) / float(rays));
  }
  return sum;
}

TEST(LightSource, PointSpotAndDirectional) {
  // I cos / d^2: 3 m above the facet, and 4 m beside it.
  Light point = MakeLight(LightType::Point, Spectrum(50.f));
  point.position = {4, 0, 3};
  EXPECT_NEAR(OpenIrradiance({point}, {}, {0, 0, 1}).g, 50.f * 0.6f / 25, 1e-6f);
  EXPECT_EQ(OpenIrradiance({point}, {}, {0, 0, -1}).g, 0);

  // A spot gives the same within its cone, and nothing beyond it.
  Light spot = point;
  spot.type = LightType::Spot;
  spot.direction = Normalize(Vec3f(-4, 0, -3));
  spot.innerConeAngle = 0.1f;
  spot.outerConeAngle = 0.2f;
  EXPECT_NEAR(OpenIrradiance({spot}, {}, {0, 0, 1}).g, 50.f * 0.6f / 25, 1e-6f);
  EXPECT_EQ(OpenIrradiance({spot}, {-3, 0, 0}, {0, 0, 1}).g, 0);

  // E cos, everywhere.
  Light sun = MakeLight(LightType::Directional, Spectrum(2.f));
  sun.direction = Normalize(Vec3f(-4, 0, -3));
  EXPECT_NEAR(OpenIrradiance({sun}, {7, 8, 9}, {0, 0, 1}).g, 2 * 0.6f, 1e-6f);
}

// The disc of the sun is as bright as its size asks for: the irradiance of a facet that faces it is
// the same for any size, and goes with the cosine as long as all of it is above the horizon.
TEST(LightSource, ASunGivesTheSameForAnySize) {
  Light sun = MakeLight(LightType::Directional, Spectrum(2.f));
  sun.direction = Normalize(Vec3f(-4, 0, -3));
  for (const float degrees : {0.f, 0.53f, 20.f, 60.f}) {
    sun.size = degrees * float(kPi) / 180;
    // 16 samples of the disc, whose cosines vary by its sine.
    const float tolerance = 1e-6f + 0.1f * std::sin(sun.size / 2);
    EXPECT_NEAR(OpenIrradiance({sun}, {}, {0, 0, 1}).g, 2 * 0.6f, tolerance);
    EXPECT_NEAR(OpenIrradiance({sun}, {}, {0.8f, 0, 0.6f}).g, 2, 1e-6f);
  }

  // On the horizon half of it is left: of a disc of radius r at x from its middle, over the upper
  // half, the mean of x is 4 r / (3 pi), and the half counts for a half.
  sun.direction = {1, 0, 0};
  sun.size = 0.2f;
  EXPECT_NEAR(OpenIrradiance({sun}, {}, {0, 0, 1}).g, 2 * 2 * std::sin(0.1f) / (3 * float(kPi)),
              0.1f * 2 * std::sin(0.1f));
}

// A ball of even radiance gives what a point of its intensity gives.
TEST(LightSource, ABallGivesWhatAPointGives) {
  Light ball = MakeLight(LightType::Point, Spectrum(50.f));
  ball.position = {0, 0, 5};
  for (const float radius : {0.f, 0.5f, 4.f}) {
    ball.size = radius;
    EXPECT_NEAR(OpenIrradiance({ball}, {}, {0, 0, 1}).g, 2, 1e-5f);
    EXPECT_NEAR(OpenIrradiance({ball}, {}, {0.6f, 0, 0.8f}).g, 2 * 0.8f, 0.02f * radius + 1e-5f);
  }
  ball.size = 6;
  EXPECT_EQ(OpenIrradiance({ball}, {}, {0, 0, 1}).g, 0) << "within it";
}

TEST(LightSource, ASkyGivesPiL) {
  const Light sky = MakeLight(LightType::Sky, {1, 2, 3});
  const Spectrum e = OpenIrradiance({sky}, {}, Normalize(Vec3f(1, 2, 3)));
  // Sums of 16384 floats.
  for (int band = 0; band < 3; ++band) EXPECT_NEAR(e[band], float(kPi) * float(band + 1), 1e-2f);
}

TEST(LightSource, WhatIsBlackIsLeftOut) {
  const LightSources sources(
      {MakeLight(LightType::Sky, Spectrum()), MakeLight(LightType::Point, Spectrum())});
  EXPECT_TRUE(sources.IsEmpty());
  EXPECT_FALSE(sources.FillSky());
  EXPECT_FALSE(sources.HaveSamples());
}

}  // namespace
}  // namespace lambert
