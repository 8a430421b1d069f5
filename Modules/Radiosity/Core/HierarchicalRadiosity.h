// Hierarchical radiosity on face clusters with vector irradiance (thesis 4.3 to 4.5).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "Clustering/Core/FaceClustering.h"
#include "Common/Core/Progress.h"
#include "Radiosity/Core/LeafMesh.h"
#include "Radiosity/Core/RefinementOracle.h"
#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"

namespace lambert {

/// When links are refined and when light bounces (thesis 3.2.4): light settles between one
/// threshold and the next; or one bounce follows every refinement, until light settles at the last
/// threshold.
enum class Schedule : uint8_t { Scheduled, Interleaved };
/// "scheduled" or "interleaved".
inline const char* ScheduleName(Schedule schedule) {
  return schedule == Schedule::Interleaved ? "interleaved" : "scheduled";
}

struct HierarchicalRadiosityOptions {
  double error = 0.05;  ///< wanted relative RMS error of irradiance, (0, 1]
  double timeLimit =
      0;  ///< seconds of solving after which the run ends at the next iteration border; 0: none
  /// MB (1e6 bytes) of the process, [0, inf): links are refined and light is gathered as long as
  /// that and the delivery stay below, the first iteration in any case; 0: no limit.
  double memoryLimit = 0;
  int iterations = 0;  ///< iterations after which the run ends; 0: as many as the error asks for
  /// Points at which a path trace verifies the delivered error, which is improved until it is the
  /// wanted one, [0, inf); 0: what usually gives that error is taken for it.
  int verificationPoints = 2000;
  /// Whether the final gather cuts triangles where interpolation between their corners fails. Where
  /// only light at the vertices is wanted that is work for nothing.
  bool cutsTriangles = true;
  /// Whether light is gathered anew at the points of the mesh in the end; without it what links
  /// brought is delivered, sooner and less exact.
  bool finalGather = true;
  Schedule schedule = Schedule::Scheduled;
  OracleKind oracle = OracleKind::Doubt;  ///< what judges links
  /// Whether the mesh of the links' light and the transfers to its points stay, where memory
  /// allows, for Solution() after Relight().
  bool keepsTransfers = false;
  /// File that gets the state at the end of every iteration of links, to go on from; empty: none.
  std::string saveState;
  /// File that a run of the same scene saved and that this one goes on from; empty: from the
  /// beginning.
  std::string resume;
  LeafMeshOptions leafMesh;
};

/// The solver. Construct, Run, then Solution; an observer may ask for a solution between
/// iterations.
class HierarchicalRadiosity {
 public:
  /// `scene` is in the order that ClusterFaces left it in; both are kept by reference.
  /// Throws Error for an error request outside (0, 1], and as LoadSolverState does.
  HierarchicalRadiosity(const Scene& scene, const ClusterTree& tree,
                        const HierarchicalRadiosityOptions& options = {});
  ~HierarchicalRadiosity();

  /// Called at the end of every iteration, when Solution() is up to date; false ends the run.
  using IterationObserver = std::function<bool(const IterationRecord&)>;

  /// Gather, push-pull, refine with a falling threshold (thesis figure 4.10); then final gather at
  /// the points of the mesh, in iterations of cuts until the wanted error is surely met, verified
  /// after the last of them and improved until it is or a stop comes before. Without final gather
  /// links are verified and refined on instead. A cancelled run keeps the state of its last whole
  /// iteration; `Statistics().stoppedBy` says why it ended. A resumed run comes to the same bits as
  /// one that was never stopped; its observer hears of the last iteration of the state first.
  /// Throws Error where the state cannot be saved.
  void Run(const ProgressCallback& progress = {}, const IterationObserver& observer = {});

  /// Lights the scene anew after a change of its faces' reflectance, emittance or sides that emit:
  /// elements and links with their visibility stay, light is exchanged until it settles, and no
  /// ray is cast unless other faces emit than before. Solution() then shows it; Run() goes on from
  /// there, first with an iteration that refines the links as far as they were before.
  /// Geometry, clusters and lights have to be what they were. False where light reaches other
  /// sides, or other surfaces emit without reflecting: then the solver has to be made anew.
  bool Relight();

  /// The displayable solution as it stands: that of the final gather once there is one, before it
  /// the reconstruction of 4.5.5 on the refined mesh.
  RadiositySolution Solution() const;
  /// The same, once: the one of a final gather is handed over instead of copied.
  RadiositySolution TakeSolution();
  const SolverStatistics& Statistics() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace lambert
