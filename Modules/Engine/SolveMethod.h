// The methods that light a scene, by name: the options of each, and the one place that calls them.
// C++ only.
#ifndef SolveMethod_h
#define SolveMethod_h

#include "Classical/Core/CachedRadiosity.h"
#include "Classical/Core/MatrixRadiosity.h"
#include "Common/Core/Progress.h"
#include "Reference/Core/PathTracedBake.h"
#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"
#include "lambertEngineModule.h"

#include <string>
#include <utility>
#include <vector>

namespace lambert {
enum class SolveMethod {
  Hierarchical,  ///< hierarchical radiosity on face clusters, iteration by iteration
  Reference,     ///< path-traced light at the vertices of the mesh
  Matrix,        ///< all form factors between uniform elements, Gauss-Seidel
  Cached,        ///< path-traced light of uniform elements, gathered at points
};

/// The chosen method, and the options of those that are one function of the scene; Hierarchical has
/// its own in RadiosityRunOptions. Only those of the chosen method count.
struct SolveMethodOptions {
  SolveMethod method = SolveMethod::Hierarchical;
  PathTracedBakeOptions reference;
  MatrixRadiosityOptions matrix;
  CachedRadiosityOptions cached;
};

/// What is known of a method without running it.
struct SolveMethodTraits {
  SolveMethod method;
  std::string name;                  ///< on the command line and in reports
  std::vector<std::string> options;  ///< of the command line (--error ...) that belong to it
};

/// All methods, the default first.
LAMBERTENGINE_EXPORT const std::vector<SolveMethodTraits>& SolveMethods();
LAMBERTENGINE_EXPORT const SolveMethodTraits& TraitsOf(SolveMethod method);

/// What the chosen method was asked for, by name, for the report; empty for Hierarchical.
LAMBERTENGINE_EXPORT std::vector<std::pair<std::string, double>> ValuesOf(
    const SolveMethodOptions& options);

/// Solves by any method but Hierarchical. Throws Error, Cancelled.
LAMBERTENGINE_EXPORT RadiositySolution SolveInOnePass(const Scene& scene,
                                                      const SolveMethodOptions& options,
                                                      SolverStatistics* statistics,
                                                      const ProgressCallback& progress = {});
}  // namespace lambert

#endif
