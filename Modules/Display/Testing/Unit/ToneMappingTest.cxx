#include "Display/Core/ToneMapping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "Common/Core/Error.h"
#include "Common/Core/TriangleMesh.h"

namespace lambert {
namespace {

std::vector<LuminanceSample> Uniform(float luminance) { return {{luminance, 1}, {luminance, 3}}; }

TEST(ToneMapping, BringsAUniformSceneToTheKey) {
  // Luminance = log-average: keyed luminance is the key itself, the white point 1, so the curve
  // gives 0.18 (1 + 0.18) / 1.18 = 0.18.
  for (float luminance : {1e-6f, 1.f, 1e6f}) {
    const ToneMapping mapping(Uniform(luminance));
    EXPECT_NEAR(mapping.Apply(Spectrum(luminance)).g, SrgbFromLinear(0.18f), 1e-5);
  }
}

TEST(ToneMapping, ExposureCountsInStops) {
  const ToneMapping plain(Uniform(2)), brighter(Uniform(2), {0.18, 1, 0});
  EXPECT_NEAR(brighter.Scale() / plain.Scale(), 2, 1e-12);
}

TEST(ToneMapping, WhiteIsWhereTheCurveReachesOne) {
  const ToneMapping mapping(Uniform(1), {0.18, 0, 4});
  const float white = float(4 / mapping.Scale());
  EXPECT_NEAR(mapping.Apply(Spectrum(white)).r, 1, 1e-5);
  EXPECT_LT(mapping.Apply(Spectrum(white / 2)).r, 0.99f);
  EXPECT_EQ(mapping.ApplyToBytes(Spectrum(white * 100))[2], 255);
}

TEST(ToneMapping, IsMonotonousAndKeepsTheHueBelowWhite) {
  const ToneMapping mapping({{0.1f, 1}, {1, 1}, {10, 1}});
  float last = -1;
  for (float level = 0.01f; level < 10; level *= 1.5f) {
    const Spectrum display = mapping.Apply(Spectrum(level));
    EXPECT_GT(display.g, last);
    last = display.g;
  }
  const Spectrum display = mapping.Apply({0.2f, 0.1f, 0.05f});
  EXPECT_NEAR(LinearFromSrgb(display.r) / LinearFromSrgb(display.g), 2, 1e-3);
}

TEST(ToneMapping, BlackPointsDoNotDarkenTheRest) {
  std::vector<LuminanceSample> samples = Uniform(1);
  const double scale = ToneMapping(samples).Scale();
  samples.push_back({0, 1000});
  samples.push_back({-1, 1000});
  samples.push_back({std::numeric_limits<float>::quiet_NaN(), 1});
  samples.push_back({std::numeric_limits<float>::infinity(), 1});
  EXPECT_DOUBLE_EQ(ToneMapping(samples).Scale(), scale);
}

TEST(ToneMapping, ASceneWithoutLightIsBlack) {
  const ToneMapping mapping(std::vector<LuminanceSample>(5));
  EXPECT_TRUE(mapping.Apply(Spectrum(1)) == Spectrum());
  EXPECT_TRUE(ToneMapping({}).Apply(Spectrum(1)) == Spectrum());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(ToneMapping(Uniform(1)).Apply(Spectrum(nan)) == Spectrum());
}

TEST(ToneMapping, RefusesOptionsWithoutMeaning) {
  EXPECT_THROW(ToneMapping(Uniform(1), {0, 0, 0}), Error);
  EXPECT_THROW(ToneMapping(Uniform(1), {0.18, std::nan(""), 0}), Error);
  EXPECT_THROW(ToneMapping(Uniform(1), {0.18, 0, -1}), Error);
}

TEST(ToneMapping, LampsDoNotDecideTheExposure) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 5}, {1, 0, 5}, {0, 1, 5}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  mesh.Complete();
  mesh.emittance[1] = Spectrum(1000);
  const auto samples = LuminanceSamples(mesh, {Spectrum(1), Spectrum(1), Spectrum(1),
                                               Spectrum(1000), Spectrum(1000), Spectrum(1000)});
  EXPECT_NEAR(samples[0].weight, 0.5 / 3, 1e-6);
  EXPECT_EQ(samples[4].weight, 0);
  EXPECT_NEAR(ToneMapping(samples).Scale(), 0.18, 1e-6);
}

}  // namespace
}  // namespace lambert
