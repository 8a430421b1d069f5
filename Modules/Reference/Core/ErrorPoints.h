// Points at which solutions of one scene are compared with the truth, which is traced once.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "Common/Core/Progress.h"
#include "Reference/Core/SolutionError.h"
#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"

namespace lambert {

class SolutionLookup;

/// Construct, then Measure one solution after the other. All have to model the same
/// sides of the faces: what is dark on those that the first leaves out is not asked again.
class ErrorPoints {
 public:
  /// A place on one side of a face.
  struct Place {
    int32_t face;
    Side side;
    ReceiverPoint receiver;
  };

  /// What tells that an error is known well enough.
  using Judge = std::function<bool(const SolutionError&)>;

  /// `scene` by reference. `options.growth` and `options.enough` do not count.
  ErrorPoints(const Scene& scene, const SolutionErrorOptions& options)
      : scene_(scene), options_(options), draw_(options) {}

  /// The figures of `solution` at the points there are, at first `options.points`; with more paths
  /// or points, up to `growth` times those of the options, where they do not decide, until the
  /// judge, if there is one, is content. Throws Cancelled.
  SolutionError Measure(const RadiositySolution& solution, int growth = 1,
                        const Judge& isEnough = {}, const ProgressCallback& progress = {});

  /// The receiving points so far, what the last solution delivered there, W/m2, and the truth.
  const std::vector<Place>& Places() const { return places_; }
  const std::vector<Spectrum>& Delivered() const { return delivered_; }
  const std::vector<IrradianceEstimate>& Truth() const { return truth_; }

 private:
  void Draw(const SolutionLookup& lookup, const ProgressCallback& progress);
  SolutionError Compare(const SolutionLookup& lookup);
  bool Grow(const SolutionError& error, int growth);

  const Scene& scene_;
  const SolutionErrorOptions options_;
  SolutionErrorOptions draw_;  ///< of the batch that is drawn next
  uint64_t batches_ = 0;
  std::vector<Place> places_;
  std::vector<Spectrum> delivered_;
  std::vector<IrradianceEstimate> truth_;
  int64_t drawn_ = 0;
};

}  // namespace lambert
