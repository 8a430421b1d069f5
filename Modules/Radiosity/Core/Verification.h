// Whether what is delivered is what was asked for: measured against a path trace time and again,
// until it is or gets no better.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "Common/Core/Progress.h"
#include "Reference/Core/ErrorPoints.h"
#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"

namespace lambert {

struct HierarchicalRadiosityOptions;

class Verification {
 public:
  /// Gives up after `patience` attempts in a row that gain too little. All by reference.
  Verification(const Scene& scene, const HierarchicalRadiosityOptions& options, int patience)
      : scene_(scene), options_(options), patience_(patience) {}

  /// Error of `solution`, the one that counts, at points of its own for every attempt. Throws
  /// Cancelled.
  double Measure(const RadiositySolution& solution, const ProgressCallback& progress = {});
  /// Whether the error of `solution`, the one that counts, is the wanted one, and the rms even at
  /// the upper end of its interval; or is far below. At the points of the next attempt, of which
  /// there are more where `rays` that the solution took can pay for them. Throws Cancelled.
  bool IsSurelyMet(const RadiositySolution& solution, int64_t rays,
                   const ProgressCallback& progress = {});
  /// Counts the attempts that a history tells of as made.
  void Recall(const std::vector<IterationRecord>& history);

  double Error() const { return error_; }  ///< as it was last measured or looked at
  /// Why to stop: "error" or "floor"; empty: go on. What is not verified counts as met.
  std::string Verdict() const;

 private:
  ErrorPoints& Points();
  double Below() const;  ///< where an error counts as met
  void Note(double error);

  const Scene& scene_;
  const HierarchicalRadiosityOptions& options_;
  const int patience_;
  int attempts_ = 0, idle_ = 0;
  double error_ = -1, best_ = 0;
  std::optional<ErrorPoints> points_;  ///< of the next attempt, once something was looked at
};

}  // namespace lambert
