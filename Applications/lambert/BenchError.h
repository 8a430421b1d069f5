// The error of light delivered at points whose true light is known with noise.
#pragma once

#include <vector>

#include "Reference/Core/PathTracedIrradiance.h"
#include "Reference/Core/SolutionError.h"

namespace lambert {

/// Errors as SolutionError defines them, of `delivered` (W/m2) against `reference`, one a point;
/// the reference's noise is subtracted, intervals are 95 % bootstrap.
SolutionError SummarizeError(const std::vector<Spectrum>& delivered,
                             const std::vector<IrradianceEstimate>& reference);

}  // namespace lambert
