#include "Radiosity/Core/MiddleTrends.h"

#include <algorithm>
#include <cmath>

namespace lambert {

namespace {

/// Relative errors below this are alike.
constexpr double kLeastError = 1e-4;
/// Fewer tell nothing.
constexpr double kFewest = 8;

}  // namespace

MiddleTrends::Kind MiddleTrends::KindOf(double area, double error, bool isNew) {
  return {std::ilogb(area), std::ilogb(std::max(kLeastError * kLeastError, error)) / 2, isNew};
}

void MiddleTrends::Add(const Kind& kind, double irradiance, double expected) {
  Sum& sum = sums_[kind];
  sum.count += 1;
  sum.irradiance += irradiance;
  sum.expected += expected;
  sum.irradianceSquares += irradiance * irradiance;
  sum.expectedSquares += expected * expected;
  sum.products += irradiance * expected;
}

// James and Stein's: what is found times the part of its square that is more than its variance.
double MiddleTrends::Of(const Kind& kind) const {
  const auto found = sums_.find(kind);
  if (found == sums_.end() || found->second.count < kFewest) return 0;
  const Sum& sum = found->second;
  if (!(sum.expected > 0)) return 0;
  const double ratio = sum.irradiance / sum.expected, trend = ratio - 1;
  const double rest =
      sum.irradianceSquares - 2 * ratio * sum.products + ratio * ratio * sum.expectedSquares;
  const double variance = std::max(0.0, rest) / (sum.expected * sum.expected);
  return trend * trend > variance ? trend - variance / trend : 0;
}

}  // namespace lambert
