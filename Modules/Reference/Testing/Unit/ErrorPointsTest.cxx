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
  points.Look(first);
  const std::vector<IrradianceEstimate> truth = points.Truth();
  const SolutionError error = points.Look(second);

  ASSERT_EQ(points.Truth().size(), truth.size());
  for (size_t i = 0; i < truth.size(); ++i) {
    EXPECT_EQ(points.Truth()[i].irradiance, truth[i].irradiance);
  }
  const SolutionError fresh = MeasureSolutionError(scene, second, options);
  EXPECT_EQ(error.rms, fresh.rms);
  EXPECT_EQ(error.bounded, fresh.bounded);
  EXPECT_EQ(error.darkPoints, fresh.darkPoints);
}

TEST(ErrorPoints, GrowWhereAMeasureIsUnsureAndALookIs) {
  // One patch of 25 is 100 % too bright.
  const Scene scene = BlackFurnace();
  const RadiositySolution solution = WithBrightPatch(scene);
  SolutionErrorOptions options{500, 256, 1};
  options.growth = 4;
  ErrorPoints points(scene, options);
  const SolutionError look = points.Look(solution), measure = points.Measure(solution, 4);
  EXPECT_EQ(look.points + look.darkPoints, 500);
  EXPECT_EQ(measure.points + measure.darkPoints, 2000);
  EXPECT_EQ(measure.rms, MeasureSolutionError(scene, solution, options).rms);
}

}  // namespace
}  // namespace lambert
