// What light an eye adapts to: the log-average and the bright end of what is shown, and an
// adaptation that stays steady while a solution converges.
#pragma once

#include <vector>

#include "Common/Core/Spectrum.h"

namespace lambert {

struct TriangleMesh;

/// What luminance weighs how much: one entry a point or pixel.
struct LuminanceSample {
  float luminance = 0;  ///< of the radiance or radiosity, any linear unit
  float weight = 1;     ///< area that it stands for
};

/// Samples of what a solution reflects, one a point, weighted with a third of the area of its
/// faces. Emitting faces are left out: a lamp does not decide the exposure of the room it lights.
std::vector<LuminanceSample> LuminanceSamples(const TriangleMesh& mesh,
                                              const std::vector<Spectrum>& radiosity);

/// Luminance that `share` of the lit weight is brighter than; 0 where nothing is lit. What counts
/// as lit is told below.
double LuminanceExceededBy(double share, const std::vector<LuminanceSample>& samples);

/// Luminance, in the unit of the samples; both 0 where nothing is lit.
struct Adaptation {
  double average = 0;  ///< log-average of what is lit (reinhard2002 eq. 1)
  double bright = 0;   ///< below which all but a hundredth of the lit area stays
};

/// Black, negative and non-finite samples do not count, nor do those darker than 1e-5 of the mean,
/// so that a scene that is mostly dark keeps its exposure.
Adaptation MeasureAdaptation(const std::vector<LuminanceSample>& samples);

/// Follows the adaptations of a converging solution without pumping: each update goes half of the
/// way in stops, and no further than a bound. The first light that is seen is taken as it is.
class SteadyAdaptation {
 public:
  /// `mostStops` an update, above 0. Throws Error.
  explicit SteadyAdaptation(double mostStops = 0.25);

  /// What to expose for, now that `measured` was seen. Without light nothing moves.
  const Adaptation& Follow(const Adaptation& measured);

 private:
  double mostStops_;
  Adaptation current_;
};

}  // namespace lambert
