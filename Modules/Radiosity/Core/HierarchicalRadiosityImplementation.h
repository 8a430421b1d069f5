// What stands behind HierarchicalRadiosity: the scene in elements, their links and light, and the
// iterations that a run is made of.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "Common/Core/Timer.h"
#include "Radiosity/Core/ExposureSplitting.h"
#include "Radiosity/Core/GatheredSolution.h"
#include "Radiosity/Core/HierarchicalRadiosity.h"
#include "Radiosity/Core/LinkRefinement.h"
#include "Radiosity/Core/LinkSolution.h"
#include "Radiosity/Core/SolverMemory.h"
#include "Radiosity/Core/SolverState.h"
#include "Radiosity/Core/Verification.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

/// Share of the progress that is the final gather's.
constexpr double kGatherShare = 0.6;

struct HierarchicalRadiosity::Implementation {
  Implementation(const Scene& scene, const ClusterTree& tree,
                 const HierarchicalRadiosityOptions& options);

  const Scene& scene;
  const HierarchicalRadiosityOptions options;
  std::vector<uint8_t> emittingSides;  ///< per face
  SolverStatistics statistics;
  RayScene rayScene;
  std::vector<uint8_t> litSides;
  ElementHierarchy hierarchy;
  std::unique_ptr<RefinementOracle> oracle;
  ElementLight light;
  LinkNetwork network;
  std::vector<Exposure> exposures;
  std::optional<RadiositySolution> delivered;  ///< once gathered or verified
  std::unique_ptr<LinkSolution> linkSolution;  ///< while its links are these
  const SolverMemory memory;
  double firstThreshold;
  std::optional<IterationRecord> before;  ///< the iteration of links before the last
  bool isFull = false;                    ///< the last refinement found no room
  Timer clock;                            ///< since the run began
  double secondsBefore = 0;               ///< of the runs that this one goes on from
  /// Power that the leaves receive, W, largest band; thresholds are fractions of it.
  double received;

  SolverState State() {
    return {hierarchy, light, network, exposures, received, statistics.history};
  }
  void SaveState();
  double Seconds() const { return secondsBefore + clock.Seconds(); }
  bool HasTimeFor(double seconds) const {
    return !(options.timeLimit > 0 && clock.Seconds() + seconds > options.timeLimit);
  }

  // Iterations of links.
  bool RefineAndExchange(double last, double* threshold, double* change,
                         const ProgressCallback& progress);
  double Exchange(double tolerance);
  double Bounce(double tolerance);
  RadiositySolution Reconstruct();
  RadiositySolution LightOfLinks();
  bool EndsHere(bool goOn);
  bool EndsVerified(Verification* verification, const ProgressCallback& progress = {});

  // The final gather after them.
  bool HasTry() const;
  double FirstAim() const;
  void GatherUntilMet(const ProgressCallback& progress, const IterationObserver& observer);
  bool GatherRound(std::optional<GatheredSolution>* solution, double aim, int round,
                   const ProgressCallback& progress);
  bool EndsAfterRound(double next, const IterationObserver& observer);
  bool IsSurelyMet(Verification* verification, const ProgressCallback& progress);
};

}  // namespace lambert
