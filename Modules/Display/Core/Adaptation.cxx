#include "Display/Core/Adaptation.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "Common/Core/Error.h"
#include "Common/Core/TriangleMesh.h"

namespace lambert {
namespace {

/// Share of the lit area that may be brighter than full white.
constexpr double kBurntArea = 0.01;
/// Samples this much darker than the mean are shadow without light, not part of the scene's middle.
constexpr double kBlack = 1e-5;
/// Of the way to what was measured, in stops, that an update goes.
constexpr double kShareOfWay = 0.5;

bool Counts(const LuminanceSample& s) {
  return std::isfinite(s.luminance) && s.luminance > 0 && std::isfinite(s.weight) && s.weight > 0;
}

double WeightOf(const std::vector<LuminanceSample>& samples) {
  return std::accumulate(samples.begin(), samples.end(), 0.,
                         [](double sum, const auto& s) { return sum + s.weight; });
}

/// What is lit at all.
std::vector<LuminanceSample> LitOf(const std::vector<LuminanceSample>& samples) {
  std::vector<LuminanceSample> lit;
  std::copy_if(samples.begin(), samples.end(), std::back_inserter(lit), Counts);
  double sum = 0;
  for (const LuminanceSample& s : lit) sum += double(s.weight) * s.luminance;
  const double black = lit.empty() ? 0 : kBlack * sum / WeightOf(lit);
  lit.erase(std::remove_if(lit.begin(), lit.end(),
                           [&](const LuminanceSample& s) { return s.luminance <= black; }),
            lit.end());
  return lit;
}

/// `current` moved towards `target` by half of the stops between them, `most` at most.
double Approach(double current, double target, double most) {
  const double stops = kShareOfWay * std::log2(target / current);
  return current * std::exp2(std::clamp(stops, -most, most));
}

}  // namespace

std::vector<LuminanceSample> LuminanceSamples(const TriangleMesh& mesh,
                                              const std::vector<Spectrum>& radiosity) {
  std::vector<LuminanceSample> samples(radiosity.size());
  for (LuminanceSample& s : samples) s.weight = 0;
  for (size_t face = 0; face < mesh.triangles.size(); ++face) {
    if (!mesh.emittance.empty() && !mesh.emittance[face].IsBlack()) continue;
    const float third = mesh.Area(int64_t(face)) / 3;
    for (int32_t point : mesh.triangles[face]) samples[size_t(point)].weight += third;
  }
  for (size_t point = 0; point < radiosity.size(); ++point) {
    samples[point].luminance = Luminance(radiosity[point]);
  }
  return samples;
}

double LuminanceExceededBy(double share, const std::vector<LuminanceSample>& samples) {
  std::vector<LuminanceSample> lit = LitOf(samples);
  const double weight = WeightOf(lit);
  std::sort(lit.begin(), lit.end(),
            [](const auto& a, const auto& b) { return a.luminance > b.luminance; });
  double above = 0;
  for (const LuminanceSample& s : lit) {
    above += s.weight;
    if (above >= share * weight) return s.luminance;
  }
  return 0;
}

Adaptation MeasureAdaptation(const std::vector<LuminanceSample>& samples) {
  const std::vector<LuminanceSample> lit = LitOf(samples);
  if (lit.empty()) return {};
  double logSum = 0;
  for (const LuminanceSample& s : lit) logSum += s.weight * std::log(double(s.luminance));
  return {std::exp(logSum / WeightOf(lit)), LuminanceExceededBy(kBurntArea, samples)};
}

SteadyAdaptation::SteadyAdaptation(double mostStops) : mostStops_(mostStops) {
  if (!(mostStops > 0) || !std::isfinite(mostStops)) {
    throw Error("A steady adaptation moves by more than 0 stops an update.");
  }
}

const Adaptation& SteadyAdaptation::Follow(const Adaptation& measured) {
  if (!(measured.average > 0)) return current_;
  if (!(current_.average > 0)) return current_ = measured;
  current_.average = Approach(current_.average, measured.average, mostStops_);
  current_.bright = Approach(current_.bright, measured.bright, mostStops_);
  return current_;
}

}  // namespace lambert
