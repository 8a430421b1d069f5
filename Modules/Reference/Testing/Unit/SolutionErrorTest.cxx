// The error of solutions whose error is known.
#include "Reference/Core/SolutionError.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "Common/Core/Error.h"
#include "Common/Testing/SolutionFixtures.h"
#include "Common/Testing/TestScenes.h"

namespace lambert {
namespace {

using namespace testing;

TEST(SolutionError, NoneOfAnExactSolution) {
  const Scene scene = BlackFurnace();
  const SolutionError error =
      MeasureSolutionError(scene, FlatSolution(scene, 1, 3, false), {500, 256, 1});
  // Half of the points lie on the dark outside of the floor.
  EXPECT_NEAR(double(error.points), 250, 1);
  EXPECT_EQ(error.points + error.darkPoints, 500);
  EXPECT_EQ(error.missedPoints, 0);
  // Without the subtraction the rms would be the noise. What is left of its square is chance: over
  // 250 points a relative spread of sqrt((2 + 2/15) / 250) = 0.09, four times of which is 0.6^2.
  EXPECT_LT(error.rms, 0.6 * error.noise);
  EXPECT_LT(error.noise, 0.02);
  EXPECT_NEAR(error.bias, 0, 4 * error.noise / std::sqrt(double(error.points)));
}

TEST(SolutionError, TenPercentOfASolutionScaledByIt) {
  const Scene scene = BlackFurnace();
  const SolutionError error =
      MeasureSolutionError(scene, FlatSolution(scene, 1.1f, 3, false), {500, 256, 1});
  // The noise of the mean, four times.
  const double allowance = 4 * error.noise / std::sqrt(double(error.points)) + 1e-5;
  EXPECT_NEAR(error.rms, 0.1, allowance);
  EXPECT_NEAR(error.bias, 0.1, allowance);
  EXPECT_NEAR(error.bounded, 0.1, allowance + error.noise);
  EXPECT_NEAR(error.percentile95, 0.1, 3 * error.noise);
  EXPECT_LE(error.rmsLow, error.rms);
  EXPECT_GE(error.rmsHigh, error.rms);
}

TEST(SolutionError, AllOfASolutionThatModelsNothing) {
  const Scene scene = BlackFurnace();
  RadiositySolution nothing;
  const SolutionError error = MeasureSolutionError(scene, nothing, {200, 64, 1});
  EXPECT_NEAR(double(error.missedPoints), 100, 1);
  EXPECT_NEAR(error.rms, 1, 1e-6);
  EXPECT_NEAR(error.bias, -1, 1e-6);
}

// Where all faces emit they are what receives: half of the light of a furnace with exitance 1 and
// reflectance 1/2, irradiance 2, is half an error.
TEST(SolutionError, HalfOfAFurnaceIsMissing) {
  Scene scene;
  AddBox(&scene.mesh, {0, 0, 0}, {1, 1, 1}, BoxMaterials(0.5f, 1), true, 2);
  CompleteTables(&scene);
  const SolutionError error =
      MeasureSolutionError(scene, FlatSolution(scene, 1, 3, false), {500, 256, 1});
  EXPECT_NEAR(double(error.points), 250, 1);
  const double allowance = 4 * error.noise / std::sqrt(double(error.points)) + 1e-5;
  EXPECT_NEAR(error.rms, 0.5, allowance);
  EXPECT_NEAR(error.bias, -0.5, allowance);
}

TEST(SolutionError, InterpolatesWithinRefinedFaces) {
  // Irradiance 1 + x on a floor under a sky would be wrong by x everywhere: rms^2 is the mean of
  // x^2 = 1/3, the bias the mean of x = 1/2. 4000 stratified points sample that to 1 %.
  Scene scene;
  AddQuad(&scene.mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.f));
  Light sky;
  sky.type = LightType::Sky;
  sky.intensity = Spectrum(float(1 / kPi));
  scene.lights = {sky};
  CompleteTables(&scene);
  RadiositySolution solution = FlatSolution(scene, 1, 5);
  for (size_t i = 0; i < solution.irradiance.size(); ++i) {
    if (solution.mesh.normals[i].z > 0) {
      solution.irradiance[i] = Spectrum(1 + solution.mesh.positions[i].x);
    }
  }
  const SolutionError error = MeasureSolutionError(scene, solution, {4000, 32, 1});
  EXPECT_EQ(error.points, 4000) << "both sides lie open under the sky";
  EXPECT_NEAR(error.rms, std::sqrt(1 / 6.0), 0.01) << "the back is exact, the front is not";
  EXPECT_NEAR(error.bias, 0.25, 0.01);
}

TEST(SolutionError, TellsWhereItSits) {
  // One patch of 25 is 100 % too bright: its points come first and hold nearly all of the error.
  const Scene scene = BlackFurnace();
  RadiositySolution solution = FlatSolution(scene, 1, 6, false);
  const auto isBright = [](const Vec3f& p) { return p.z == 0 && std::max(p.x, p.y) < 0.3f; };
  for (size_t i = 0; i < solution.irradiance.size(); ++i) {
    if (isBright(solution.mesh.positions[i])) solution.irradiance[i] = Spectrum(2.f);
  }
  std::vector<ComparedPoint> points;
  const SolutionError error = MeasureSolutionError(scene, solution, {2000, 256, 1}, {}, &points);
  ASSERT_EQ(int64_t(points.size()), error.points);
  double sum = 0, ofBright = 0, square = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    const ComparedPoint& point = points[i];
    EXPECT_LE(point.part, points[i > 0 ? i - 1 : 0].part);
    EXPECT_EQ(point.side, kFront);
    EXPECT_GT(Dot(point.receiver.normal, scene.mesh.FrontNormal(point.face)), 0.99f);
    sum += point.part;
    ofBright += point.delivered.Mean() > 1.05f ? point.part : 0;
    square += SquaredNorm(point.delivered - point.reference.irradiance) / 3;
  }
  EXPECT_NEAR(sum, 1, 1e-6);
  EXPECT_GT(ofBright, 0.95);
  EXPECT_NEAR(std::sqrt(square / double(points.size())), error.bounded, 0.1 * error.bounded)
      << "a furnace of irradiance 1";
}

