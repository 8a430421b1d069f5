#include "Visibility/Core/LampBalance.h"

#include <algorithm>
#include <cmath>

#include "Common/Core/Random.h"

namespace lambert {

namespace {

constexpr int kRays = 4096;

}  // namespace

LampBalance MeasureLampBalance(const LightSource& lamp, const RayScene& rays) {
  constexpr double kSolidAngle = 4 * kPi / kRays;
  Random random(7);
  SpectrumSum emitted, escaped;
  for (int i = 0; i < kRays; ++i) {
    const float z = 1 - 2 * (float(i) + random.Uniform()) / kRays;
    const float phi = float(2 * kPi) * random.Uniform(), s = std::sqrt(std::max(0.f, 1 - z * z));
    const Vec3f direction(s * std::cos(phi), s * std::sin(phi), z);
    const Spectrum intensity = lamp.Intensity(direction);
    if (intensity.IsBlack()) continue;
    emitted.Add(intensity, kSolidAngle);
    if (rays.OccludedDirection(lamp.Position(), direction)) continue;
    escaped.Add(intensity, kSolidAngle);
  }
  return {emitted.Total(), escaped.Total()};
}

}  // namespace lambert
