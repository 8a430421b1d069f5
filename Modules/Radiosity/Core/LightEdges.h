// Where light changes along a segment: the part of it that holds a shadow's edge, found by asking
// for light in the middle again and again (after heckbert1992's discontinuities, without their
// geometry).
#pragma once

#include <cstdint>
#include <vector>

#include "Radiosity/Core/FinalGather.h"

namespace lambert {

/// Two points at which light is known, on a surface without a crease between them.
struct LitSegment {
  GatherPoint from, to;
  Spectrum lightFrom, lightTo;  ///< irradiance, W/m2
  int steps = 5;                ///< halvings at most, [0, 20]
};

/// Part of a segment that holds most of the change of light between its ends, as fractions of the
/// way, 0 <= low < high <= 1.
struct LightEdge {
  float low = 0, high = 1;
};

/// Halves each segment as long as one half holds nearly all of the change. A slope keeps all of its
/// segment, the shadow of a small lamp 2^-steps of it. Independent of the number of threads. Adds
/// the rays cast to `rays`.
std::vector<LightEdge> FindLightEdges(const FinalGather& gather,
                                      const std::vector<LitSegment>& segments, uint64_t seed,
                                      int64_t* rays);

}  // namespace lambert
