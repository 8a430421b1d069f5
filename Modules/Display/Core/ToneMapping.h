// From linear light to display codes: exposure, a tone curve and the sRGB transfer curve (thesis
// 6.4.1). The only place where light stops being linear.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "Common/Core/Spectrum.h"
#include "Display/Core/Adaptation.h"
#include "Display/Core/ToneCurve.h"

namespace lambert {

struct ToneMappingOptions {
  double key = 0.18;    ///< display luminance that the mean of the scene is brought to, (0, 1]
  double exposure = 0;  ///< stops (EV) brighter or darker, any finite number
  /// Luminance, in keyed units, that just reaches full white; 0: of Photographic from the scene, of
  /// Filmic kFilmicWhite.
  double white = 0;
  ToneCurve curve = ToneCurve::Photographic;
  /// Exposure value at ISO 100 of a camera that does not adapt; light is then radiosity in W/m2,
  /// and a surface of 2^EV / 8 cd/m2 is brought to the key.
  std::optional<double> exposureValue = std::nullopt;
};

/// The operator, adapted to one scene. Apply() is safe to call from several threads.
class ToneMapping {
 public:
  /// Exposes for `adaptation`; where nothing is lit everything maps to black. Throws Error for
  /// options out of their ranges.
  explicit ToneMapping(const Adaptation& adaptation, const ToneMappingOptions& options = {});
  /// Adapts to `samples`.
  explicit ToneMapping(const std::vector<LuminanceSample>& samples,
                       const ToneMappingOptions& options = {})
      : ToneMapping(MeasureAdaptation(samples), options) {}

  /// Display value in [0,1] per band, sRGB encoded. Bands beyond the display clip, so lamps turn
  /// white.
  Spectrum Apply(const Spectrum& light) const;
  /// The same where the eye adapts to luminance `surround` about the place; of Photographic.
  Spectrum Apply(const Spectrum& light, double surround) const;
  /// As 8-bit codes.
  std::array<uint8_t, 3> ApplyToBytes(const Spectrum& light) const { return Codes(Apply(light)); }
  /// A display value as 8-bit codes.
  static std::array<uint8_t, 3> Codes(const Spectrum& display);

  /// Keyed luminance of a unit of luminance: key 2^EV / log-average.
  double Scale() const { return scale_; }
  /// Keyed luminance that reaches full white.
  double White() const { return white_; }
  ToneCurve Curve() const { return curve_; }

 private:
  ToneCurve curve_;
  double scale_ = 0;
  double white_ = 1;
};

}  // namespace lambert
