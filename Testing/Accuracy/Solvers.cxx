#include "Solvers.h"

#include "Classical/Core/CachedRadiosity.h"
#include "Classical/Core/MatrixRadiosity.h"
#include "Classical/Core/ProgressiveRadiosity.h"
#include "Radiosity/Core/HierarchicalRadiosity.h"

namespace lambert::testing {

namespace {

constexpr double kElementSize = 1;  ///< m

RadiositySolution SolveHierarchical(double error, Scene* scene, SolverStatistics* statistics) {
  const ClusterTree tree = ClusterFaces(&scene->mesh, scene->parts);
  HierarchicalRadiosityOptions options;
  options.error = error;
  HierarchicalRadiosity solver(*scene, tree, options);
  solver.Run();
  RadiositySolution solution = solver.Solution();
  *statistics = solver.Statistics();
  return solution;
}

RadiositySolution SolveMatrix(double error, Scene* scene, SolverStatistics* statistics) {
  MatrixRadiosityOptions options;
  options.elementSize = kElementSize;
  return SolveMatrixRadiosity(*scene, options, statistics);
}

RadiositySolution SolveProgressive(double error, Scene* scene, SolverStatistics* statistics) {
  ProgressiveRadiosityOptions options;
  options.unshot = 0.05;
  options.elementSize = kElementSize;
  return SolveProgressiveRadiosity(*scene, options, statistics);
}

RadiositySolution SolveCached(double, Scene* scene, SolverStatistics* statistics) {
  CachedRadiosityOptions options;
  options.elementSize = kElementSize / 2;  // cells mix what lies beside one another
  // Among hundreds of emitters that hide each other few rays choose badly: with the usual 16 the
  // noise of direct light alone is up to 0.4.
  options.emitterRays = 64;
  return SolveCachedRadiosity(*scene, options, statistics);
}

}  // namespace

const std::vector<Solver>& Solvers() {
  static const std::vector<Solver> solvers{{"hierarchical", SolveHierarchical, 2},
                                           {"matrix", SolveMatrix, 12},
                                           {"progressive", SolveProgressive, 12},
                                           {"cached", SolveCached, 12}};
  return solvers;
}

}  // namespace lambert::testing
