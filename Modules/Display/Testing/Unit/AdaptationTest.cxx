#include "Display/Core/Adaptation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "Common/Core/Error.h"
#include "Common/Core/TriangleMesh.h"

namespace lambert {
namespace {

double Stops(double from, double to) { return std::log2(to / from); }

TEST(Adaptation, IsTheLogAverageByArea) {
  // exp((ln 1 + 3 ln 16) / 4) = 8.
  const Adaptation adaptation = MeasureAdaptation({{1, 1}, {16, 3}});
  EXPECT_NEAR(adaptation.average, 8, 1e-9);
  EXPECT_EQ(adaptation.bright, 16);
}

TEST(Adaptation, BlackPointsDoNotDarkenTheRest) {
  std::vector<LuminanceSample> samples{{1, 1}, {1, 3}};
  samples.push_back({0, 1000});
  samples.push_back({-1, 1000});
  samples.push_back({1e-6f, 1});
  samples.push_back({std::numeric_limits<float>::quiet_NaN(), 1});
  samples.push_back({std::numeric_limits<float>::infinity(), 1});
  EXPECT_DOUBLE_EQ(MeasureAdaptation(samples).average, 1);
}

TEST(Adaptation, LampsDoNotCount) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 5}, {1, 0, 5}, {0, 1, 5}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  mesh.Complete();
  mesh.emittance[1] = Spectrum(1000);
  const auto samples = LuminanceSamples(mesh, {Spectrum(1), Spectrum(1), Spectrum(1),
                                               Spectrum(1000), Spectrum(1000), Spectrum(1000)});
  EXPECT_NEAR(samples[0].weight, 0.5 / 3, 1e-6);
  EXPECT_EQ(samples[4].weight, 0);
  EXPECT_NEAR(MeasureAdaptation(samples).average, 1, 1e-6);
}

TEST(SteadyAdaptation, DoesNotPumpWhileASolutionConverges) {
  // Light grows with every bounce, and noise that dies away swings it by a stop at first.
  SteadyAdaptation steady(0.25);
  double last = 0, swings = 0, measuredSwings = 0, lastMeasured = 0, shown = 0;
  for (int k = 0; k < 40; ++k) {
    const double noise = std::pow(-0.8, k);
    const double measured = (1 - 0.5 * std::pow(0.6, k)) * std::exp2(0.5 * noise);
    shown = steady.Follow({measured, 4 * measured}).average;
    if (k > 0) {
      EXPECT_LE(std::abs(Stops(last, shown)), 0.25 + 1e-9) << k;
      swings += std::abs(Stops(last, shown));
      measuredSwings += std::abs(Stops(lastMeasured, measured));
    }
    last = shown;
    lastMeasured = measured;
  }
  // A filter that goes half of the way passes a third of what alternates from update to update; the
  // growth of one stop passes whole.
  EXPECT_LT(swings, measuredSwings / 2);
  EXPECT_NEAR(Stops(1, shown), 0, 0.01);
}

TEST(SteadyAdaptation, FollowsALampThatIsSwitchedOn) {
  SteadyAdaptation steady(0.25);
  EXPECT_EQ(steady.Follow({}).average, 0);
  EXPECT_EQ(steady.Follow({1, 2}).average, 1);
  EXPECT_NEAR(steady.Follow({16, 32}).average, std::exp2(0.25), 1e-9);
  EXPECT_EQ(steady.Follow({}).average, steady.Follow({}).average);
  for (int k = 0; k < 40; ++k) steady.Follow({16, 32});
  EXPECT_NEAR(steady.Follow({16, 32}).average, 16, 1e-3);
  EXPECT_NEAR(steady.Follow({16, 32}).bright, 32, 1e-3);
}

TEST(SteadyAdaptation, RefusesToStandStill) {
  EXPECT_THROW(SteadyAdaptation(0), Error);
  EXPECT_THROW(SteadyAdaptation(std::nan("")), Error);
}

}  // namespace
}  // namespace lambert
