#include "SolveMethod.h"

#include "Common/Core/Error.h"

#include <algorithm>

namespace lambert {
const std::vector<SolveMethodTraits>& SolveMethods() {
  static const std::vector<SolveMethodTraits> methods{
      {SolveMethod::Hierarchical, "hierarchical", {"--error", "--time", "--iterations"}},
      {SolveMethod::Reference, "reference", {"--samples", "--seed"}},
      {SolveMethod::Matrix, "matrix", {"--element-size"}},
      {SolveMethod::Cached, "cached", {"--element-size", "--paths", "--gather-rays", "--seed"}},
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
    case SolveMethod::Cached:
      return {{"element_size", options.cached.elementSize},
              {"paths", options.cached.paths},
              {"gather_rays", options.cached.gatherRays},
              {"seed", static_cast<double>(options.cached.seed)}};
    case SolveMethod::Hierarchical:
      break;
  }
  return {};
}

RadiositySolution SolveInOnePass(const Scene& scene, const SolveMethodOptions& options,
                                 SolverStatistics* statistics, const ProgressCallback& progress) {
  switch (options.method) {
    case SolveMethod::Reference:
      return BakePathTraced(scene, options.reference, statistics, progress);
    case SolveMethod::Matrix:
      return SolveMatrixRadiosity(scene, options.matrix, statistics, progress);
    case SolveMethod::Cached:
      return SolveCachedRadiosity(scene, options.cached, statistics, progress);
    case SolveMethod::Hierarchical:
      break;
  }
  throw Error("Hierarchical radiosity is solved iteration by iteration, not in one pass.");
}
}  // namespace lambert
