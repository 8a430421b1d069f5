// Where on a lamp a ray goes: to places in proportion to the light that they send, so that what of
// the rays is blocked is what of the light is.
#pragma once

#include "Common/Core/Random.h"
#include "Common/Core/Vector.h"

namespace lambert {

/// A place on the triangle `corners`, of which all lies above the plane through `position` with
/// unit normal `normal`; the density is that of the irradiance from a diffuse triangle there, and
/// uniform over the area of one that looks like a speck. `formFactor`: from there to the triangle,
/// above 0.
Vec3f PickLampPlace(const Vec3f* corners, const Vec3f& position, const Vec3f& normal,
                    double formFactor, Random* random);

}  // namespace lambert
