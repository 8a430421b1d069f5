#include "Display/Core/IlluminanceScale.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Common/Core/Error.h"

namespace lambert {
namespace {

TEST(IlluminanceScale, WhiteLightOfAWattIsSixHundredAndEightyThreeLux) {
  EXPECT_NEAR(Illuminance(Spectrum(1), IlluminanceUnit::Lux), 683, 1e-3);
  EXPECT_NEAR(Illuminance(Spectrum(1), IlluminanceUnit::WattsPerSquareMetre), 1, 1e-6);
  EXPECT_NEAR(Illuminance({0, 1, 0}, IlluminanceUnit::Lux), 683 * 0.7152, 1e-3);
}

TEST(IlluminanceScale, StepsAreRound) {
  const auto stepOf = [](double low, double high) {
    const IlluminanceScale scale = MakeIlluminanceScale(low, high);
    EXPECT_EQ(scale.levels.front(), low);
    EXPECT_EQ(scale.levels.back(), high);
    return scale.levels[1] - scale.levels[0];
  };
  EXPECT_NEAR(stepOf(0, 1), 0.2, 1e-12);
  EXPECT_NEAR(stepOf(0, 2000), 400, 1e-9);
  EXPECT_NEAR(stepOf(0, 5e-3), 1e-3, 1e-12);
  EXPECT_NEAR(stepOf(100, 400), 60, 1e-9);
  EXPECT_NEAR(stepOf(0, 600), 150, 1e-9);  // A fifth would be 120.
  EXPECT_EQ(MakeIlluminanceScale(0, 1, 3).levels.size(), 4u);
}

TEST(IlluminanceScale, EndsAboveAllButATwentiethOfTheLitArea) {
  // 999 parts of 3 W/m2, and one of 1000 that does not stretch the scale; a lamp that does not
  // count.
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {999, 0, 0}, {0, 1, 0}, {0, 0, 5}, {1, 0, 5},
                    {0, 1, 5}, {0, 0, 9},   {9, 0, 9}, {0, 9, 9}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  mesh.Complete();
  mesh.emittance[2] = Spectrum(1);
  std::vector<Spectrum> irradiance(9, Spectrum(3));
  for (size_t point = 3; point < 6; ++point) irradiance[point] = Spectrum(1000);
  for (size_t point = 6; point < 9; ++point) irradiance[point] = Spectrum(1e6f);
  const auto scale = ScaleOf(mesh, irradiance, IlluminanceUnit::WattsPerSquareMetre);
  EXPECT_EQ(scale.low, 0);
  EXPECT_NEAR(scale.high, 3, 1e-9);
  EXPECT_NEAR(ScaleOf(mesh, irradiance, IlluminanceUnit::Lux).high, 3000, 1e-6);
  EXPECT_EQ(ScaleOf(mesh, std::vector<Spectrum>(9), IlluminanceUnit::Lux).high, 1);
}

TEST(IlluminanceScale, RefusesARangeOfNothing) {
  EXPECT_THROW(MakeIlluminanceScale(1, 1), Error);
  EXPECT_THROW(MakeIlluminanceScale(2, 1), Error);
  EXPECT_THROW(MakeIlluminanceScale(0, std::nan("")), Error);
  EXPECT_THROW(MakeIlluminanceScale(0, INFINITY), Error);
}

}  // namespace
}  // namespace lambert
