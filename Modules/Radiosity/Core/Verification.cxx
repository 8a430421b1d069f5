#include "Radiosity/Core/Verification.h"

#include <algorithm>

#include "Common/Core/Random.h"
#include "Radiosity/Core/HierarchicalRadiosity.h"

namespace lambert {

namespace {

/// What the error must fall to for another attempt to be worth it.
constexpr double kLeastGain = 0.9;
/// An error counts as met a little below the request: the points that verify it are a sample.
constexpr double kVerifiedBelow = 0.95;
/// Paths a point.
constexpr int kVerificationSamples = 256;
/// At this part of the request it is met, however wide the interval of the rms is.
constexpr double kClearlyBelow = 0.8;
/// Up to so many times as many paths where those leave it open whether the request is met; fewer
/// where a look before the end does.
constexpr int kVerificationGrowth = 16, kLookGrowth = 4;
/// Rays that a path takes, about. At a look they are no more than half of those that the solution
/// took, or as many where they would be asked for in the end.
constexpr double kRaysOfPath = 8;

}  // namespace

// Another set of points for each attempt, or the second would be chosen by the first.
ErrorPoints& Verification::Points() {
  if (points_) return *points_;
  SolutionErrorOptions verification;
  verification.points = options_.verificationPoints;
  verification.samples = kVerificationSamples;
  verification.seed = HashBits(0x76657269u, uint64_t(attempts_) + 1);
  return points_.emplace(scene_, verification);
}

double Verification::Measure(const RadiositySolution& solution, const ProgressCallback& progress) {
  const int growth = options_.timeLimit > 0 ? 1 : kVerificationGrowth;
  const auto isMet = [&](const SolutionError& e) { return e.Counting() <= this->Below(); };
  this->Note(this->Points().Measure(solution, growth, isMet, progress).Counting());
  points_.reset();
  return error_;
}

// More points may take less time than another round, and tell of all that follow. Where the request
// lies within a wide interval of the rms there are some more; where only its width keeps the rms
// from counting, as many as in the end.
bool Verification::IsSurelyMet(const RadiositySolution& solution, int64_t rays,
                               const ProgressCallback& progress) {
  const auto isMet = [&](const SolutionError& e) { return e.rmsHigh <= options_.error; };
  const auto isSure = [&](const SolutionError& e) {
    const double error = e.Counting();
    return isMet(e) ? error <= this->Below() : error <= kClearlyBelow * options_.error;
  };
  const auto isDecided = [&](const SolutionError& e) {
    return isSure(e) || isMet(e) || e.rmsLow > this->Below();
  };
  const auto isKnown = [&](const SolutionError& e) { return isSure(e) || !isMet(e); };
  const double paths = double(options_.verificationPoints) * kVerificationSamples;
  const auto growth = [&](double share, int most) {
    const double affordable = share * double(rays) / (kRaysOfPath * paths);
    return options_.timeLimit > 0 ? 1 : int(std::clamp(affordable, 1., double(most)));
  };
  SolutionError error =
      this->Points().Measure(solution, growth(0.5, kLookGrowth), isDecided, progress);
  if (!isKnown(error)) {
    error = this->Points().Measure(solution, growth(1, kVerificationGrowth), isKnown, progress);
  }
  error_ = error.Counting();
  return isSure(error);
}

double Verification::Below() const { return kVerifiedBelow * options_.error; }

void Verification::Recall(const std::vector<IterationRecord>& history) {
  for (const IterationRecord& record : history) {
    if (record.error >= 0) this->Note(record.error);
  }
}

std::string Verification::Verdict() const {
  if (error_ <= this->Below()) return "error";
  return idle_ >= patience_ ? "floor" : "";
}

void Verification::Note(double error) {
  error_ = error;
  const bool isBetter = ++attempts_ == 1 || error_ <= kLeastGain * best_;
  if (isBetter) best_ = error_;
  idle_ = isBetter ? 0 : idle_ + 1;
}

}  // namespace lambert
