// Lights without geometry against closed forms: over an open facet nothing but their samples and
// their radiance counts.
#include "Scene/Core/LightSource.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "Scene/Core/EnvironmentImage.h"

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

Light MakeGradient(const Spectrum& zenith, const Spectrum& horizon, const Spectrum& ground) {
  Light light = MakeLight(LightType::GradientSky, zenith);
  light.horizon = horizon;
  light.ground = ground;
  return light;
}

// L = H + (Z - H) z over the horizon, z the sine of the elevation: a facet that looks up receives
// pi H + 2 pi (Z - H) / 3; one that stands upright sees half of the sky, and gets
// pi H / 2 + 2 (Z - H) / 3 of it and pi G / 2 of the ground; one that looks down pi G.
TEST(LightSource, AGradientSky) {
  const Light sky = MakeGradient({5, 1, 0}, {2, 2, 1}, {0.5f, 0.25f, 2});
  const Spectrum up = OpenIrradiance({sky}, {}, {0, 0, 1});
  const Spectrum level = OpenIrradiance({sky}, {}, {0, 1, 0});
  const Spectrum down = OpenIrradiance({sky}, {}, {0, 0, -1});
  for (int band = 0; band < 3; ++band) {
    const double h = double(sky.horizon[band]), rise = double(sky.intensity[band]) - h;
    const double g = double(sky.ground[band]);
    EXPECT_NEAR(up[band], kPi * h + 2 * kPi / 3 * rise, 1e-2);
    EXPECT_NEAR(level[band], kPi / 2 * (h + g) + 2 * rise / 3, 1e-2);
    EXPECT_NEAR(down[band], kPi * g, 1e-2);
  }
}

Light MakeSurroundings(int width, int height, std::vector<Spectrum> texels) {
  Light light = MakeLight(LightType::Environment, Spectrum(1.f));
  light.image = std::make_shared<const EnvironmentImage>(width, height, std::move(texels));
  return light;
}

TEST(LightSource, AnEvenEnvironmentIsASky) {
  const LightSources sources({MakeSurroundings(8, 4, std::vector<Spectrum>(32, {1, 2, 3}))});
  EXPECT_FALSE(sources.HaveSamples()) << "no part of it is bright";
  EXPECT_TRUE(sources.FillSky());
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const float z = 2 * random.Uniform() - 1, s = std::sqrt(1 - z * z), a = 7 * random.Uniform();
    const Spectrum radiance = sources.Radiance({s * std::cos(a), s * std::sin(a), z});
    EXPECT_EQ(radiance, Spectrum(1, 2, 3));
  }
}

// Of a texel that spans phi and the sines s0 to s1 a facet that looks up receives
// L phi (s1^2 - s0^2) / 2. Bright texels are sampled, the others found by rays; together they are
// the whole, whatever the limit between them.
TEST(LightSource, AnEnvironmentIsTheSumOfItsTexels) {
  constexpr int kWidth = 16, kHeight = 8;
  std::vector<Spectrum> texels;
  Random random(2);
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const float x = random.Uniform();
    texels.push_back(Spectrum(x, 0.5f, 1 - x) * (i % 7 == 3 ? 60.f : 1.f));
  }
  double expected[3] = {};
  for (int i = 0; i < kWidth * kHeight / 2; ++i) {
    const int row = i / kWidth;
    const double s1 = std::cos(kPi * row / kHeight), s0 = std::cos(kPi * (row + 1) / kHeight);
    for (int band = 0; band < 3; ++band) {
      expected[band] +=
          double(texels[size_t(i)][band]) * 2 * kPi / kWidth * (s1 * s1 - s0 * s0) / 2;
    }
  }
  const Light light = MakeSurroundings(kWidth, kHeight, texels);
  EXPECT_TRUE(LightSources({light}).HaveSamples());
  Spectrum sum;
  constexpr int kRepeats = 512;
  const LightSources sources({light});
  for (uint64_t seed = 0; seed < kRepeats; ++seed) {
    sum += sources.Irradiance({{}, {0, 0, 1}, {0, 0, 1}}, 16, seed,
                              [](const LightSample&) { return true; });
  }
  sum = sum / float(kRepeats);
  for (int i = 0; i < 65536; ++i) {
    const Vec3f d = CosineHemisphere((float(i) + 0.5f) / 65536, RadicalInverse(uint32_t(i), 0));
    sum += sources.Radiance(d) * (float(kPi) / 65536);
  }
  for (int band = 0; band < 3; ++band) {
    // 8192 samples, each at most three times the mean: 4 standard errors.
    EXPECT_NEAR(sum[band], expected[band], 0.05 * expected[band]);
  }
}

// The sun of an image is a directional light of radiance times solid angle. The middle of the image
// is seen to the north, +y here; a quarter to the right of it to the east, +x.
TEST(LightSource, ABrightTexelIsASun) {
  constexpr int kWidth = 512, kHeight = 256;
  constexpr int kRow = kHeight / 4, kColumn = kWidth * 3 / 4;  // 45 degrees high in the east.
  std::vector<Spectrum> texels(size_t(kWidth) * kHeight);
  texels[size_t(kRow) * kWidth + kColumn] = {1e4f, 2e4f, 3e4f};
  Light light = MakeSurroundings(kWidth, kHeight, texels);
  const double sine = std::sin(kPi / 4 - kPi / kHeight / 2),
               solidAngle = 2 * kPi / kWidth *
                            (std::cos(kPi * kRow / kHeight) - std::cos(kPi * (kRow + 1) / kHeight));
  const Vec3f toward = Normalize(Vec3f(1, 0, 1));
  for (const float turn : {0.f, float(kPi) / 2}) {
    light.rotation = turn;
    // Turned by a quarter clockwise it stands in the south, -y.
    const Vec3f n = turn == 0 ? toward : Vec3f(0, -toward.x, toward.z);
    EXPECT_NEAR(OpenIrradiance({light}, {}, n).g, 2e4 * solidAngle, 1e-3 * 2e4 * solidAngle);
    EXPECT_NEAR(OpenIrradiance({light}, {}, {0, 0, 1}).b, 3e4 * solidAngle * sine,
                1e-2 * 3e4 * solidAngle);
    EXPECT_EQ(OpenIrradiance({light}, {}, -n).g, 0);
  }
}

TEST(LightSource, WhatIsFarIsKnownUnmade) {
  for (int type = 0; IsLightType(type); ++type) {
    Light light = MakeLight(LightType(type), Spectrum(1.f));
    light.image = std::make_shared<EnvironmentImage>(1, 1, std::vector<Spectrum>{Spectrum(1.f)});
    const bool isFar = MakeLightSource(light)->IsFar();
    EXPECT_EQ(SelectLights({light}, true).size(), isFar ? 1u : 0u) << type;
    EXPECT_EQ(SelectLights({light}, false).size(), isFar ? 0u : 1u) << type;
  }
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
