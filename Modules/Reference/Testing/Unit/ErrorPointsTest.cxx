// Points that are traced once and compared with one solution after the other.
#include "Reference/Core/ErrorPoints.h"

#include <gtest/gtest.h>

#include "Common/Testing/SolutionFixtures.h"

namespace lambert {
namespace {

using namespace testing;

TEST(ErrorPoints, AreTheSameForEverySolution) {
  const Scene scene = BlackFurnace();
  const RadiositySolution first = FlatSolution(scene, 1.1f, 3, false),
                          second = FlatSolution(scene, 1.02f, 3, false);
  const SolutionErrorOptions options{500, 256, 1};
  ErrorPoints points(scene, options);
  points.Measure(first);
  const std::vector<IrradianceEstimate> truth = points.Truth();
  const SolutionError error = points.Measure(second);

  ASSERT_EQ(points.Truth().size(), truth.size());
  for (size_t i = 0; i < truth.size(); ++i) {
    EXPECT_EQ(points.Truth()[i].irradiance, truth[i].irradiance);
  }
  const SolutionError fresh = MeasureSolutionError(scene, second, options);
  EXPECT_EQ(error.rms, fresh.rms);
  EXPECT_EQ(error.bounded, fresh.bounded);
  EXPECT_EQ(error.darkPoints, fresh.darkPoints);
}

// One patch of 25 is 100 % too bright.
TEST(ErrorPoints, GrowUntilTheJudgeIsContent) {
  const Scene scene = BlackFurnace();
  const RadiositySolution solution = WithBrightPatch(scene);
  SolutionErrorOptions options{500, 256, 1};
  ErrorPoints points(scene, options);
  const auto drawn = [](const SolutionError& e) { return e.points + e.darkPoints; };
  EXPECT_EQ(drawn(points.Measure(solution)), 500);
  const auto isContent = [&](const SolutionError& e) { return drawn(e) >= 1000; };
  EXPECT_EQ(drawn(points.Measure(solution, 4, isContent)), 1000);
  const SolutionError unsure = points.Measure(solution, 4);
  EXPECT_EQ(drawn(unsure), 2000);
  options.growth = 4;
  EXPECT_EQ(unsure.rms, MeasureSolutionError(scene, solution, options).rms);
}

}  // namespace
}  // namespace lambert
