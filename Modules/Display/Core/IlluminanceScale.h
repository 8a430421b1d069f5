// Illuminance in the units of lighting design, and scales that are read in round numbers.
#pragma once

#include <vector>

#include "Common/Core/Spectrum.h"
#include "Common/Core/TriangleMesh.h"

namespace lambert {

enum class IlluminanceUnit {
  Lux,                 ///< 683 lm/W times the next
  WattsPerSquareMetre  ///< irradiance, bands weighted as luminance weighs them
};

/// Of irradiance in W/m2.
float Illuminance(const Spectrum& irradiance, IlluminanceUnit unit);

/// From `low` to `high` in equal steps; labels and isolines stand at the levels.
struct IlluminanceScale {
  double low = 0, high = 1;
  std::vector<double> levels;  ///< low and high among them
};

/// `steps` of 1 or more, or 0: as many as are round, 4 to 6. Throws Error where the range is empty
/// or not finite.
IlluminanceScale MakeIlluminanceScale(double low, double high, int steps = 0);

/// From 0 to a round number that a twentieth of the lit area of faces that do not emit is above at
/// most. `irradiance` is per point, W/m2. Without light: to 1.
IlluminanceScale ScaleOf(const TriangleMesh& mesh, const std::vector<Spectrum>& irradiance,
                         IlluminanceUnit unit, int steps = 0);

}  // namespace lambert
