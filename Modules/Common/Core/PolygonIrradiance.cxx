#include "Common/Core/PolygonIrradiance.h"

#include <algorithm>

#include "Common/Core/Spectrum.h"

namespace lambert {

namespace {

/// Twice the vector area of a polygon given relative to some origin.
Vec3d DoubleArea(const Vec3d* p, int count) {
  Vec3d sum;
  for (int i = 2; i < count; ++i) sum += Cross(p[i - 1] - p[0], p[i] - p[0]);
  return sum;
}

/// True where the emitting side faces the origin. Points of its own plane see none of a polygon:
/// single precision puts them before it or behind it, by less than this part of its distance.
bool FacesOrigin(const Vec3d* p, int count) {
  constexpr double kRounding = 1e-6;
  const Vec3d normal = DoubleArea(p, count);
  double farthest = 0;
  for (int i = 0; i < count; ++i) farthest = std::max(farthest, LengthSquared(p[i]));
  const double height = -Dot(normal, p[0]);
  return height > 0 && height * height > kRounding * kRounding * LengthSquared(normal) * farthest;
}

/// Sum over edges of the angle that the edge subtends times the unit normal of its plane through
/// the origin.
Vec3d EdgeSum(const Vec3d* p, int count) {
  Vec3d sum;
  for (int i = 0; i < count; ++i) {
    const Vec3d& a = p[i];
    const Vec3d& b = p[i + 1 < count ? i + 1 : 0];
    const Vec3d normal = Cross(a, b);
    const double sine = Length(normal);
    // An edge that passes through the origin, or has no length, subtends no plane.
    if (!(sine > 1e-14 * (LengthSquared(a) + LengthSquared(b)))) continue;
    sum += normal * (std::atan2(sine, Dot(a, b)) / sine);
  }
  return sum;
}

}  // namespace

Vec3d PolygonIrradiance(const Vec3f* corners, int count, const Vec3f& x) {
  Vec3d p[kMaximumPolygonCorners];
  for (int i = 0; i < count; ++i) p[i] = Vec3d(corners[i]) - Vec3d(x);
  if (!FacesOrigin(p, count)) return {};
  // Counter-clockwise from the emitting side, seen from x, makes the edge normals point away from
  // the polygon's inside.
  return EdgeSum(p, count) * (-1 / (2 * kPi));
}

Vec3d PolygonIrradianceAbove(const Vec3f* corners, int count, const Vec3f& x,
                             const Vec3f& horizon) {
  Vec3d p[kMaximumPolygonCorners];
  double height[kMaximumPolygonCorners];
  const Vec3d up(horizon);
  bool anyAbove = false, anyBelow = false;
  for (int i = 0; i < count; ++i) {
    p[i] = Vec3d(corners[i]) - Vec3d(x);
    height[i] = Dot(p[i], up);
    (height[i] > 0 ? anyAbove : anyBelow) = true;
  }
  if (!anyAbove || !FacesOrigin(p, count)) return {};
  if (!anyBelow) return EdgeSum(p, count) * (-1 / (2 * kPi));

  // Clip at the horizon.
  Vec3d clipped[kMaximumPolygonCorners + 1];
  const int kept = ClipAbove(p, height, count, clipped);
  return EdgeSum(clipped, kept) * (-1 / (2 * kPi));
}

}  // namespace lambert
