// Light at the points of a mesh that interpolates best, not only at the points themselves.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "Common/Core/Spectrum.h"

namespace lambert {

/// A triangle whose light is known at its corners and in its middle.
struct FittedTriangle {
  std::array<int32_t, 3> points;
  float area;       ///< m2
  Spectrum middle;  ///< irradiance there, W/m2
};

/// Irradiance at the points whose linear interpolation is nearest in the least squares to what is
/// known at them, `irradiance` (W/m2), and in the middles (kavan2011, with the quadrature that is
/// exact for quadratics): interpolation between exact values falls short of every bump. No point
/// leaves the range of its own value and of the middles about it, so that edges of light do not
/// overshoot.
std::vector<Spectrum> FitVertices(const std::vector<Spectrum>& irradiance,
                                  const std::vector<FittedTriangle>& triangles);

}  // namespace lambert
