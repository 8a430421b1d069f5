#include "BenchMethods.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include "Classical/Core/CachedRadiosity.h"
#include "Classical/Core/MatrixRadiosity.h"
#include "Classical/Core/ProgressiveRadiosity.h"
#include "Clustering/Core/FaceClustering.h"
#include "Common/Core/Error.h"
#include "Common/Core/Timer.h"
#include "Radiosity/Core/HierarchicalRadiosity.h"
#include "Reference/Core/PathTracedBake.h"

namespace lambert {
namespace {

/// Seconds of the iterations that refined links. Those after them refined nothing: they gathered at
/// the points of the mesh.
double RefinementSeconds(const std::vector<IterationRecord>& history) {
  for (size_t i = 1; i < history.size(); ++i) {
    const IterationRecord &before = history[i - 1], &record = history[i];
    if (record.threshold == before.threshold && record.links == before.links &&
        record.elements == before.elements) {
      return before.seconds;
    }
  }
  return history.empty() ? 0 : history.back().seconds;
}

/// Runs a method that is one function, with its statistics.
template <class Solve>
BenchOutcome TimeOneStage(const Solve& solve) {
  BenchOutcome outcome;
  const Timer timer;
  outcome.solution = solve(&outcome.statistics);
  outcome.seconds = outcome.iterations = timer.Seconds();
  return outcome;
}

BenchOutcome RunPathTracedBake(const Scene& scene, double samples, uint64_t seed,
                               const ProgressCallback& progress) {
  PathTracedBakeOptions options;
  options.samples = int(samples);
  options.seed = seed;
  return TimeOneStage(
      [&](SolverStatistics* s) { return BakePathTraced(scene, options, s, progress); });
}

BenchOutcome RunCached(const Scene& scene, double gatherRays, uint64_t seed,
                       const ProgressCallback& progress) {
  // Cells of the usual size; their paths and the rays to emitters grow with the gather rays.
  CachedRadiosityOptions options;
  options.gatherRays = options.paths = int(gatherRays);
  options.emitterRays = std::max(1, int(gatherRays) / 4);
  options.seed = seed;
  return TimeOneStage(
      [&](SolverStatistics* s) { return SolveCachedRadiosity(scene, options, s, progress); });
}

double ElementSize(const Scene& scene, double fraction) {
  return fraction * double(scene.mesh.Bounds().Diagonal());
}

BenchOutcome RunMatrix(const Scene& scene, double size, uint64_t,
                       const ProgressCallback& progress) {
  MatrixRadiosityOptions options;
  options.elementSize = ElementSize(scene, size);
  return TimeOneStage(
      [&](SolverStatistics* s) { return SolveMatrixRadiosity(scene, options, s, progress); });
}

BenchOutcome RunProgressive(const Scene& scene, double size, uint64_t,
                            const ProgressCallback& progress) {
  ProgressiveRadiosityOptions options;
  options.elementSize = ElementSize(scene, size);
  return TimeOneStage(
      [&](SolverStatistics* s) { return SolveProgressiveRadiosity(scene, options, s, progress); });
}

}  // namespace

bool IsFinerUpward(const std::string& knob) { return knob == "samples" || knob == "gather_rays"; }

const std::vector<BenchMethod>& BenchMethods() {
  static const std::vector<BenchMethod> methods{
      {"hierarchical", "hierarchical", "error", false, true,
       [](const Scene& scene, double error, uint64_t, const ProgressCallback& progress) {
         return RunHierarchical(scene, error, {}, progress);
       }},
      {"reference", "path-traced bake", "samples", false, false, RunPathTracedBake},
      {"cached", "path-traced cache", "gather_rays", false, true, RunCached},
      {"matrix", "matrix", "size", true, true, RunMatrix},
      {"progressive", "progressive", "size", true, true, RunProgressive},
  };
  return methods;
}

const BenchMethod& FindBenchMethod(const std::string& name) {
  std::string names;
  for (const BenchMethod& method : BenchMethods()) {
    if (method.name == name) return method;
    names += (names.empty() ? "" : ", ") + std::string(method.name);
  }
  throw Error("There is no method \"" + name + "\"; there are " + names + ".");
}

BenchOutcome RunHierarchical(const Scene& scene, double error, const ShownObserver& shown,
                             const ProgressCallback& progress) {
  // The numbers of the faces ride along, for the way back from tree order.
  Scene clustered = scene;
  std::iota(clustered.mesh.sourceCellId.begin(), clustered.mesh.sourceCellId.end(), 0);
  const auto nameFacesOfScene = [&](RadiositySolution* solution) {
    for (int64_t& face : solution->inputFaceId) {
      face = clustered.mesh.sourceCellId[size_t(face)];
    }
  };

  BenchOutcome outcome;
  Timer timer;
  const ClusterTree tree = ClusterFaces(&clustered.mesh, clustered.parts, {}, nullptr, progress);
  outcome.clustering = timer.Seconds();

  timer.Restart();
  HierarchicalRadiosityOptions options;
  options.error = error;
  options.verificationPoints = 0;  // The bench measures by itself, and at the vertices alone.
  options.cutsTriangles = false;
  HierarchicalRadiosity solver(clustered, tree, options);
  outcome.setup = timer.Seconds();

  // What is shown between iterations takes its reconstruction; hearing of it takes no time.
  timer.Restart();
  double hearing = 0;
  std::atomic<bool> wasCut{false};  // Progress may be told by any thread.
  const ProgressCallback watched = [&](double fraction, const char* stage) {
    if (!Report(progress, fraction, stage)) wasCut = true;
    return !wasCut;
  };
  solver.Run(watched, [&](const IterationRecord& record) {
    if (!shown) return true;
    RadiositySolution solution = solver.Solution();
    const double seconds = timer.Seconds() - hearing;
    const Timer hearingTimer;
    nameFacesOfScene(&solution);
    const bool goOn = shown(outcome.clustering + outcome.setup + seconds, record, solution);
    hearing += hearingTimer.Seconds();
    return goOn;
  });
  outcome.iterations = timer.Seconds() - hearing;
  if (wasCut) throw Cancelled();

  timer.Restart();
  outcome.solution = solver.Solution();
  outcome.reconstruction = timer.Seconds();
  outcome.seconds =
      outcome.clustering + outcome.setup + outcome.iterations + outcome.reconstruction;
  outcome.statistics = solver.Statistics();

  // A final gather is reconstruction, though it is done in iterations.
  if (!shown) {
    const double refinement = RefinementSeconds(outcome.statistics.history);
    outcome.reconstruction += outcome.iterations - refinement;
    outcome.iterations = refinement;
  }
  nameFacesOfScene(&outcome.solution);
  return outcome;
}

}  // namespace lambert
