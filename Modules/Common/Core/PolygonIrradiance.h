// The irradiance vector of a diffuse polygon in closed form: exact where nothing is in the way.
#pragma once

#include "Common/Core/Vector.h"

namespace lambert {

/// A convex polygon of at most this many corners; clipping at the horizon may add one.
constexpr int kMaximumPolygonCorners = 16;

/// Irradiance vector at `x` of a polygon of unit exitance, dimensionless: dotted with a unit normal
/// it is the form factor from the differential area to the polygon (Lambert 1760; arvo1994, eq. 1).
/// Corners are counter-clockwise seen from the emitting side; zero where `x` lies behind that side,
/// or in the polygon's plane to within 1e-6 of the distance of its farthest corner.
Vec3d PolygonIrradiance(const Vec3f* corners, int count, const Vec3f& x);

/// The same for the part of the polygon above the plane through `x` with unit normal `horizon`, so
/// that the dot product with `horizon` is never negative, but for 1e-15 of rounding.
Vec3d PolygonIrradianceAbove(const Vec3f* corners, int count, const Vec3f& x, const Vec3f& horizon);

}  // namespace lambert