TEST(SolutionError, TakesMorePathsWhereNoiseHidesIt) {
  // Two paths a point scatter by some tenth, far more than the 1 % by which the solution is off.
  const Scene scene = BlackFurnace();
  const RadiositySolution solution = FlatSolution(scene, 1.01f, 3, false);
  SolutionErrorOptions options{500, 16, 1};
  const SolutionError few = MeasureSolutionError(scene, solution, options);
  ASSERT_GT(few.noise, few.Counting());
  options.growth = 16;
  const SolutionError more = MeasureSolutionError(scene, solution, options);
  EXPECT_EQ(more.points + more.darkPoints, 500) << "more paths, not more points";
  EXPECT_LT(more.noise, few.noise / 2);
}

TEST(SolutionError, TakesMorePointsWhereFewDecide) {
  // One patch of 25 is 100 % too bright: rms 0.2, of which some 20 of 500 points tell.
  const Scene scene = BlackFurnace();
  const RadiositySolution solution = WithBrightPatch(scene);
  SolutionErrorOptions options{500, 256, 1};
  const SolutionError few = MeasureSolutionError(scene, solution, options);
  ASSERT_FALSE(few.IsRmsSure());
  options.growth = 4;
  const SolutionError more = MeasureSolutionError(scene, solution, options);
  EXPECT_EQ(more.points + more.darkPoints, 2000);
  EXPECT_LT(more.rmsHigh - more.rmsLow, few.rmsHigh - few.rmsLow);
  // Once it is known to be enough there is nothing to decide.
  options.enough = 1;
  EXPECT_EQ(MeasureSolutionError(scene, solution, options).rms, few.rms);
}

TEST(SolutionError, NoLightNoError) {
  Scene scene;
  AddQuad(&scene.mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.5f));
  CompleteTables(&scene);
  const SolutionError error = MeasureSolutionError(scene, FlatSolution(scene, 0, 2), {50, 16, 1});
  EXPECT_EQ(error.rms, 0);
  EXPECT_EQ(error.bounded, 0);
  EXPECT_EQ(error.bias, 0);
}

// Four points of light 1, 1, 1, 5, the last twice as bright as it should be; worked out by hand.
TEST(SolutionError, SummarizesWhatWasDelivered) {
  const std::vector<IrradianceEstimate> exact{{Spectrum(1.f), Spectrum(0.f)},
                                              {Spectrum(1.f), Spectrum(0.f)},
                                              {Spectrum(1.f), Spectrum(0.f)},
                                              {Spectrum(5.f), Spectrum(0.f)}};
  const std::vector<Spectrum> delivered{Spectrum(1.f), Spectrum(0.f), Spectrum(1.f),
                                        Spectrum(10.f)};
  const SolutionError error = SummarizeError(delivered, exact);
  EXPECT_EQ(error.points, 4);
  EXPECT_EQ(error.darkPoints + error.missedPoints, 0);
  EXPECT_NEAR(error.rms, std::sqrt(26.0 / 28), 1e-6);
  EXPECT_NEAR(error.bias, (12.0 - 8) / 8, 1e-6);
  // The mean is 2: errors count 0, 1/2, 0 and 1.
  EXPECT_NEAR(error.bounded, std::sqrt(1.25 / 4), 1e-6);
  EXPECT_NEAR(error.percentile95, 1, 1e-6);
  EXPECT_EQ(error.noise, 0);
  EXPECT_LE(error.rmsLow, error.rms);
  EXPECT_GE(error.rmsHigh, error.rms);
  // A standard error of 1 a band at the last point takes 3 off 3 x 26 and off 3 x 28.
  std::vector<IrradianceEstimate> noisy = exact;
  noisy.back().standardError = Spectrum(1.f);
  EXPECT_NEAR(SummarizeError(delivered, noisy).rms, std::sqrt(25.0 / 27), 1e-6);
  EXPECT_NEAR(SummarizeError(delivered, noisy).noise, std::sqrt(1.0 / 27), 1e-6);
  EXPECT_EQ(SummarizeError({}, {}).points, 0);
  EXPECT_EQ(SummarizeError({}, {}).rms, 0);
}

TEST(SolutionError, RefusesAnotherScenesSolution) {
  const Scene scene = BlackFurnace();
  Scene small;
  AddQuad(&small.mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.f));
  EXPECT_THROW(MeasureSolutionError(small, FlatSolution(scene, 1, 1)), Error);
  // As many faces, in another order: as clustering leaves a mesh.
  Scene turned = scene;
  std::reverse(turned.mesh.triangles.begin(), turned.mesh.triangles.end());
  EXPECT_THROW(MeasureSolutionError(turned, FlatSolution(scene, 1, 1), {200, 64, 1}), Error);
  EXPECT_THROW(MeasureSolutionError(scene, FlatSolution(scene, 1, 1), {0, 64, 1}), Error);
  EXPECT_THROW(MeasureSolutionError(scene, FlatSolution(scene, 1, 1), {10, 1, 1}), Error);
}

}  // namespace
}  // namespace lambert
