#include "Radiosity/Core/HierarchicalRadiosity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "Common/Core/Error.h"
#include "Common/Core/MemoryCeiling.h"
#include "Radiosity/Core/ElementCounts.h"
#include "Radiosity/Core/EnergyBalance.h"
#include "Radiosity/Core/HierarchicalRadiosityImplementation.h"
#include "Radiosity/Core/LightExchange.h"
#include "Radiosity/Core/LitSides.h"

namespace lambert {

namespace {

/// Thresholds are fractions of the power that surfaces receive: where refinement begins, by what
/// factor it falls.
constexpr double kFirstThreshold = 1e-2;
constexpr double kThresholdFactor = 0.25;
/// Bounces are followed until the radiosity changes by less than this in a sweep.
constexpr double kSweepTolerance = 1e-3, kLastSweepTolerance = 1e-5;
/// Any change will do after one sweep.
constexpr double kOneSweep = std::numeric_limits<double>::max();
constexpr int kMaximumSweeps = 500;
/// Half-hidden leaves are split while they receive more than this many thresholds.
constexpr double kExposureThreshold = 0.1;
/// Light grows where the change has not fallen after this many sweeps.
constexpr int kGrowthSweeps = 10;

/// Threshold, as a fraction of the power, to which links are refined for a wanted relative error.
/// The final gather sees leaves from afar: they may be coarser than what is delivered, but below a
/// tenth their four samples miss the bright places of a room; measured (Documentation/Stages).
double FinalThreshold(const HierarchicalRadiosityOptions& options) {
  const double error = options.finalGather ? std::min(options.error, 0.1) : options.error;
  return 1.6e-5 * std::pow(error / 0.05, 1.5);
}

/// Share of the progress, without a final gather, of links beyond the usual threshold.
constexpr double kFurtherShare = 0.5;
/// Progress after `done` iterations of links, where the usual threshold takes `usual`; each one
/// beyond it halves what is left.
double LinkProgress(const HierarchicalRadiosityOptions& options, double done, int usual) {
  if (options.finalGather) return (1 - kGatherShare) * std::min(1.0, done / usual);
  if (options.verificationPoints == 0) return std::min(1.0, done / usual);
  return done < usual ? (1 - kFurtherShare) * done / usual
                      : 1 - kFurtherShare * std::exp2(usual - done);
}

/// Attempts in a row that gain too little before a run gives up: a single iteration of links may
/// gain nothing and the next one much.
constexpr int kLinkPatience = 2;

/// Power of all sources, W, largest band: a first guess of what surfaces receive. Skies and suns
/// count over the bounds.
double SourcePower(const Scene& scene) {
  Spectrum power;
  const TriangleMesh& mesh = scene.mesh;
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    const int sides = int(mesh.Emits(face, kFront)) + int(mesh.Emits(face, kBack));
    if (sides) power += mesh.emittance[size_t(face)] * (float(sides) * mesh.Area(face));
  }
  const float half = mesh.Bounds().IsEmpty() ? 0 : mesh.Bounds().SurfaceArea() / 2;
  for (const auto& light : LightSources(scene.lights)) power += light->Power(half);
  return double(power.MaxBand());
}

/// The sides of every face that give light.
std::vector<uint8_t> EmittingSides(const TriangleMesh& mesh) {
  std::vector<uint8_t> sides(mesh.triangles.size(), 0);
  for (size_t face = 0; face < sides.size(); ++face) {
    if (mesh.emittance[face].IsBlack()) continue;
    sides[face] = mesh.faceFlags[face] & (kEmitsFront | kEmitsBack);
  }
  return sides;
}

/// Iterations of links that the falling threshold takes to `last`.
int IterationsTo(double last) {
  const double steps = std::log(last / kFirstThreshold) / std::log(kThresholdFactor);
  return std::max(1, 1 + int(std::ceil(steps)));
}

}  // namespace

