// The bake as a method: its light against closed forms, its mesh against the contract.
#include "Reference/Core/PathTracedBake.h"

#include <gtest/gtest.h>

#include <set>

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Common/Testing/DoubledSheet.h"
#include "Common/Testing/TestScenes.h"
#include "Reference/Core/SolutionError.h"

namespace lambert {
namespace {

using namespace testing;

RadiositySolution Bake(const Scene& scene, int samples, SolverStatistics* statistics = nullptr) {
  PathTracedBakeOptions options;
  options.samples = samples;
  return BakePathTraced(scene, options, statistics);
}

/// Mean irradiance (first band) over the output points at `position` that face `normal`.
double LightAt(const RadiositySolution& solution, const Vec3f& position, const Vec3f& normal) {
  double sum = 0;
  int count = 0;
  for (size_t i = 0; i < solution.irradiance.size(); ++i) {
    if (Length(solution.mesh.positions[i] - position) > 1e-6f) continue;
    if (Dot(solution.mesh.normals[i], normal) < 0.9f) continue;
    sum += double(solution.irradiance[i].r);
    ++count;
  }
  EXPECT_GT(count, 0);
  return sum / count;
}

TEST(PathTracedBake, FurnaceIsBrightAllOver) {
  // Every path from every vertex meets exitance 1 and reflectance rho: E = 1 / (1 - rho).
  for (const float rho : {0.5f, 0.8f}) {
    const RadiositySolution solution = Bake(FurnaceCube(rho, 1, 2), 1024);
    for (size_t i = 0; i < solution.irradiance.size(); ++i) {
      // The number of bounces scatters by about 2 / (1 - rho): 5 standard errors of 1024 paths.
      EXPECT_NEAR(solution.irradiance[i].r, 1 / (1 - rho), 5 * 2 / (1 - rho) / 32);
      EXPECT_FLOAT_EQ(solution.radiosity[i].r, rho * solution.irradiance[i].r + 1);
    }
  }
}

TEST(PathTracedBake, CubeWithBlackCeiling) {
  // Irradiance at the middle of the floor and of a wall, to 4 digits. A path brings 0 to 1 W/m2, so
  // that its standard deviation is under 1/2: 4 standard errors of 16384 paths, half of it in
  // truth.
  const RadiositySolution solution = Bake(BoxRoom(1, 0.5f, 1, 2), 16384);
  EXPECT_NEAR(LightAt(solution, {0.5f, 0.5f, 0}, {0, 0, 1}), 0.35828, 4 * 0.5 / 128);
  EXPECT_NEAR(LightAt(solution, {0, 0.5f, 0.5f}, {1, 0, 0}), 0.32242, 4 * 0.5 / 128);
}

TEST(PathTracedBake, DeliversLitSidesOnly) {
  // Seen from outside the room is dark, and not modelled.
  const Scene scene = BoxRoom(1, 0.5f, 1, 2);
  SolverStatistics statistics;
  const RadiositySolution solution = Bake(scene, 64, &statistics);
  EXPECT_EQ(solution.mesh.FaceCount(), scene.mesh.FaceCount());
  EXPECT_EQ(solution.mesh.PointCount(), scene.mesh.PointCount());
  for (const uint8_t side : solution.side) EXPECT_EQ(side, kFront);
  EXPECT_EQ(statistics.patchElements, scene.mesh.PointCount());
  EXPECT_GT(statistics.rays, 64 * scene.mesh.PointCount());
  EXPECT_EQ(statistics.history.size(), 1u);
  EXPECT_EQ(statistics.stoppedBy, "error");
}

TEST(PathTracedBake, LitBackIsAReversedCopy) {
  // A sheet under a sky: both sides receive pi L and shine.
  Scene scene;
  AddQuad(&scene.mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.5f));
  Light sky;
  sky.type = LightType::Sky;
  sky.intensity = Spectrum(1.f);
  scene.lights.push_back(sky);
  CompleteTables(&scene);
  const RadiositySolution solution = Bake(scene, 16);
  ASSERT_EQ(solution.mesh.FaceCount(), 4);
  ASSERT_EQ(solution.mesh.PointCount(), 8);
  for (int64_t face = 0; face < 4; ++face) {
    const size_t f = size_t(face);
    const float up = solution.side[f] == kFront ? 1.f : -1.f;
    EXPECT_EQ(solution.mesh.FrontNormal(face), Vec3f(0, 0, up));
    EXPECT_EQ((solution.mesh.faceFlags[f] & kRewound) != 0, solution.side[f] == kBack);
    for (const int32_t point : solution.mesh.triangles[f]) {
      EXPECT_EQ(solution.mesh.normals[size_t(point)], Vec3f(0, 0, up));
      EXPECT_FLOAT_EQ(solution.irradiance[size_t(point)].r, float(kPi));
      EXPECT_FLOAT_EQ(solution.radiosity[size_t(point)].r, float(kPi) / 2);
    }
  }
  for (const Spectrum& e : solution.inputIrradiance) EXPECT_FLOAT_EQ(e.r, float(kPi));
}

TEST(PathTracedBake, ADoubledSheetHasTwoSides) {
  const RadiositySolution solution = Bake(DoubledSheetUnderSuns(), 16);
  ASSERT_EQ(solution.mesh.FaceCount(), 4);
  for (int64_t face = 0; face < 4; ++face) {
    const bool isUp = solution.mesh.FrontNormal(face).z > 0;
    for (const int32_t p : solution.mesh.triangles[size_t(face)]) {
      EXPECT_FLOAT_EQ(solution.irradiance[size_t(p)].r, isUp ? 1.f : 4.f);
      EXPECT_FLOAT_EQ(solution.radiosity[size_t(p)].r, isUp ? 0.8f : 2.f);
    }
  }
}

TEST(PathTracedBake, DarkFacesAreDeliveredBlack) {
  // A closed black box beside a lamp has dark insides; a scene without light is dark all over.
  Scene scene = BoxRoom(1, 0.5f, 0, 1);
  const RadiositySolution solution = Bake(scene, 16);
  ASSERT_EQ(solution.mesh.FaceCount(), scene.mesh.FaceCount());
  for (const Spectrum& e : solution.irradiance) EXPECT_TRUE(e.IsBlack());
}

TEST(PathTracedBake, LightThroughAChinkSpreadsOverTheWholeFace) {
  // A wall of large faces lit by a spot at one corner alone: its other corners are on lit faces
  // and take all their paths.
  Scene scene;
  AddQuad(&scene.mesh, {0, 0, 0}, {10, 0, 0}, {0, 10, 0}, Spectrum(0.5f), Spectrum(0.f), 1);
  Light spot;
  spot.type = LightType::Spot;
  spot.position = {0, 0, 1};
  spot.intensity = Spectrum(1.f);
  spot.innerConeAngle = 0.05f;
  spot.outerConeAngle = 0.1f;
  scene.lights.push_back(spot);
  CompleteTables(&scene);
  SolverStatistics statistics;
  const RadiositySolution solution = Bake(scene, 64, &statistics);
  EXPECT_EQ(statistics.patchElements, 4);  // Both triangles meet in that corner.
  EXPECT_GT(LightAt(solution, {0, 0, 0}, {0, 0, 1}), 0.9);
}

TEST(PathTracedBake, EmittersAreModelledInTheDark) {
  // The back of a one-sided lamp in the void is dark; its front gives and receives nothing.
  Scene scene;
  AddQuad(&scene.mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.5f), Spectrum(2.f));
  CompleteTables(&scene);
  const RadiositySolution solution = Bake(scene, 16);
  ASSERT_EQ(solution.mesh.FaceCount(), 2);
  for (const Spectrum& b : solution.radiosity) EXPECT_EQ(b, Spectrum(2.f));
  for (const Spectrum& e : solution.irradiance) EXPECT_TRUE(e.IsBlack());
}

