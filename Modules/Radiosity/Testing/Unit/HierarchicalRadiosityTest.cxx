#include "Radiosity/Core/HierarchicalRadiosity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Common/Testing/TestScenes.h"
#include "Radiosity/Testing/Unit/SolverScenes.h"
#include "Reference/Core/SolutionError.h"

namespace lambert {
namespace {

using testing::AddBox;
using testing::AddQuad;
using testing::BoxMaterials;

struct Solved {
  Scene scene;
  RadiositySolution solution;
  SolverStatistics statistics;
};

Solved Solve(Scene scene, const HierarchicalRadiosityOptions& options) {
  Solved solved;
  solved.scene = std::move(scene);
  solved.scene.mesh.Complete();
  const ClusterTree tree = ClusterFaces(&solved.scene.mesh, solved.scene.parts);
  HierarchicalRadiosity solver(solved.scene, tree, options);
  solver.Run();
  solved.solution = solver.Solution();
  solved.statistics = solver.Statistics();
  return solved;
}

Solved Solve(Scene scene, double error) {
  HierarchicalRadiosityOptions options;
  options.error = error;
  return Solve(std::move(scene), options);
}

/// Area-weighted mean radiosity of the triangles whose normal is `n`.
double MeanRadiosity(const RadiositySolution& solution, const Vec3f& n) {
  double sum = 0, area = 0;
  const TriangleMesh& mesh = solution.mesh;
  for (int64_t t = 0; t < mesh.FaceCount(); ++t) {
    if (Dot(mesh.FrontNormal(t), n) < 0.999f) continue;
    double mean = 0;
    for (const int32_t p : mesh.triangles[size_t(t)])
      mean += double(solution.radiosity[size_t(p)].g) / 3;
    sum += mean * mesh.Area(t);
    area += mesh.Area(t);
  }
  return sum / area;
}

Scene Furnace(float rho) {
  Scene scene;
  AddBox(&scene.mesh, {0, 0, 0}, {1, 1, 1}, BoxMaterials(rho, 1), true);
  testing::CompleteTables(&scene);
  return scene;
}

// In a closed furnace every radiosity is 1 / (1 - rho). Row sums are right
// to 1 %; interreflection multiplies their error by rho / (1 - rho).
class FurnaceTest : public ::testing::TestWithParam<float> {};
TEST_P(FurnaceTest, RadiosityIsExitanceOverOneMinusReflectance) {
  const float rho = GetParam();
  const Solved solved = Solve(Furnace(rho), 0.1);
  const double expected = 1 / (1 - double(rho));
  double sum = 0, area = 0;
  for (int64_t t = 0; t < solved.solution.mesh.FaceCount(); ++t) {
    for (const int32_t p : solved.solution.mesh.triangles[size_t(t)]) {
      sum += double(solved.solution.radiosity[size_t(p)].g) / 3 * solved.solution.mesh.Area(t);
    }
    area += solved.solution.mesh.Area(t);
  }
  EXPECT_NEAR(area, 6, 1e-4);  // the inner side alone is modelled
  EXPECT_NEAR(sum / area / expected, 1, 0.01 * double(rho) / (1 - double(rho)));
}
INSTANTIATE_TEST_SUITE_P(Reflectances, FurnaceTest, ::testing::Values(0.5f, 0.8f, 0.95f));

TEST(HierarchicalRadiosity, RoomUnderABrightCeiling) {
  // Unit cube, black ceiling of exitance 1, other faces rho = 0.5.
  const Solved solved = Solve(testing::BoxRoom(1, 0.5f, 1), 0.1);
  EXPECT_NEAR(MeanRadiosity(solved.solution, {0, 0, 1}), 0.15517, 0.02 * 0.15517);
  EXPECT_NEAR(MeanRadiosity(solved.solution, {1, 0, 0}), 0.16400, 0.02 * 0.16400);
}

TEST(HierarchicalRadiosity, EnergyIsEmittedAbsorbedOrEscapes) {
  // An open room: floor, one wall, a lamp; escape is found by rays of its own, 32768 of them: 1 %
  // of noise.
  Scene scene;
  AddQuad(&scene.mesh, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, Spectrum(0.7f), Spectrum(0.f), 4, 0);
  AddQuad(&scene.mesh, {0, 0, 0}, {0, 2, 0}, {0, 0, 2}, Spectrum(0.4f, 0.6f, 0.2f), Spectrum(0.f),
          4, 1);
  AddQuad(&scene.mesh, {0.8f, 0.8f, 1}, {0, 0.4f, 0}, {0.4f, 0, 0}, Spectrum(0.f), Spectrum(10.f),
          1, 2);
  testing::CompleteTables(&scene);
  const SolverStatistics s = Solve(scene, 0.02).statistics;
  for (int band = 0; band < 3; ++band) {
    EXPECT_NEAR(s.emitted[band], 10 * 0.16f, 1e-4);
    EXPECT_GT(s.escaped[band], 0);
    EXPECT_NEAR((s.absorbed[band] + s.escaped[band]) / s.emitted[band], 1, 0.02);
  }
}

TEST(HierarchicalRadiosity, LightOnFacesUnderOthersIsAccountedForApart) {
  // A floor under a lamp, and the same floor once more over its inner square of 1 m2: both receive,
  // one is seen. Escape and cover are found by 32768 rays each: 1 % of noise.
  Scene scene;
  AddQuad(&scene.mesh, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, Spectrum(0.5f), Spectrum(0.f), 8, 0);
  AddQuad(&scene.mesh, {0.5f, 0.5f, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.5f), Spectrum(0.f), 8, 1);
  AddQuad(&scene.mesh, {0.8f, 0.8f, 1}, {0, 0.4f, 0}, {0.4f, 0, 0}, Spectrum(0.f), Spectrum(10.f),
          1, 2);
  testing::CompleteTables(&scene);
  const SolverStatistics s = Solve(scene, 0.02).statistics;
  for (int band = 0; band < 3; ++band) {
    EXPECT_GT(s.absorbed[band] + s.escaped[band], 1.1 * s.emitted[band]);
    EXPECT_NEAR((s.absorbed[band] - s.covered[band] + s.escaped[band]) / s.emitted[band], 1, 0.02);
  }
}

HierarchicalRadiosityOptions LinksAlone(double error) {
  HierarchicalRadiosityOptions options;
  options.error = error;
  options.finalGather = false;
  return options;
}

/// What both find.
SolverStatistics ExpectTheSameForOneThreadAndTwo(const Scene& scene,
                                                 const HierarchicalRadiosityOptions& options) {
  SetThreadCount(1);
  const Solved one = Solve(scene, options);
  SetThreadCount(2);
  const Solved two = Solve(scene, options);
  SetThreadCount(0);
  EXPECT_EQ(one.solution.irradiance, two.solution.irradiance);
  EXPECT_EQ(one.statistics.rays, two.statistics.rays);
  EXPECT_EQ(one.statistics.history.size(), two.statistics.history.size());
  EXPECT_EQ(one.statistics.history.back().error, two.statistics.history.back().error);
  return one.statistics;
}

TEST(HierarchicalRadiosity, TheSameForOneThreadAndTwo) {
  HierarchicalRadiosityOptions options;
  options.iterations = 4;
  ExpectTheSameForOneThreadAndTwo(testing::BoxRoom(1, 0.5f, 1, 4), options);
  ExpectTheSameForOneThreadAndTwo(testing::BoxRoom(1, 0.5f, 1, 4), LinksAlone(0.1));
}

// A look finds that the first gather is not enough.
TEST(HierarchicalRadiosity, TheSameForOneThreadAndTwoInASecondGather) {
  HierarchicalRadiosityOptions options;
  options.error = 0.05;
  const SolverStatistics found =
      ExpectTheSameForOneThreadAndTwo(testing::DataScene("CornellBox"), options);
  const auto isLook = [](const IterationRecord& record) { return record.error >= 0; };
  const auto first = std::find_if(found.history.begin(), found.history.end(), isLook);
  EXPECT_LT(first, found.history.end() - 1) << "nothing followed the first look";
}

TEST(HierarchicalRadiosity, LinksAloneMeetRequestsInARoom) {
  // Verified at points and paths of the test's own: 8000, whose scatter is a tenth of such errors.
  SolutionErrorOptions verification;
  verification.points = 8000;
  std::vector<double> errors;
  for (const double wanted : {0.2, 0.05}) {
    const Solved solved = Solve(testing::DataScene("CornellBox"), LinksAlone(wanted));
    EXPECT_EQ(solved.statistics.stoppedBy, "error");
    EXPECT_LE(solved.statistics.history.back().error, wanted);
    const SolutionError error = MeasureSolutionError(solved.scene, solved.solution, verification);
    EXPECT_LE(error.Counting(), 1.1 * wanted);
    errors.push_back(error.bounded);
    // No iteration gathers at points: each one refines links.
    for (size_t i = 1; i < solved.statistics.history.size(); ++i) {
      EXPECT_LT(solved.statistics.history[i].threshold, solved.statistics.history[i - 1].threshold);
    }
  }
  EXPECT_LT(errors[1], 0.7 * errors[0]);
}

TEST(HierarchicalRadiosity, LinksAloneAreRefinedOnWhereVerificationFails) {
  // Under the threshold that usually does, and not at all where nothing is verified.
  HierarchicalRadiosityOptions options = LinksAlone(0.05);
  const Solved verified = Solve(testing::DataScene("Sliver"), options);
  options.verificationPoints = 0;
  const Solved unverified = Solve(testing::DataScene("Sliver"), options);
  const std::vector<IterationRecord>& history = verified.statistics.history;
  const size_t usual = unverified.statistics.history.size();
  ASSERT_GT(history.size(), usual);
  EXPECT_GT(history[usual - 1].error, options.error);
  EXPECT_LT(history.back().error, options.error);
  EXPECT_EQ(history[usual - 1].links, unverified.statistics.history.back().links);
  EXPECT_EQ(unverified.statistics.history.back().error, -1);
  EXPECT_EQ(unverified.statistics.stoppedBy, "error");
}

// The first gather aims at more than is asked for; where a look finds that it is enough, no round
// follows. What nobody looks at is gathered for the request at once.
TEST(HierarchicalRadiosity, EndsWhereALookIsSure) {
  HierarchicalRadiosityOptions options;
  options.error = 0.1;
  const Solved looked = Solve(testing::DataScene("CornellBox"), options);
  options.verificationPoints = 0;
  const Solved unseen = Solve(testing::DataScene("CornellBox"), options);
  EXPECT_EQ(looked.statistics.stoppedBy, "error");
  EXPECT_EQ(unseen.statistics.stoppedBy, "error");
  EXPECT_LE(looked.statistics.history.back().error, options.error);
  EXPECT_EQ(unseen.statistics.history.back().error, -1);
  EXPECT_LT(looked.solution.inputFaceId.size(), unseen.solution.inputFaceId.size());
  SolutionErrorOptions verification;
  verification.points = 8000;
  EXPECT_LE(MeasureSolutionError(looked.scene, looked.solution, verification).Counting(), 0.1);
}

// What gathers finds its place among four parts as among two: read at wrong ones, half a shadow is
// lit, and the request was never met (0.045).
TEST(HierarchicalRadiosity, RegularPatchesAreGatheredFromToo) {
  HierarchicalRadiosityOptions options;
  options.error = 0.03;
  options.leafMesh.refinement = PatchRefinement::Quadtree;
  const Solved solved = Solve(testing::DataScene("ShadowedSlivers"), options);
  EXPECT_EQ(solved.statistics.stoppedBy, "error");
  EXPECT_LE(MeasureSolutionError(solved.scene, solved.solution).Counting(), 1.1 * options.error);
}

TEST(HierarchicalRadiosity, APointLightOverAFloor) {
  Scene scene;
  AddQuad(&scene.mesh, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, Spectrum(0.5f));
  Light light;
  light.position = {0, 0, 1};
  light.intensity = Spectrum(3.f);
  scene.lights.push_back(light);
  testing::CompleteTables(&scene);
  const Solved solved = Solve(scene, 0.05);
  // At every point I cos / r^2, exactly: nothing is in the way, nothing else gives light.
  for (size_t p = 0; p < solved.solution.irradiance.size(); ++p) {
    const Vec3f x = solved.solution.mesh.positions[p];
    const float r = Length(light.position - x);
    EXPECT_NEAR(solved.solution.irradiance[p].r, 3 / (r * r * r), 0.01f * 3 / (r * r * r));
  }
  EXPECT_GT(solved.statistics.patchElements, 16);
}

TEST(HierarchicalRadiosity, AConstantSkyOverAnOpenFloor) {
  Scene scene;
  AddQuad(&scene.mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.5f));
  Light sky;
  sky.type = LightType::Sky;
  sky.intensity = Spectrum(2.f);
  scene.lights.push_back(sky);
  testing::CompleteTables(&scene);
  const Solved solved = Solve(scene, 0.05);
  for (const Spectrum& e : solved.solution.irradiance) EXPECT_NEAR(e.g, 2 * kPi, 0.001 * 2 * kPi);
}

TEST(HierarchicalRadiosity, AGradientSkyOverAnOpenFloor) {
  Scene scene;
  AddQuad(&scene.mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.5f));
  Light sky;
  sky.type = LightType::GradientSky;
  sky.intensity = {4, 1, 0};
  sky.horizon = {1, 1, 3};
  scene.lights.push_back(sky);
  testing::CompleteTables(&scene);
  for (const bool finalGather : {true, false}) {
    HierarchicalRadiosityOptions options;
    options.finalGather = finalGather;
    const Solved solved = Solve(scene, options);
    for (size_t p = 0; p < solved.solution.irradiance.size(); ++p) {
      if (solved.solution.mesh.normals[p].z < 0) continue;  // The ground is black.
      for (int band = 0; band < 3; ++band) {
        const double h = double(sky.horizon[band]), rise = double(sky.intensity[band]) - h;
        const double expected = kPi * h + 2 * kPi / 3 * rise;
        // The error that is asked for where nothing else is.
        EXPECT_NEAR(solved.solution.irradiance[p][band], expected, 0.05 * expected);
      }
    }
  }
}

