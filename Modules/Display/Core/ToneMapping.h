// From linear light to display codes: the global photographic operator of Reinhard et al. 2002
// (thesis 6.4.1) and the sRGB transfer curve. The only place where light stops being linear.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "Common/Core/Spectrum.h"

namespace lambert {

struct TriangleMesh;

struct ToneMappingOptions {
  double key = 0.18;    ///< display luminance that the mean of the scene is brought to, (0, 1]
  double exposure = 0;  ///< stops (EV) brighter or darker, any finite number
  double white = 0;  ///< luminance, in keyed units, that just reaches full white; 0: from the scene
};

/// What luminance weighs how much: one entry a point or pixel.
struct LuminanceSample {
  float luminance = 0;  ///< of the radiance or radiosity, any linear unit
  float weight = 1;     ///< area that it stands for
};

/// The operator, adapted to one scene. Apply() is safe to call from several threads.
class ToneMapping {
 public:
  /// Adapts to `samples`. Black, negative and non-finite samples do not count, so that a scene that
  /// is mostly dark keeps its exposure; without any sample that counts everything maps to black.
  explicit ToneMapping(const std::vector<LuminanceSample>& samples,
                       const ToneMappingOptions& options = {});

  /// Display value in [0,1] per band, sRGB encoded. Bands beyond the display clip, so lamps turn
  /// white.
  Spectrum Apply(const Spectrum& light) const;
  /// The same as 8-bit codes.
  std::array<uint8_t, 3> ApplyToBytes(const Spectrum& light) const;

  /// Keyed luminance of a unit of luminance: key 2^EV / log-average.
  double Scale() const { return scale_; }
  /// Keyed luminance that reaches full white.
  double White() const { return white_; }

 private:
  double scale_ = 0;
  double white_ = 1;
};

/// Samples of what a solution reflects, one a point, weighted with a third of the area of its
/// faces. Emitting faces are left out: a lamp does not decide the exposure of the room it lights.
std::vector<LuminanceSample> LuminanceSamples(const TriangleMesh& mesh,
                                              const std::vector<Spectrum>& radiosity);

}  // namespace lambert