TEST(PathTracedBake, PointsAreNotSharedAcrossMaterials) {
  Scene scene;
  AddQuad(&scene.mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.5f));
  scene.mesh.materialId[1] = 1;
  scene.mesh.reflectance[1] = Spectrum(0.2f);
  Light sky;
  sky.type = LightType::Sky;
  sky.intensity = Spectrum(1.f);
  scene.lights.push_back(sky);
  CompleteTables(&scene);
  const RadiositySolution solution = Bake(scene, 16);
  ASSERT_EQ(solution.mesh.PointCount(), 12);
  for (size_t face = 0; face < solution.mesh.triangles.size(); ++face) {
    for (const int32_t point : solution.mesh.triangles[face]) {
      EXPECT_FLOAT_EQ(solution.radiosity[size_t(point)].r,
                      solution.mesh.reflectance[face].r * float(kPi));
    }
  }
}

TEST(PathTracedBake, SameBitsForAnyThreads) {
  const Scene scene = BoxRoom(1, 0.5f, 1, 3);
  SetThreadCount(1);
  const RadiositySolution one = Bake(scene, 100);
  SetThreadCount(3);
  const RadiositySolution three = Bake(scene, 100);
  SetThreadCount(0);
  EXPECT_EQ(one.irradiance, three.irradiance);
  EXPECT_EQ(one.mesh.triangles, three.mesh.triangles);
}

TEST(PathTracedBake, AgreesWithTheMeasuredError) {
  // Of 512 paths 1 to 2 % are noise; interpolation over faces of an eighth costs 3 % beside the
  // ceiling's edges.
  const Scene scene = BoxRoom(1, 0.5f, 1, 8);
  const RadiositySolution solution = Bake(scene, 512);
  SolutionErrorOptions options;
  options.points = 300;
  options.samples = 512;
  const SolutionError error = MeasureSolutionError(scene, solution, options);
  EXPECT_LT(error.rms, 0.06);
  EXPECT_EQ(error.missedPoints, 0);
}

TEST(PathTracedBake, RefusesWhatMakesNoSense) {
  Scene scene = BoxRoom(1, 0.5f, 1);
  EXPECT_THROW(Bake(scene, 0), Error);
  EXPECT_THROW(BakePathTraced(scene, {}, nullptr, [](double, const char*) { return false; }),
               Cancelled);
  scene.mesh.normals.clear();
  EXPECT_THROW(Bake(scene, 16), Error);
}

TEST(PathTracedBake, TakesAnEmptyMesh) {
  const RadiositySolution solution = Bake(Scene(), 16);
  EXPECT_EQ(solution.mesh.FaceCount(), 0);
}

}  // namespace
}  // namespace lambert
