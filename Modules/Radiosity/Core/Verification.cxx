#include "Radiosity/Core/Verification.h"

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
/// Up to so many times as many paths where those leave it open whether the request is met, in the
/// end and at a look before.
constexpr int kVerificationGrowth = 16, kLookGrowth = 4;

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

double Verification::Measure(const RadiositySolution& solution) {
  const int growth = options_.timeLimit > 0 ? 1 : kVerificationGrowth;
  const auto isMet = [&](const SolutionError& e) { return e.Counting() <= this->Below(); };
  this->Note(this->Points().Measure(solution, growth, isMet).Counting());
  points_.reset();
  return error_;
}

// More points take less time than another round, and tell of all that follow. Where the interval of
// the rms leaves it open there are some more; where only its width keeps the rms from counting, as
// many as in the end.
bool Verification::IsSurelyMet(const RadiositySolution& solution) {
  const auto isMet = [&](const SolutionError& e) { return e.rmsHigh <= options_.error; };
  const auto isSure = [&](const SolutionError& e) {
    return isMet(e) && e.Counting() <= this->Below();
  };
  const auto isDecided = [&](const SolutionError& e) {
    return isMet(e) || e.rmsLow > this->Below();
  };
  const bool hasTime = !(options_.timeLimit > 0);
  SolutionError error = this->Points().Measure(solution, hasTime ? kLookGrowth : 1, isDecided);
  if (hasTime && isMet(error)) {
    const auto isKnown = [&](const SolutionError& e) { return isSure(e) || !isMet(e); };
    error = this->Points().Measure(solution, kVerificationGrowth, isKnown);
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
