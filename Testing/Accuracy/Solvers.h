// The methods that deliver a solution, by one function each.
#pragma once

#include <vector>

#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"

namespace lambert::testing {

struct Solver {
  const char* name;
  /// Solves for a wanted relative error; methods on fixed meshes take elements of 1 m for good
  /// enough. `scene` may be put into another order.
  RadiositySolution (*solve)(double error, Scene* scene, SolverStatistics* statistics);
  size_t seedsApart;  ///< it is put to every so many-th of the seeds of a law
};

/// Hierarchical, matrix, progressive and cached radiosity.
const std::vector<Solver>& Solvers();

}  // namespace lambert::testing