/// The scene as it is, where it is what the solver needs.
static const Scene& Checked(const Scene& scene) {
  const TriangleMesh& mesh = scene.mesh;
  if (mesh.normals.size() != mesh.positions.size() ||
      mesh.surfaceId.size() != mesh.triangles.size()) {
    throw Error(
        "The mesh lacks point normals or surface numbers; make the first with CompletePointNormals "
        "and the second with ClusterFaces.");
  }
  return scene;
}

HierarchicalRadiosity::Implementation::Implementation(const Scene& scene_, const ClusterTree& tree,
                                                      const HierarchicalRadiosityOptions& options_)
    : scene(Checked(scene_)),
      options(options_),
      emittingSides(EmittingSides(scene_.mesh)),
      rayScene(statistics.stages.Time("rays", [&] { return RayScene(scene_.mesh); })),
      litSides(statistics.stages.Time(
          "lit sides", [&] { return FindLitSides(scene_, tree, rayScene, &statistics.rays); })),
      hierarchy(statistics.stages.Time(
          "elements", [&] { return ElementHierarchy(scene_, tree, litSides, options_.leafMesh); })),
      oracle(MakeRefinementOracle(options_.oracle, hierarchy, rayScene)),
      memory(options_.memoryLimit, hierarchy, litSides),
      firstThreshold(kFirstThreshold),
      received(SourcePower(scene_)) {
  if (!(options.error > 0 && options.error <= 1)) {
    throw Error("The wanted error is " + std::to_string(options.error) +
                "; give a fraction above 0 and at most 1.");
  }
  light.Grow(hierarchy);
  MakeInitialLinks(hierarchy, &network);
  network.rays = statistics.rays;
  if (options.resume.empty()) return;
  SolverState state = this->State();
  LoadSolverState(options.resume, &state);
  secondsBefore = statistics.history.back().seconds;
  if (statistics.history.size() > 1) before = statistics.history[statistics.history.size() - 2];
}

// What cannot be saved must not take with it what is solved.
void HierarchicalRadiosity::Implementation::SaveState() {
  if (options.saveState.empty()) return;
  try {
    SaveSolverState(this->State(), options.saveState);
    statistics.stateFailure.clear();
  } catch (const Error& error) {
    statistics.stateFailure = error.what();
  }
}

HierarchicalRadiosity::HierarchicalRadiosity(const Scene& scene, const ClusterTree& tree,
                                             const HierarchicalRadiosityOptions& options)
    : implementation_(new Implementation(scene, tree, options)) {}

HierarchicalRadiosity::~HierarchicalRadiosity() = default;

void HierarchicalRadiosity::Run(const ProgressCallback& progress,
                                const IterationObserver& observer) {
  Implementation& self = *implementation_;
  SolverStatistics& statistics = self.statistics;
  self.clock.Restart();
  const int usual = IterationsTo(FinalThreshold(self.options));

  // A resumed run stands at the border of the iteration that was its last.
  bool isResumed = !statistics.history.empty();
  double threshold = isResumed ? statistics.history.back().threshold : self.firstThreshold;
  double last = std::min(FinalThreshold(self.options), threshold);
  Verification verification(self.scene, self.options, kLinkPatience);
  verification.Recall(statistics.history);
  for (int iteration = std::max(1, int(statistics.history.size())); statistics.stoppedBy.empty();
       ++iteration, isResumed = false) {
    const Timer iterationTimer;
    const ProgressCallback part = [&](double fraction, const char* stage) {
      return Report(progress, LinkProgress(self.options, iteration - 1 + fraction, usual), stage);
    };
    if (!isResumed) {
      double change = 0;
      if (!self.RefineAndExchange(last, &threshold, &change, part)) {
        statistics.stoppedBy = self.isFull ? "memory" : "interrupt";
        break;
      }
      if (!statistics.history.empty()) self.before = statistics.history.back();
      statistics.history.push_back({iteration, self.Seconds(), threshold, self.hierarchy.Size(),
                                    self.network.Count(), self.network.rays, change});
    }

    // The border of an iteration: the only place where a run ends.
    self.SaveState();
    const bool goOn = (!observer || observer(statistics.history.back())) && part(1, "iterating");
    if (self.EndsHere(goOn)) break;

    // Links as fine as the request usually asks for: gather, or see whether they are good enough.
    if (threshold <= last && self.options.finalGather) {
      self.linkSolution.reset();
      const auto predicted = [&] {
        return PredictGatherSeconds(self.hierarchy, self.rayScene, self.light, self.FirstAim());
      };
      if (self.options.timeLimit > 0 && !self.HasTimeFor(predicted())) {
        statistics.stoppedBy = "time";
      } else if (!self.memory.HasRoomForGather()) {
        statistics.stoppedBy = "memory";
      } else {
        try {
          self.GatherUntilMet(progress, observer);
        } catch (const Cancelled&) {
          statistics.stoppedBy = "interrupt";
        }
      }
      break;
    }
    if (threshold <= last) {
      if (self.EndsVerified(&verification)) break;
      last = threshold * kThresholdFactor;
    }
    self.linkSolution.reset();
    if (!self.HasTimeFor(iterationTimer.Seconds())) statistics.stoppedBy = "time";
    const IterationRecord* before = self.before ? &*self.before : nullptr;
    if (!self.memory.HasRoomForIteration(before, statistics.history.back())) {
      statistics.stoppedBy = "memory";
    }
    threshold *= kThresholdFactor;
  }
  CountElementsAndLinks(self.hierarchy, self.network, &statistics);
  statistics.stages.Time("energy balance", [&] {
    MeasureEnergyBalance(self.hierarchy, self.network, self.light, self.rayScene, &statistics);
  });
}

