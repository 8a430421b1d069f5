#include "Display/Core/ToneMapping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "Common/Core/Error.h"

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

TEST(ToneMapping, ASceneWithoutLightIsBlack) {
  const ToneMapping mapping(std::vector<LuminanceSample>(5));
  EXPECT_TRUE(mapping.Apply(Spectrum(1)) == Spectrum());
  EXPECT_TRUE(ToneMapping(Adaptation()).Apply(Spectrum(1)) == Spectrum());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(ToneMapping(Uniform(1)).Apply(Spectrum(nan)) == Spectrum());
}

TEST(ToneMapping, RefusesOptionsWithoutMeaning) {
  EXPECT_THROW(ToneMapping(Uniform(1), {0, 0, 0}), Error);
  EXPECT_THROW(ToneMapping(Uniform(1), {0.18, std::nan(""), 0}), Error);
  EXPECT_THROW(ToneMapping(Uniform(1), {0.18, 0, -1}), Error);
}

TEST(ToneMapping, ACameraDoesNotAdapt) {
  // A white wall under 1000 lux, 1000 / pi = 318 cd/m2, is exposed as middle grey at
  // log2(318 / 0.125) = 11.3 EV.
  ToneMappingOptions options;
  options.exposureValue = std::log2(1000 / kPi / 0.125);
  options.curve = ToneCurve::Linear;
  const Spectrum wall(float(1000 / kLumensPerWatt));
  for (float level : {0.01f, 100.f}) {
    const ToneMapping mapping(Uniform(level), options);
    EXPECT_NEAR(mapping.Apply(wall).g, SrgbFromLinear(0.18f), 1e-5);
  }
  *options.exposureValue += 1;
  EXPECT_NEAR(ToneMapping(Uniform(1), options).Apply(wall).g, SrgbFromLinear(0.09f), 1e-5);
  options.exposureValue = std::nan("");
  EXPECT_THROW(ToneMapping(Uniform(1), options), Error);
}

TEST(ToneMapping, LinearClipsByBandAndFilmLosesColour) {
  const ToneMapping linear(Uniform(1), {0.18, 0, 0, ToneCurve::Linear});
  EXPECT_NEAR(linear.Apply(Spectrum(1)).r, SrgbFromLinear(0.18f), 1e-6);
  EXPECT_NEAR(linear.Apply({100, 1, 1}).r, 1, 1e-6);
  EXPECT_NEAR(linear.Apply({100, 1, 1}).g, SrgbFromLinear(0.18f), 1e-6);

  const ToneMapping filmic(Uniform(1), {0.18, 0, 0, ToneCurve::Filmic});
  EXPECT_DOUBLE_EQ(filmic.White(), kFilmicWhite);
  const Spectrum dim = filmic.Apply({0.2f, 0.1f, 0.1f}), bright = filmic.Apply({20, 10, 10});
  EXPECT_GT(LinearFromSrgb(dim.r) / LinearFromSrgb(dim.g), 1.8);
  EXPECT_LT(LinearFromSrgb(bright.r) / LinearFromSrgb(bright.g), 1.5);
}

TEST(ToneMapping, ASurroundOfItsOwnLuminanceChangesNothing) {
  const ToneMapping mapping(Uniform(1));
  const Spectrum light(2, 1, 0.5f);
  EXPECT_NEAR(mapping.Apply(light, Luminance(light)).r, mapping.Apply(light).r, 1e-6);
  EXPECT_GT(mapping.Apply(light, 0.1).r, mapping.Apply(light).r);
  EXPECT_TRUE(mapping.Apply(Spectrum(-1), 1) == Spectrum());
}

}  // namespace
}  // namespace lambert
