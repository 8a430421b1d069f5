// Directions of the sky: up, north and east.
#pragma once

#include <cmath>

#include "Common/Core/Vector.h"

namespace lambert {

struct Compass {
  Vec3f up, north, east;  ///< unit, at right angles

  /// `up`: unit. North is +y where z is up, else -z; so x is east where y or z is up.
  explicit Compass(const Vec3f& up_) : up(up_) {
    const bool isZUp = std::abs(up.z) > 0.5f;
    const Vec3f ahead = isZUp ? Vec3f(0, 1, 0) : Vec3f(0, 0, -1);
    north = Normalize(ahead - up * Dot(ahead, up));
    east = Cross(north, up);
  }
  /// The unit direction at an azimuth, clockwise from north as seen from above, and an elevation
  /// over the horizon, radians.
  Vec3f Direction(double azimuth, double elevation) const {
    const Vec3f level = north * float(std::cos(azimuth)) + east * float(std::sin(azimuth));
    return Normalize(level * float(std::cos(elevation)) + up * float(std::sin(elevation)));
  }
};

}  // namespace lambert
