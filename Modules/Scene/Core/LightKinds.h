// Makers of the kinds of lights, each in a file of its own.
#pragma once

#include <memory>

#include "Scene/Core/LightSource.h"

namespace lambert {

/// A direction to a round light about the unit vector `axis` whose edge is at an angle of sine
/// `sine`: equal parts of what it shows to a facet that faces it for equal parts of `u`. Writes the
/// cosine to the axis.
inline Vec3f TowardDisc(const Vec3f& axis, float sine, const Vec2f& u, float* cosine) {
  const float radius = sine * std::sqrt(u.x), angle = float(2 * kPi) * u.y;
  *cosine = std::sqrt(1 - radius * radius);
  Vec3f s, t;
  CoordinateSystem(axis, &s, &t);
  return s * (radius * std::cos(angle)) + t * (radius * std::sin(angle)) + axis * *cosine;
}
/// Rays that show of a round light to a few hundredths how much of it is hidden.
constexpr int kSamplesOfDisc = 16;

/// The irradiance of a hemisphere of the largest radiance, per unit of the mean of all directions.
inline float HemisphereTransfer(const Spectrum& largest, const Spectrum& mean) {
  float ratio = 0;
  for (int band = 0; band < 3; ++band) {
    if (mean[band] > 0) ratio = std::max(ratio, largest[band] / mean[band]);
  }
  return float(kPi) * ratio;
}

std::unique_ptr<LightSource> MakeLamp(const Light& light);  ///< point, spot
std::unique_ptr<LightSource> MakeSun(const Light& light);   ///< directional
std::unique_ptr<LightSource> MakeEnvironment(const Light& light);
std::unique_ptr<LightSource> MakeGradientSky(const Light& light);
std::unique_ptr<LightSource> MakeSky(const Light& light);  ///< constant

}  // namespace lambert
