// A solved scene whose materials change is lit anew over the links that there are.
#include <gtest/gtest.h>

#include "Reference/Core/SolutionError.h"
#include "SolverScenes.h"

namespace lambert {
namespace {

constexpr double kError = 0.3;

struct ClusteredScene {
  Scene scene;
  ClusterTree tree;

  explicit ClusteredScene(Scene given) : scene(std::move(given)) {
    scene.mesh.Complete();
    tree = ClusterFaces(&scene.mesh, scene.parts);
  }
};

HierarchicalRadiosityOptions Links(int iterations) {
  HierarchicalRadiosityOptions options;
  options.error = kError;
  options.finalGather = false;
  options.verificationPoints = 0;
  options.iterations = iterations;
  return options;
}

Spectrum Mean(const std::vector<Spectrum>& values) {
  Spectrum sum;
  for (const Spectrum& value : values) sum += value;
  return sum / float(values.size());
}

// Twice the emission is twice the light, over the same links. Sweeps stop at a change of a
// thousandth before links are as fine as they will be; what they leave adds up to a few of them.
TEST(RelightingTest, IsLinearInTheEmission) {
  ClusteredScene box(testing::DataScene("CornellBox"));
  HierarchicalRadiosity solver(box.scene, box.tree, Links(3));
  solver.Run();
  const std::vector<Spectrum> before = solver.Solution().irradiance;
  const int64_t links = solver.Statistics().Links();
  for (Spectrum& emittance : box.scene.mesh.emittance) emittance *= 2;
  ASSERT_TRUE(solver.Relight());
  EXPECT_EQ(solver.Statistics().Links(), links);
  const std::vector<Spectrum> after = solver.Solution().irradiance;
  ASSERT_EQ(before.size(), after.size());
  const Spectrum a = Mean(after), b = Mean(before);
  for (int band = 0; band < 3; ++band) EXPECT_NEAR(a[band] / b[band], 2, 0.01);
}

// What is kept of the shown light gives the bits that all made anew gives; no mesh is made again,
// and of the transfers only those that were too faint for the old light.
TEST(RelightingTest, KeepsTheTransfersOfItsLinks) {
  ClusteredScene box(testing::DataScene("CornellBox"));
  HierarchicalRadiosityOptions keeping = Links(4);
  keeping.keepsTransfers = true;
  HierarchicalRadiosity keeper(box.scene, box.tree, keeping);
  HierarchicalRadiosity maker(box.scene, box.tree, Links(4));
  for (HierarchicalRadiosity* solver : {&keeper, &maker}) {
    solver->Run();
    solver->Solution();
  }
  const SolverStatistics before = keeper.Statistics();
  EXPECT_EQ(before.linkMeshes, 1);
  EXPECT_GT(before.linkTransfers, 0);
  keeper.Solution();
  EXPECT_EQ(keeper.Statistics().linkTransfers, before.linkTransfers);

  for (Spectrum& reflectance : box.scene.mesh.reflectance) reflectance = reflectance * 0.7f;
  ASSERT_TRUE(keeper.Relight() && maker.Relight());
  const RadiositySolution kept = keeper.Solution(), made = maker.Solution();
  EXPECT_EQ(kept.irradiance, made.irradiance);
  EXPECT_EQ(kept.radiosity, made.radiosity);
  EXPECT_EQ(kept.mesh.reflectance, made.mesh.reflectance);
  EXPECT_EQ(kept.mesh.positions, made.mesh.positions);
  EXPECT_EQ(kept.inputIrradiance, made.inputIrradiance);
  EXPECT_EQ(keeper.Statistics().linkMeshes, 1);
  EXPECT_EQ(maker.Statistics().linkMeshes, 2);
  EXPECT_LT(double(keeper.Statistics().linkTransfers), 1.1 * double(before.linkTransfers));

  // Links that were refined are shown on a mesh of their own.
  for (HierarchicalRadiosity* solver : {&keeper, &maker}) solver->Run();
  EXPECT_EQ(keeper.Solution().irradiance, maker.Solution().irradiance);
  EXPECT_EQ(keeper.Statistics().linkMeshes, 2);
}

// In a furnace of reflectance rho radiosity is emittance / (1 - rho). Links of a convex room have
// form factors to within the scatter of their sums about 1, cut at 1.25.
TEST(RelightingTest, KnowsTheFurnaceOfAnotherReflectance) {
  ClusteredScene cube(testing::FurnaceCube(0.3f));
  HierarchicalRadiosity solver(cube.scene, cube.tree, Links(3));
  solver.Run();
  EXPECT_NEAR(Mean(solver.Solution().radiosity).g, 1 / 0.7, 0.02 / 0.7);
  for (Spectrum& reflectance : cube.scene.mesh.reflectance) reflectance = Spectrum(0.8f);
  ASSERT_TRUE(solver.Relight());
  EXPECT_NEAR(Mean(solver.Solution().radiosity).g, 1 / 0.2, 0.08 / 0.2);
}

// What is refined and gathered after a change has the error that was asked for, as that of a new
// solver has.
TEST(RelightingTest, MeetsTheErrorThatANewSolverMeets) {
  ClusteredScene box(testing::DataScene("CornellBox"));
  HierarchicalRadiosityOptions options;
  options.error = kError;
  options.verificationPoints = 500;
  HierarchicalRadiosity solver(box.scene, box.tree, options);
  solver.Run();
  ASSERT_EQ(solver.Statistics().stoppedBy, "error");
  for (size_t face = 0; face < box.scene.mesh.reflectance.size(); ++face) {
    Spectrum& reflectance = box.scene.mesh.reflectance[face];
    reflectance = {reflectance.b, reflectance.r, reflectance.g * 0.5f};
  }
  ASSERT_TRUE(solver.Relight());
  solver.Run();
  EXPECT_EQ(solver.Statistics().stoppedBy, "error");
  EXPECT_EQ(solver.Statistics().history.front().iteration, 1);

  HierarchicalRadiosity fresh(box.scene, box.tree, options);
  fresh.Run();
  const Spectrum a = Mean(solver.Solution().inputIrradiance);
  const Spectrum b = Mean(fresh.Solution().inputIrradiance);
  for (int band = 0; band < 3; ++band) EXPECT_NEAR(a[band] / b[band], 1, kError);
  SolutionErrorOptions points;
  points.points = 500;
  EXPECT_LE(MeasureSolutionError(box.scene, solver.Solution(), points).Counting(), 1.1 * kError);
}

// Surfaces that emit and do not reflect are clustered apart; others cannot become such ones.
TEST(RelightingTest, SaysWhereTheSolverHasToBeMadeAnew) {
  Scene room;
  testing::AddLitRoom(&room.mesh, 1, 0.5f, 100);
  testing::CompleteTables(&room);
  ClusteredScene clustered(room);
  TriangleMesh& mesh = clustered.scene.mesh;
  HierarchicalRadiosity solver(clustered.scene, clustered.tree, Links(2));
  solver.Run();
  EXPECT_TRUE(solver.Relight());
  for (size_t face = 0; face < mesh.reflectance.size(); ++face) {
    if (!mesh.emittance[face].IsBlack()) mesh.reflectance[face] = Spectrum(0.5f);
  }
  EXPECT_FALSE(solver.Relight());
}

}  // namespace
}  // namespace lambert
