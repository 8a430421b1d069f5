// The irradiance vector of a diffuse polygon in closed form: exact where nothing is in the way.
#pragma once

#include "Common/Core/Vector.h"

namespace lambert {

/// A convex polygon of at most this many corners; clipping at the horizon may add one.
constexpr int kMaximumPolygonCorners = 16;

/// The part of a convex polygon whose heights are above 0; `clipped` has room for one corner more
/// than `count`. Returns the number of its corners.
template <class Vector>
int ClipAbove(const Vector* corners, const double* height, int count, Vector* clipped) {
  int kept = 0;
  for (int i = 0; i < count; ++i) {
    const int next = i + 1 < count ? i + 1 : 0;
    if (height[i] > 0) clipped[kept++] = corners[i];
    if ((height[i] > 0) == (height[next] > 0)) continue;
    const double t = height[i] / (height[i] - height[next]);
    clipped[kept++] = corners[i] + (corners[next] - corners[i]) * decltype(Vector::x)(t);
  }
  return kept;
}

/// Irradiance vector at `x` of a polygon of unit exitance, dimensionless: dotted with a unit normal
/// it is the form factor from the differential area to the polygon (Lambert 1760; arvo1994, eq. 1).
/// Corners are counter-clockwise seen from the emitting side; zero where `x` lies behind that side,
/// or in the polygon's plane to within 1e-6 of the distance of its farthest corner.
Vec3d PolygonIrradiance(const Vec3f* corners, int count, const Vec3f& x);

/// The same for the part of the polygon above the plane through `x` with unit normal `horizon`, so
/// that the dot product with `horizon` is never negative, but for 1e-15 of rounding.
Vec3d PolygonIrradianceAbove(const Vec3f* corners, int count, const Vec3f& x, const Vec3f& horizon);

}  // namespace lambert
