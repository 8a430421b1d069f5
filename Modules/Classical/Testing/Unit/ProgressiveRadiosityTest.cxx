#include "Classical/Core/ProgressiveRadiosity.h"

#include <gtest/gtest.h>

#include "Common/Core/Error.h"
#include "Common/Testing/TestScenes.h"

namespace lambert {
namespace {

double TotalIrradiance(const RadiositySolution& solution) {
  double sum = 0;
  for (size_t face = 0; face < solution.mesh.triangles.size(); ++face) {
    for (const int32_t point : solution.mesh.triangles[face]) {
      sum += double(solution.irradiance[size_t(point)].g) *
             double(solution.mesh.Area(int64_t(face))) / 3;
    }
  }
  return sum;
}

// Light only ever grows from one iteration to the next, the ambient term shrinks to nothing, and
// with it an early solution has about the light of the last.
TEST(ProgressiveRadiosity, ObserversSeeLightGrow) {
  const Scene scene = testing::BoxRoom(1, 0.8f, 1);
  ProgressiveRadiosityOptions options;
  options.elementSize = 0.3;
  options.unshot = 1e-3;
  ProgressiveRadiosity solver(scene, options);
  std::vector<double> light, lightWithAmbient, ambient, unshot;
  solver.Run({}, [&](const IterationRecord& record) {
    light.push_back(TotalIrradiance(solver.Solution()));
    lightWithAmbient.push_back(TotalIrradiance(solver.SolutionWithAmbient()));
    ambient.push_back(double(solver.AmbientIrradiance().g));
    unshot.push_back(record.change);
    return true;
  });
  ASSERT_GE(light.size(), 5u);
  for (size_t i = 1; i < light.size(); ++i) {
    EXPECT_GT(light[i], light[i - 1]);
    EXPECT_LT(ambient[i], ambient[i - 1]);
    if (i + 1 < light.size()) {
      EXPECT_LE(unshot[i], 0.5 * unshot[i - 1]);
    }
  }
  EXPECT_LE(unshot.back(), 1e-3);
  // Of what is unshot the ambient term knows how much there is, not where; walls and floor here
  // differ by 1.5, and half of all light is left to it.
  EXPECT_NEAR(lightWithAmbient.front(), light.back(), 0.2 * light.back());
  EXPECT_EQ(solver.Statistics().stoppedBy, "error");
}

TEST(ProgressiveRadiosity, StopsWhereItIsTold) {
  const Scene scene = testing::BoxRoom(1, 0.5f, 1);
  ProgressiveRadiosityOptions options;
  options.elementSize = 0.5;
  options.shots = 3;
  ProgressiveRadiosity few(scene, options);
  few.Run();
  EXPECT_EQ(few.Statistics().stoppedBy, "iterations");
  EXPECT_EQ(few.Statistics().history.back().links, 3);

  options.shots = 0;
  ProgressiveRadiosity observed(scene, options);
  observed.Run({}, [](const IterationRecord&) { return false; });
  EXPECT_EQ(observed.Statistics().stoppedBy, "interrupt");
  EXPECT_EQ(observed.Statistics().history.size(), 1u);
  EXPECT_THROW(
      SolveProgressiveRadiosity(scene, options, nullptr, [](double, const char*) { return false; }),
      Cancelled);
}

TEST(ProgressiveRadiosity, RefusesWhatCannotBe) {
  const Scene scene = testing::BoxRoom(1, 0.5f, 1);
  const auto refused = [&](auto change) {
    ProgressiveRadiosityOptions options;
    options.elementSize = 0.5;
    change(&options);
    EXPECT_THROW(SolveProgressiveRadiosity(scene, options), Error);
  };
  refused([](ProgressiveRadiosityOptions* o) { o->unshot = 0; });
  refused([](ProgressiveRadiosityOptions* o) { o->unshot = 1; });
  refused([](ProgressiveRadiosityOptions* o) { o->patchSize = -1; });
  refused([](ProgressiveRadiosityOptions* o) { o->elementSize = -1; });
  refused([](ProgressiveRadiosityOptions* o) { o->skyRays = 0; });
  refused([](ProgressiveRadiosityOptions* o) { o->shots = -1; });
}

// Patches as fine as elements, or 4 times as coarse, bring the same light where nothing is in the
// way: the closed form does not care, only the spread of light within a patch does.
TEST(ProgressiveRadiosity, CoarsePatchesShootTheSameLight) {
  const Scene scene = testing::BoxRoom(1, 0.5f, 1);
  ProgressiveRadiosityOptions options;
  options.elementSize = 0.2;
  options.unshot = 1e-3;
  SolverStatistics fine, coarse;
  options.patchSize = 0.2;
  const double byFine = TotalIrradiance(SolveProgressiveRadiosity(scene, options, &fine));
  options.patchSize = 0.8;
  const double byCoarse = TotalIrradiance(SolveProgressiveRadiosity(scene, options, &coarse));
  // What may stay unshot doubles by the bounces to come; as much for the spread within quarters of
  // patches.
  EXPECT_NEAR(byFine, byCoarse, 4e-3 * byFine);
  EXPECT_LT(coarse.history.back().links, fine.history.back().links / 2);
}

}  // namespace
}  // namespace lambert
