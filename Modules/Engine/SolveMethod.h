// The methods that light a scene, by name: the options of each, and the one place that calls them.
// C++ only.
#ifndef SolveMethod_h
#define SolveMethod_h

#include "Classical/Core/CachedRadiosity.h"
#include "Classical/Core/MatrixRadiosity.h"
#include "Classical/Core/ProgressiveRadiosity.h"
#include "Common/Core/Progress.h"
#include "Reference/Core/PathTracedBake.h"
#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"
#include "lambertEngineModule.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace lambert {
enum class SolveMethod {
  Hierarchical,  ///< hierarchical radiosity on face clusters, iteration by iteration
  Reference,     ///< path-traced light at the vertices of the mesh
  Matrix,        ///< all form factors between uniform elements, Gauss-Seidel
  Progressive,   ///< uniform patches shoot by turns at the vertices of finer elements
  Cached,        ///< path-traced light of uniform elements, gathered at points
};

/// The chosen method, and the options of all but Hierarchical, which has its own in
/// RadiosityRunOptions. Only those of the chosen method count.
struct SolveMethodOptions {
  SolveMethod method = SolveMethod::Hierarchical;
  PathTracedBakeOptions reference;
  MatrixRadiosityOptions matrix;
  ProgressiveRadiosityOptions progressive;
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

/// Solves by any method but Hierarchical. `observer` hears of the iterations of Progressive, which
/// keeps what it has where `progress` cancels it; the others throw Cancelled. Throws Error.
LAMBERTENGINE_EXPORT RadiositySolution
SolveByMethod(const Scene& scene, const SolveMethodOptions& options, SolverStatistics* statistics,
              const ProgressCallback& progress = {},
              const std::function<void(const IterationRecord&)>& observer = {});
}  // namespace lambert

#endif
