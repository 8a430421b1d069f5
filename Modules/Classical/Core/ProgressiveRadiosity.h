// Progressive radiosity: the patch with the most unshot light shoots, again and again (Southwell
// iteration; cohen1988; thesis 3.1.2). Light is received at the vertices of finer elements
// (substructuring; receivers as in wallace1989).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "Common/Core/Progress.h"
#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"

namespace lambert {

struct ProgressiveRadiosityOptions {
  double elementSize = 0;  ///< longest edge of an element, m; 0: 1/50 of the scene's diagonal
  double patchSize = 0;    ///< longest edge of a patch, m; 0: 4 times the element size
  double unshot = 0.005;   ///< part of the first light that may stay unshot, (0, 1)
  int64_t shots = 0;       ///< shots after which the run ends; 0: as many as it takes
  int skyRays = 256;       ///< rays to the sky a vertex, [1, inf)
};

/// The solver. Construct, Run, then Solution; an observer may ask for a solution between
/// iterations.
class ProgressiveRadiosity {
 public:
  /// Keeps a reference to `scene`, which needs point normals. Throws Error for options out of
  /// range.
  explicit ProgressiveRadiosity(const Scene& scene,
                                const ProgressiveRadiosityOptions& options = {});
  ~ProgressiveRadiosity();

  /// Called when the unshot light has halved; false ends the run.
  using Observer = std::function<bool(const IterationRecord&)>;

  /// Shoots until little light is unshot. A cancelled run keeps what was shot;
  /// `Statistics().stoppedBy` says why it ended.
  void Run(const ProgressCallback& progress = {}, const Observer& observer = {});

  /// The light as it stands.
  RadiositySolution Solution() const;
  /// The same for display, with the ambient term: unshot light as if it had spread evenly already
  /// (cohen1988, section 4). It grows less as light is shot and is no part of any result.
  RadiositySolution SolutionWithAmbient() const;
  /// The ambient irradiance, W/m2.
  Spectrum AmbientIrradiance() const;
  const SolverStatistics& Statistics() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Runs to the end. As ProgressiveRadiosity; throws Cancelled where it was interrupted.
RadiositySolution SolveProgressiveRadiosity(const Scene& scene,
                                            const ProgressiveRadiosityOptions& options = {},
                                            SolverStatistics* statistics = nullptr,
                                            const ProgressCallback& progress = {});

}  // namespace lambert
