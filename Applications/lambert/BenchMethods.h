// The methods that a bench compares: one row of a table each.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "Common/Core/Progress.h"
#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"

namespace lambert {

/// What a method delivered and where its time went; stages that a method does not have stay 0.
struct BenchOutcome {
  RadiositySolution solution;  ///< `inputFaceId` names faces of the scene as it was given
  SolverStatistics statistics;
  double seconds = 0;  ///< from the mesh to the light at the vertices
  double clustering = 0, setup = 0, iterations = 0, reconstruction = 0;
};

struct BenchMethod {
  const char* name;     ///< as in --methods and in the CSV
  const char* label;    ///< at its curve
  const char* knob;     ///< error, samples, gather_rays, or size (fraction of the diagonal)
  bool meshesByItself;  ///< takes the scene before it was tessellated
  bool hasElements;     ///< models the scene by elements
  /// Throws Error, and Cancelled where `progress` asked for it.
  std::function<BenchOutcome(const Scene&, double knob, uint64_t seed,
                             const ProgressCallback& progress)>
      run;
};

/// True for knobs of which more is finer: samples, gather_rays.
bool IsFinerUpward(const std::string& knob);

const std::vector<BenchMethod>& BenchMethods();
/// Throws Error for a name that no method has.
const BenchMethod& FindBenchMethod(const std::string& name);

/// Hears of every intermediate solution as it can be shown: the seconds from the mesh to then,
/// those that the hearing took left out. False ends the run.
using ShownObserver =
    std::function<bool(double seconds, const IterationRecord&, const RadiositySolution&)>;

/// Hierarchical radiosity of `scene`, with the wanted error `error`. Throws Cancelled.
BenchOutcome RunHierarchical(const Scene& scene, double error, const ShownObserver& shown = {},
                             const ProgressCallback& progress = {});

}  // namespace lambert