// Refines links to `threshold`, not below `last`, and lets light bounce; where there is none to
// show, goes on at once. False, with the light as it was, where `progress` asked to stop or there
// is no room (isFull); room for the first iteration is not asked for.
bool HierarchicalRadiosity::Implementation::RefineAndExchange(double last, double* threshold,
                                                              double* change,
                                                              const ProgressCallback& progress) {
  const bool isInterleaved = options.schedule == Schedule::Interleaved;
  const auto tolerance = [&] { return *threshold <= last ? kLastSweepTolerance : kSweepTolerance; };
  const bool isFirst = statistics.history.empty() && !before;
  const RoomCallback hasRoom = [&](int64_t elements, int64_t links) {
    isFull = !isFirst && !memory.HasRoomFor(double(elements), double(links));
    return !isFull;
  };
  isFull = false;
  linkSolution.reset();
  for (;; *threshold *= kThresholdFactor) {
    *threshold = std::max(last, *threshold);
    bool isAgain = false;  // Then a run does not end here: only the first pass can be undone.
    do {
      oracle->Adapt(hierarchy, light);
      const bool isRefined = statistics.stages.Time("links", [&] {
        return RefineLinks(*threshold * received, *oracle, rayScene, &hierarchy, &light, &network,
                           isAgain ? ProgressCallback() : progress,
                           isAgain ? RoomCallback() : hasRoom);
      });
      if (!isRefined) return false;
      isAgain = true;
      delivered.reset();
      *change = this->Exchange(isInterleaved ? kOneSweep : tolerance());
    } while (isInterleaved && *threshold <= last && *change > kSweepTolerance);
    if (*threshold <= last || ReceivedPower(hierarchy, light) > 0) break;
  }
  statistics.stages.Time("exposure", [&] {
    SplitByExposure(kExposureThreshold * *threshold * received, rayScene, &hierarchy, &light,
                    &network, &exposures);
  });
  network.incoming.resize(size_t(hierarchy.Size()));
  this->Exchange(isInterleaved && *threshold > last ? kOneSweep : tolerance());
  received = std::max(received, ReceivedPower(hierarchy, light));
  return true;
}

// Bounces until they settle. Sampled row sums scatter about 1 without bias; where a loose bound on
// them lets light grow, tighter ones do not.
double HierarchicalRadiosity::Implementation::Exchange(double tolerance) {
  return statistics.stages.Time("exchange", [&] { return this->Bounce(tolerance); });
}

