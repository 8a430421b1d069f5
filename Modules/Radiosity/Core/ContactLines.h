// Where other surfaces stand on a patch: light jumps there from what lies before a cupboard to what
// it hides (the D0 discontinuities of heckbert1992), at a place that rays find without any light.
#pragma once

#include <cstdint>
#include <vector>

#include "Common/Core/Spectrum.h"
#include "Common/Core/Vector.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

/// A line in the plane of a patch, along the foot of what stands on it.
struct ContactLine {
  Vec3f position;  ///< m
  Vec3f across;    ///< unit, in the plane of the patch and normal to the line
};

/// A place of a patch at which light is known.
struct KnownLight {
  Vec3f position;       ///< m
  Spectrum irradiance;  ///< W/m2
};

/// Lines along the feet of what rays meet that run close above a convex patch, from its middle to
/// places all along its border. `corners` in order about the patch, m; `normal` unit, of the side
/// that is asked about. What leans on the patch flatter than 37 degrees has none. Adds the rays
/// cast to `rays`.
std::vector<ContactLine> FindContactLines(const RayScene& scene, const std::vector<Vec3f>& corners,
                                          const Vec3f& normal, int64_t* rays);

/// The line that tells light from dark: on either side of it lie places, and it explains more of
/// the variance of their light than the others do, at least 0.4. Null where none does.
const ContactLine* TellingLine(const std::vector<ContactLine>& lines,
                               const std::vector<KnownLight>& places);

}  // namespace lambert