TEST(HierarchicalRadiosity, SaysWhyItStopped) {
  HierarchicalRadiosityOptions options;
  options.iterations = 2;
  EXPECT_EQ(Solve(Furnace(0.5f), options).statistics.stoppedBy, "iterations");
  Scene scene = Furnace(0.5f);
  scene.mesh.Complete();
  const ClusterTree tree = ClusterFaces(&scene.mesh, scene.parts);
  HierarchicalRadiosity solver(scene, tree);
  int seen = 0;
  solver.Run({}, [&](const IterationRecord& record) { return ++seen, record.iteration < 3; });
  EXPECT_EQ(seen, 3);
  EXPECT_EQ(solver.Statistics().stoppedBy, "interrupt");
  EXPECT_FALSE(solver.Solution().irradiance.empty());
}

TEST(HierarchicalRadiosity, CancelledInTheMiddleKeepsTheLastIteration) {
  Scene scene = testing::BoxRoom(1, 0.5f, 1);
  scene.mesh.Complete();
  const ClusterTree tree = ClusterFaces(&scene.mesh, scene.parts);
  HierarchicalRadiosity solver(scene, tree);
  int64_t links = 0;
  bool cancel = false;
  solver.Run([&](double, const char*) { return !cancel; },
             [&](const IterationRecord& record) {
               links = record.links;
               if (record.iteration == 3) cancel = true;
               return true;
             });
  EXPECT_EQ(solver.Statistics().stoppedBy, "interrupt");
  EXPECT_EQ(solver.Statistics().Links(), links);
}

