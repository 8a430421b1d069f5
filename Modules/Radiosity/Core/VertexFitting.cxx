#include "Radiosity/Core/VertexFitting.h"

#include <algorithm>

namespace lambert {

namespace {

/// Parts of a triangle's area that one of its corners and its middle stand for.
constexpr float kCorner = 1.f / 12, kMiddle = 3.f / 4;
/// Rounds, and the part of the way to what each alone would ask for.
constexpr int kRounds = 12;
constexpr float kStep = 0.6f;

}  // namespace

std::vector<Spectrum> FitVertices(const std::vector<Spectrum>& irradiance,
                                  const std::vector<FittedTriangle>& triangles) {
  // What each point may become, and how much it counts for.
  std::vector<Spectrum> least = irradiance, most = irradiance, fitted = irradiance;
  std::vector<float> weight(irradiance.size(), 0);
  for (const FittedTriangle& t : triangles) {
    for (const int32_t p : t.points) {
      weight[size_t(p)] += t.area * (kCorner + kMiddle / 9);
      for (int band = 0; band < 3; ++band) {
        least[size_t(p)][band] = std::min(least[size_t(p)][band], t.middle[band]);
        most[size_t(p)][band] = std::max(most[size_t(p)][band], t.middle[band]);
      }
    }
  }

  std::vector<Spectrum> slope(irradiance.size());
  for (int round = 0; round < kRounds; ++round) {
    std::fill(slope.begin(), slope.end(), Spectrum());
    for (const FittedTriangle& t : triangles) {
      Spectrum off = t.middle * -1.f;
      for (const int32_t p : t.points) off += fitted[size_t(p)] / 3.f;
      for (const int32_t p : t.points) {
        slope[size_t(p)] +=
            ((fitted[size_t(p)] - irradiance[size_t(p)]) * kCorner + off * (kMiddle / 3)) * t.area;
      }
    }
    for (size_t p = 0; p < fitted.size(); ++p) {
      if (!(weight[p] > 0)) continue;
      fitted[p] += slope[p] * (-kStep / weight[p]);
      for (int band = 0; band < 3; ++band) {
        fitted[p][band] = std::min(most[p][band], std::max(least[p][band], fitted[p][band]));
      }
    }
  }
  return fitted;
}

}  // namespace lambert
