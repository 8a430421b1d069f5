// How far a solution is from the truth, as the contract defines it: relative RMS error of delivered
// irradiance.
#pragma once

#include <cstdint>

#include "Common/Core/Progress.h"
#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"

namespace lambert {

struct SolutionErrorOptions {
  int points = 2000;   ///< receiver points, stratified by area over every side of every face that
                       ///< does not emit
  int samples = 1024;  ///< paths a point
  uint64_t seed = 1;
};

/// Errors are fractions; confidence intervals are 95 % bootstrap.
struct SolutionError {
  double rms = 0, rmsLow = 0, rmsHigh = 0;  ///< the reference's own noise estimated and subtracted
  double bounded = 0;                       ///< bounded error of the contract
  double bias = 0;                          ///< signed: (mean E - mean Eref) / mean Eref
  double percentile95 = 0;                  ///< of the pointwise relative error
  int64_t points = 0;                       ///< receiving points that counted
};

/// Compares the irradiance that `solution` delivers (interpolated from its vertices) with a path
/// trace of `scene`. A side that the solution does not model counts with 0 where the reference
/// finds light there.
SolutionError MeasureSolutionError(const Scene& scene, const RadiositySolution& solution,
                                   const SolutionErrorOptions& options = {},
                                   const ProgressCallback& progress = {});

}  // namespace lambert
