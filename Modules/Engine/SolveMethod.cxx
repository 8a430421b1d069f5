#include "SolveMethod.h"

#include "Common/Core/Error.h"

#include <algorithm>

namespace lambert {
const std::vector<SolveMethodTraits>& SolveMethods() {
  static const std::vector<SolveMethodTraits> methods{
      {SolveMethod::Hierarchical,
       "hierarchical",
       {"--error", "--time", "--max-memory", "--iterations", "--no-final-gather", "--save-state",
        "--resume", "--oracle", "--refinement", "--schedule", "--snap-tolerance"}},
      {SolveMethod::Reference, "reference", {"--samples", "--seed"}},
      {SolveMethod::Matrix, "matrix", {"--element-size"}},
      {SolveMethod::Progressive, "progressive", {"--element-size"}},
      {SolveMethod::Cached,
       "cached",
       {"--element-size", "--output-size", "--paths", "--gather-rays", "--emitter-rays", "--seed"}},
  };
  return methods;
}

const SolveMethodTraits& TraitsOf(SolveMethod method) {
  return *std::find_if(SolveMethods().begin(), SolveMethods().end(),
                       [&](const SolveMethodTraits& traits) { return traits.method == method; });
}

std::vector<std::pair<std::string, double>> ValuesOf(const SolveMethodOptions& options) {
  switch (options.method) {
    case SolveMethod::Reference:
      return {{"samples", options.reference.samples},
              {"seed", static_cast<double>(options.reference.seed)}};
    case SolveMethod::Matrix:
      return {{"element_size", options.matrix.elementSize}};
    case SolveMethod::Progressive:
      return {{"element_size", options.progressive.elementSize}};
    case SolveMethod::Cached:
      return {{"element_size", options.cached.elementSize},
              {"output_size", options.cached.outputSize},
              {"paths", options.cached.paths},
              {"gather_rays", options.cached.gatherRays},
              {"emitter_rays", options.cached.emitterRays},
              {"seed", static_cast<double>(options.cached.seed)}};
    case SolveMethod::Hierarchical:
      break;
  }
  return {};
}

namespace {
RadiositySolution SolveProgressively(const Scene& scene, const ProgressiveRadiosityOptions& options,
                                     SolverStatistics* statistics, const ProgressCallback& progress,
                                     const std::function<void(const IterationRecord&)>& observer) {
  ProgressiveRadiosity solver(scene, options);
  solver.Run(progress, [&](const IterationRecord& record) {
    if (observer) {
      observer(record);
    }
    return true;
  });
  *statistics = solver.Statistics();
  return solver.Solution();
}
}  // namespace

RadiositySolution SolveByMethod(const Scene& scene, const SolveMethodOptions& options,
                                SolverStatistics* statistics, const ProgressCallback& progress,
                                const std::function<void(const IterationRecord&)>& observer) {
  switch (options.method) {
    case SolveMethod::Reference:
      return BakePathTraced(scene, options.reference, statistics, progress);
    case SolveMethod::Matrix:
      return SolveMatrixRadiosity(scene, options.matrix, statistics, progress);
    case SolveMethod::Progressive:
      return SolveProgressively(scene, options.progressive, statistics, progress, observer);
    case SolveMethod::Cached:
      return SolveCachedRadiosity(scene, options.cached, statistics, progress);
    case SolveMethod::Hierarchical:
      break;
  }
  throw Error("Hierarchical radiosity is solved by RadiosityRun itself.");
}
}  // namespace lambert
