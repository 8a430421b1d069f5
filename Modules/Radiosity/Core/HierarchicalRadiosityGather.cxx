// The final gather of HierarchicalRadiosity: gathers and rounds of cuts, until the error is
// verified.
#include <algorithm>
#include <cmath>

#include "Common/Core/MemoryCeiling.h"
#include "Radiosity/Core/HierarchicalRadiosityImplementation.h"

namespace lambert {

namespace {

/// Gathers, each with its rounds of cuts, before it is said that the error cannot be met.
constexpr int kMostGathers = 4;
/// One before them, with the fewest rounds, aims at so many times the wanted error.
constexpr double kTriedAim = 1.4;
/// Gathers in a row that gain too little before a run gives up.
constexpr int kGatherPatience = 1;
/// The next gather aims this far below the wanted error.
constexpr double kAimBelow = 0.85;
/// The first round of cuts takes at most about this part of the time of the gather before it, a
/// later one up to so many times as long as the one before.
constexpr double kFirstRound = 0.75, kRoundGrowth = 1.5;
/// What interpolation may leave, of the error that a gather aims at; and the rounds of cutting it
/// takes.
constexpr double kInterpolationShare = 0.65;
constexpr int kCuttingRounds = 5;
/// Rounds after which one may be enough: the first finds small shadows, the second cuts along them.
constexpr int kLeastRounds = 2;

}  // namespace

// Where somebody looks at what a first gather gives, and rounds may follow.
bool HierarchicalRadiosity::Implementation::HasTry() const {
  return options.cutsTriangles && options.verificationPoints > 0;
}

double HierarchicalRadiosity::Implementation::FirstAim() const {
  return this->HasTry() ? std::min(1.0, kTriedAim * options.error) : options.error;
}

// Whether what is delivered is good enough before all rounds of cuts are made. Throws Cancelled.
bool HierarchicalRadiosity::Implementation::IsSurelyMet(Verification* verification,
                                                        const ProgressCallback& progress) {
  ReturnFreedMemory();  // Verification takes the most.
  const bool isMet = statistics.stages.Time("verification", [&] {
    return verification->IsSurelyMet(*delivered, network.rays, progress);
  });
  statistics.history.back().error = verification->Error();
  return isMet;
}

// The border of an iteration of the gather; true where the run ends there, or has no time for
// another that takes `next` seconds.
bool HierarchicalRadiosity::Implementation::EndsAfterRound(double next,
                                                           const IterationObserver& observer) {
  IterationRecord record = statistics.history.back();
  ++record.iteration;
  record.seconds = this->Seconds();
  record.rays = network.rays;
  record.error = -1;
  statistics.history.push_back(record);
  const bool goOn = !observer || observer(record);
  if (this->EndsHere(goOn)) return true;
  if (!this->HasTimeFor(next)) statistics.stoppedBy = "time";
  if (!memory.HasRoomForCuts(*delivered)) statistics.stoppedBy = "memory";
  return !statistics.stoppedBy.empty();
}

// Gathers at the points in round 0, and cuts triangles in every other; false where nothing is left
// to cut. Throws Cancelled.
bool HierarchicalRadiosity::Implementation::GatherRound(std::optional<GatheredSolution>* solution,
                                                        double aim, int round,
                                                        const ProgressCallback& progress) {
  if (round > 0) {
    const bool isCut = statistics.stages.Time(
        "cuts", [&] { return (*solution)->Cut(kInterpolationShare * aim, progress); });
    if (isCut) delivered = (*solution)->Deliver();
    return isCut;
  }
  const GatheredSolutionOptions gather = GatherFor(aim);
  if (*solution) {
    statistics.stages.Time("gather at points",
                           [&] { (*solution)->Improve(gather.points, progress); });
  } else {
    statistics.stages.Time("gather at leaves", [&] {
      solution->emplace(&hierarchy, &light, rayScene, litSides, gather, &network.rays);
    });
    statistics.stages.Time("gather at points", [&] { (*solution)->Gather(progress); });
  }
  delivered = (*solution)->Deliver();
  return true;
}

// A final gather, on a finer and finer mesh, until the error that was asked for is verified. Each
// gather and each round of cuts is an iteration. The first gather only aims near what is asked for,
// and often gives it all the same: a look tells. Throws Cancelled.
void HierarchicalRadiosity::Implementation::GatherUntilMet(const ProgressCallback& progress,
                                                           const IterationObserver& observer) {
  Verification verification(scene, options, kGatherPatience);
  std::optional<GatheredSolution> solution;
  double aim = this->FirstAim(), secondsOfGather = 0;
  int cuts = 0;
  const int gathers = kMostGathers + (this->HasTry() ? 1 : 0);
  for (int gather = 1; gather <= gathers; ++gather) {
    const bool isTry = this->HasTry() && gather == 1;
    const int rounds = !options.cutsTriangles ? 0 : isTry ? kLeastRounds : kCuttingRounds;
    double done = 0;
    const ProgressCallback part = [&](double fraction, const char* stage) {
      const double all = (gather - 1 + (done + fraction) / (rounds + 1)) / gathers;
      return Report(progress, 1 - kGatherShare * (1 - std::min(1.0, all)), stage);
    };
    const ProgressCallback border = [&](double, const char* stage) { return part(0, stage); };
    bool isSurelyMet = false;
    for (int round = 0; round <= rounds && !isSurelyMet; ++round) {
      const Timer roundTimer;
      const bool isNew = this->GatherRound(&solution, aim, round, part);
      done = round + 1;
      if (round == 0) secondsOfGather = std::max(secondsOfGather, roundTimer.Seconds());
      const double next =
          round == 0 ? kFirstRound * secondsOfGather : kRoundGrowth * roundTimer.Seconds();
      if (isNew && this->EndsAfterRound(next, observer)) return;
      if (isNew && round > 0) ++cuts;

      // A look, where something may follow.
      const bool isLast = !isTry && (round == rounds || !isNew);
      const bool mayBeEnough = cuts >= kLeastRounds || !isNew;
      isSurelyMet = mayBeEnough && !isLast && this->IsSurelyMet(&verification, border);
      if (!isNew) break;
    }
    if (isTry && !isSurelyMet && this->HasTimeFor(secondsOfGather)) {
      aim = options.error;
      continue;
    }
    if (this->EndsVerified(&verification, border)) return;
    if (!this->HasTimeFor(secondsOfGather)) {
      statistics.stoppedBy = "time";
      return;
    }
    // More rays take away no more than their scatter.
    const double scatter = NoiseFor(aim), error = verification.Error();
    if (solution->IsFull() && std::hypot(options.error, scatter) < error) break;
    aim *= std::min(0.8, std::max(0.35, kAimBelow * options.error / error));
  }
  statistics.stoppedBy = "floor";
}

}  // namespace lambert
