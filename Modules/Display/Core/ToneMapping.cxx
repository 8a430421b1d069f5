#include "Display/Core/ToneMapping.h"

#include <algorithm>
#include <cmath>

#include "Common/Core/Error.h"
#include "Common/Core/TriangleMesh.h"

namespace lambert {
namespace {

/// Share of the lit area that may be brighter than full white.
constexpr double kBurntArea = 0.01;
/// Samples this much darker than the mean are shadow without light, not part of the scene's middle.
constexpr double kBlack = 1e-5;

bool Counts(const LuminanceSample& s) {
  return std::isfinite(s.luminance) && s.luminance > 0 && std::isfinite(s.weight) && s.weight > 0;
}

/// Luminance below which all but `share` of the weight lies.
double UpperQuantile(std::vector<LuminanceSample> samples, double weight, double share) {
  std::sort(samples.begin(), samples.end(),
            [](const auto& a, const auto& b) { return a.luminance > b.luminance; });
  double above = 0;
  for (const LuminanceSample& s : samples) {
    above += s.weight;
    if (above >= share * weight) return s.luminance;
  }
  return 0;
}

}  // namespace

ToneMapping::ToneMapping(const std::vector<LuminanceSample>& samples,
                         const ToneMappingOptions& options) {
  if (!(options.key > 0) || !std::isfinite(options.key) || !std::isfinite(options.exposure) ||
      !(options.white >= 0)) {
    throw Error(
        "Tone mapping needs a key above 0, a finite exposure and a white point of 0 or more.");
  }

  // What is lit at all.
  double weight = 0, sum = 0;
  for (const LuminanceSample& s : samples) {
    if (!Counts(s)) continue;
    weight += s.weight;
    sum += double(s.weight) * s.luminance;
  }
  if (!(sum > 0)) return;
  const double black = kBlack * sum / weight;
  std::vector<LuminanceSample> lit;
  std::copy_if(samples.begin(), samples.end(), std::back_inserter(lit),
               [&](const LuminanceSample& s) { return Counts(s) && s.luminance > black; });

  // Log-average luminance (Reinhard et al. 2002, eq. 1) and the key it is brought to (eq. 2).
  double litWeight = 0, logSum = 0;
  for (const LuminanceSample& s : lit) {
    litWeight += s.weight;
    logSum += s.weight * std::log(double(s.luminance));
  }
  scale_ = options.key * std::exp2(options.exposure) / std::exp(logSum / litWeight);

  // Full white: wanted, or what all but a hundredth of the lit area stays below. Never below 1,
  // where the curve would brighten instead of compress.
  white_ = options.white > 0 ? options.white
                             : std::max(1., scale_ * UpperQuantile(lit, litWeight, kBurntArea));
}

Spectrum ToneMapping::Apply(const Spectrum& light) const {
  const double luminance = scale_ * Luminance(light);
  if (!light.IsFinite() || !(luminance > 0)) return {};

  // Compress luminance (Reinhard et al. 2002, eq. 4), keep the ratios of the bands, clip, encode.
  const double compressed = (1 + luminance / (white_ * white_)) / (1 + luminance);
  Spectrum display;
  for (int band = 0; band < 3; ++band) {
    const double value = scale_ * light[band] * compressed;
    display[band] = SrgbFromLinear(float(std::min(1., std::max(0., value))));
  }
  return display;
}

std::array<uint8_t, 3> ToneMapping::ApplyToBytes(const Spectrum& light) const {
  const Spectrum display = Apply(light);
  std::array<uint8_t, 3> codes;
  for (int band = 0; band < 3; ++band) {
    codes[size_t(band)] = uint8_t(std::lround(std::min(1.f, display[band]) * 255));
  }
  return codes;
}

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

}  // namespace lambert