TEST(HierarchicalRadiosity, RefusesWhatItCannotSolve) {
  Scene scene = testing::BoxRoom(1, 0.5f, 1);
  scene.mesh.Complete();
  const ClusterTree tree = ClusterFaces(&scene.mesh, scene.parts);
  HierarchicalRadiosityOptions options;
  for (const double error : {0.0, -1.0, 2.0, double(NAN)}) {
    options.error = error;
    EXPECT_THROW(HierarchicalRadiosity(scene, tree, options), Error);
  }
  scene.mesh.normals.clear();
  EXPECT_THROW(HierarchicalRadiosity(scene, tree), Error);
}

TEST(HierarchicalRadiosity, DegenerateFacesDoNoHarm) {
  Scene scene = testing::BoxRoom(1, 0.5f, 1);
  testing::AddTriangle(&scene.mesh, {.2f, .2f, .5f}, {.8f, .2f, .5f}, {.5f, .2f, .5f},
                       Spectrum(.5f));
  testing::AddTriangle(&scene.mesh, {.2f, .2f, .5f}, {.2f, .2f, .5f}, {.2f, .2f, .5f},
                       Spectrum(.5f));
  testing::AddTriangle(&scene.mesh, {.2f, .2f, .4f}, {.8f, .2f, .4f}, {.5f, .2006f, .4f},
                       Spectrum(.5f));
  testing::CompleteTables(&scene);
  const Solved solved = Solve(scene, 0.1);
  for (const Spectrum& e : solved.solution.irradiance) EXPECT_TRUE(e.IsFinite());
  for (const Spectrum& b : solved.solution.radiosity) EXPECT_TRUE(b.IsFinite());
}

}  // namespace
}  // namespace lambert
