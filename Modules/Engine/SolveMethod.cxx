#include "SolveMethod.h"

#include "Common/Core/Error.h"

#include <algorithm>

namespace lambert {
const std::vector<SolveMethodTraits>& SolveMethods() {
  static const std::vector<SolveMethodTraits> methods{
      {SolveMethod::Hierarchical, "hierarchical", {"--error", "--time", "--iterations"}},
      {SolveMethod::Reference, "reference", {"--samples", "--seed"}},
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
    case SolveMethod::Hierarchical:
      break;
  }
  throw Error("Hierarchical radiosity is solved iteration by iteration, not in one pass.");
}
}  // namespace lambert
