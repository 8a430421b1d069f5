// What few rays see of the emitting faces from many points: what neighbours see tells of a point,
// too, unless a shadow ends there.
#pragma once

#include <vector>

#include "Common/Core/Spectrum.h"
#include "Common/Core/Vector.h"
#include "Radiosity/Core/IrradianceFilter.h"

namespace lambert {

/// What rays from a place told of the emitting faces.
struct VisibilitySample {
  Spectrum visible;   ///< part of the unoccluded irradiance that arrives; its mean over the bands
                      ///< is in [0, 1], but for scatter
  float squares = 0;  ///< mean square over the rays of what each brings, 1 where all is visible
  float rays = 0;     ///< [0, inf); 0: nothing is known
  float apart = 0;    ///< in which part it is a place of its own, [0, 1], see StandsApart
};

/// In which part a sample, at one of the `places`, does not belong to what its up to 16 nearest
/// neighbours saw: 0 where all are as far off a plane through them as rays scatter and it is less
/// than twice as far, 1 where they or it are off by far more. A shadow ends there.
float StandsApart(const std::vector<VisibilitySample>& samples,
                  const std::vector<IrradianceSample>& places, const SampleNeighbours& neighbours,
                  int32_t sample);

/// What is visible from a place, all neighbours heard, and how far that may be off.
struct FilteredVisibility {
  Spectrum visible;    ///< part of the unoccluded irradiance that arrives
  float variance = 0;  ///< of its mean over the bands, as its rays scatter
};

/// The visible part at a sample: in the part that it stands apart its own, else that of the plane
/// fitted to it and its neighbours. What stands apart tells of itself alone, or what it saw would
/// count twice: the unlucky ones of many that see nearly all of a lamp would darken them, too.
FilteredVisibility FilterVisibility(const std::vector<VisibilitySample>& samples,
                                    const std::vector<IrradianceSample>& places,
                                    const SampleNeighbours& neighbours, int32_t sample);

}  // namespace lambert
