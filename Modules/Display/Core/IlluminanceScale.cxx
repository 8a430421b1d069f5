#include "Display/Core/IlluminanceScale.h"

#include <cmath>

#include "Common/Core/Error.h"
#include "Display/Core/Adaptation.h"

namespace lambert {
namespace {

/// Of the lit area, that may be above the scale.
constexpr double kAbove = 0.05;

/// Two digits at most, the second of them 0 or 5.
bool IsRound(double step) {
  const double halves = 2 * step / std::pow(10, std::floor(std::log10(step)));
  return std::abs(halves - std::round(halves)) < 1e-6;
}

/// The next round number from `value` above 0 upwards.
double RoundUp(double value) {
  const double decade = std::pow(10, std::floor(std::log10(value)));
  for (const double mantissa : {1., 1.5, 2., 3., 4., 5., 6., 8.}) {
    if (value <= mantissa * decade * (1 + 1e-9)) return mantissa * decade;
  }
  return 10 * decade;
}

int RoundSteps(double range) {
  for (const int steps : {5, 4, 6}) {
    if (IsRound(range / steps)) return steps;
  }
  return 5;
}

}  // namespace

float Illuminance(const Spectrum& irradiance, IlluminanceUnit unit) {
  return unit == IlluminanceUnit::Lux ? Lux(irradiance) : Luminance(irradiance);
}

IlluminanceScale MakeIlluminanceScale(double low, double high, int steps) {
  if (!(high > low) || !std::isfinite(high - low) || steps < 0) {
    throw Error("A scale of illuminance goes from a number up to a larger one.");
  }
  const int count = steps > 0 ? steps : RoundSteps(high - low);
  IlluminanceScale scale{low, high, {}};
  for (int i = 0; i <= count; ++i) scale.levels.push_back(low + (high - low) * i / count);
  return scale;
}

IlluminanceScale ScaleOf(const TriangleMesh& mesh, const std::vector<Spectrum>& irradiance,
                         IlluminanceUnit unit, int steps) {
  const double perWatt = Illuminance(Spectrum(1), unit);
  const double bright = perWatt * LuminanceExceededBy(kAbove, LuminanceSamples(mesh, irradiance));
  return MakeIlluminanceScale(0, bright > 0 ? RoundUp(bright) : 1, steps);
}

}  // namespace lambert
