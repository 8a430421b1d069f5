#include "Display/Core/ToneMapping.h"

#include <algorithm>
#include <cmath>

#include "Common/Core/Error.h"

namespace lambert {
namespace {

/// Luminance, cd/m2, that a meter at ISO 100 reads as exposure value 0: K = 12.5 (iso2720).
constexpr double kMeterConstant = 12.5 / 100;

/// Keyed luminance of a unit of luminance, before the stops of the exposure.
double KeyedScale(const Adaptation& adaptation, const ToneMappingOptions& options) {
  // A camera: radiosity of 1 W/m2 leaves as 683 / pi cd/m2.
  if (options.exposureValue) {
    return options.key * (kLumensPerWatt / kPi) /
           (kMeterConstant * std::exp2(*options.exposureValue));
  }
  // An eye: the log-average is brought to the key (reinhard2002 eq. 2).
  return adaptation.average > 0 ? options.key / adaptation.average : 0;
}

Spectrum Encode(const Spectrum& display) {
  Spectrum encoded;
  for (int band = 0; band < 3; ++band) {
    encoded[band] = SrgbFromLinear(std::clamp(display[band], 0.f, 1.f));
  }
  return encoded;
}

}  // namespace

ToneMapping::ToneMapping(const Adaptation& adaptation, const ToneMappingOptions& options)
    : curve_(options.curve) {
  if (!(options.key > 0) || !std::isfinite(options.key) || !std::isfinite(options.exposure) ||
      !(options.white >= 0) || !std::isfinite(options.exposureValue.value_or(0))) {
    throw Error(
        "Tone mapping needs a key above 0, a finite exposure and a white point of 0 or more.");
  }
  scale_ = KeyedScale(adaptation, options) * std::exp2(options.exposure);

  // Full white: wanted, of film, or what all but a hundredth of the lit area stays below. Never
  // below 1, where the photographic curve would brighten instead of compress.
  white_ = options.white > 0             ? options.white
           : curve_ == ToneCurve::Filmic ? kFilmicWhite
                                         : std::max(1., scale_ * adaptation.bright);
}

Spectrum ToneMapping::Apply(const Spectrum& light) const {
  const double luminance = scale_ * Luminance(light);
  if (!light.IsFinite() || !(luminance > 0)) return {};

  // Film answers to each band.
  if (curve_ == ToneCurve::Filmic) {
    Spectrum display;
    for (int band = 0; band < 3; ++band) {
      display[band] = float(EvaluateToneCurve(curve_, std::max(0., scale_ * light[band]), white_));
    }
    return Encode(display);
  }

  // The others compress luminance and keep the ratios of the bands.
  return Encode(light * float(scale_ * EvaluateToneCurve(curve_, luminance, white_) / luminance));
}

Spectrum ToneMapping::Apply(const Spectrum& light, double surround) const {
  const double luminance = scale_ * Luminance(light);
  if (!light.IsFinite() || !(luminance > 0)) return {};
  const double display = PhotographicCurve(luminance, scale_ * surround, white_);
  return Encode(light * float(scale_ * display / luminance));
}

std::array<uint8_t, 3> ToneMapping::Codes(const Spectrum& display) {
  std::array<uint8_t, 3> codes;
  for (int band = 0; band < 3; ++band) {
    codes[size_t(band)] = uint8_t(std::lround(std::min(1.f, display[band]) * 255));
  }
  return codes;
}

}  // namespace lambert