double HierarchicalRadiosity::Implementation::Bounce(double tolerance) {
  double change = 1;
  for (const float bound : {1.25f, 1.1f, 1.f, 0.7f}) {
    BoundRowSums(hierarchy, network, bound, &light);
    double changeBefore = std::numeric_limits<double>::max();
    for (int sweep = 0; sweep < kMaximumSweeps; ++sweep) {
      change = ExchangeLight(hierarchy, network, &light);
      if (change <= tolerance) return change;
      if (sweep % kGrowthSweeps != kGrowthSweeps - 1) continue;
      if (change >= changeBefore) break;
      changeBefore = change;
    }
  }
  return change;
}

// Whether the run was to end at the border of this iteration, or is not to go on.
bool HierarchicalRadiosity::Implementation::EndsHere(bool goOn) {
  const int done = statistics.history.back().iteration;
  if (options.iterations > 0 && done >= options.iterations) {
    statistics.stoppedBy = "iterations";
  } else if (!goOn) {
    statistics.stoppedBy = "interrupt";
  }
  return !statistics.stoppedBy.empty();
}

// Light at the points of the mesh by the links alone.
RadiositySolution HierarchicalRadiosity::Implementation::Reconstruct() {
  return statistics.stages.Time("reconstruction", [&] { return this->LightOfLinks(); });
}

RadiositySolution HierarchicalRadiosity::Implementation::LightOfLinks() {
  if (!linkSolution) {
    const bool keeps = options.keepsTransfers && memory.HasRoomToKeep(network.Count());
    linkSolution =
        std::make_unique<LinkSolution>(&hierarchy, network, light, rayScene, litSides, keeps);
    ++statistics.linkMeshes;
  }
  RadiositySolution solution = linkSolution->Deliver(&network.rays, &statistics.linkTransfers);
  if (!linkSolution->Keeps()) linkSolution.reset();
  return solution;
}

// Verifies what is delivered; true, with the reason, where that ends the run. Throws Cancelled.
bool HierarchicalRadiosity::Implementation::EndsVerified(Verification* verification,
                                                         const ProgressCallback& progress) {
  if (options.verificationPoints > 0) {
    if (!delivered) delivered = this->Reconstruct();
    ReturnFreedMemory();
    statistics.history.back().error = statistics.stages.Time(
        "verification", [&] { return verification->Measure(*delivered, progress); });
  }
  statistics.stoppedBy = verification->Verdict();
  return !statistics.stoppedBy.empty();
}

bool HierarchicalRadiosity::Relight() {
  // What light reaches, and what only emits, has to be what it was.
  Implementation& self = *implementation_;
  std::vector<uint8_t> emittingSides = EmittingSides(self.scene.mesh);
  if (emittingSides != self.emittingSides &&
      FindLitSides(self.scene, self.hierarchy.Tree(), self.rayScene, &self.network.rays) !=
          self.litSides) {
    return false;
  }
  if (!self.hierarchy.TakeMaterials()) return false;
  self.emittingSides = std::move(emittingSides);

  // The light of the links there are; a run begins where their refinement ended.
  self.Exchange(kLastSweepTolerance);
  self.received = std::max(SourcePower(self.scene), ReceivedPower(self.hierarchy, self.light));
  self.delivered.reset();
  if (self.linkSolution) self.linkSolution->TakeMaterials();
  if (!self.statistics.history.empty()) {
    self.firstThreshold = self.statistics.history.back().threshold;
    self.before = self.statistics.history.back();
  }
  self.secondsBefore = 0;
  self.statistics.history.clear();
  self.statistics.stages = {};
  self.statistics.stoppedBy.clear();
  CountElementsAndLinks(self.hierarchy, self.network, &self.statistics);
  return true;
}

RadiositySolution HierarchicalRadiosity::Solution() const {
  Implementation& self = *implementation_;
  return self.delivered ? *self.delivered : self.Reconstruct();
}

RadiositySolution HierarchicalRadiosity::TakeSolution() {
  Implementation& self = *implementation_;
  RadiositySolution solution = self.delivered ? std::move(*self.delivered) : self.Reconstruct();
  self.delivered.reset();
  return solution;
}

const SolverStatistics& HierarchicalRadiosity::Statistics() const {
  return implementation_->statistics;
}

}  // namespace lambert
