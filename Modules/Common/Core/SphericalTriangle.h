// Directions uniform over the solid angle of a triangle.
#pragma once

#include "Common/Core/Spectrum.h"
#include "Common/Core/Vector.h"

namespace lambert {

/// Solid angle in sr, [0, 2 pi], of the triangle of the unit vectors a, b, c (van Oosterom and
/// Strackee 1983).
inline double SolidAngle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  return 2 * std::atan2(std::abs(Dot(a, Cross(b, c))), 1 + Dot(a, b) + Dot(b, c) + Dot(c, a));
}

/// A direction uniform over the spherical triangle of the unit vectors a, b, c (Arvo 1995, in the
/// form of pbrt's fourth edition, section 6.5.4). The triangle must not be degenerate; u0, u1 in
/// [0,1).
inline Vec3d SampleSphericalTriangle(const Vec3d& a, const Vec3d& b, const Vec3d& c, double u0,
                                     double u1) {
  const auto angleBetween = [](const Vec3d& v, const Vec3d& w) {
    return std::atan2(Length(Cross(v, w)), Dot(v, w));
  };
  const auto perpendicular = [](const Vec3d& v, const Vec3d& w) {
    return Normalize(v - w * Dot(v, w));
  };
  // Interior angles; their sum less pi is the solid angle, of which u0 takes a share.
  const Vec3d ab = Normalize(Cross(a, b)), bc = Normalize(Cross(b, c)), ca = Normalize(Cross(c, a));
  const double alpha = angleBetween(ab, -ca);
  const double sum = alpha + angleBetween(bc, -ab) + angleBetween(ca, -bc);
  const double share = kPi + u0 * (sum - kPi);

  // The corner c moves along the edge ca to cp, so that the triangle a, b, cp has that share.
  const double cosAlpha = std::cos(alpha), sinAlpha = std::sin(alpha);
  const double sinPhi = std::sin(share) * cosAlpha - std::cos(share) * sinAlpha;
  const double cosPhi = std::cos(share) * cosAlpha + std::sin(share) * sinAlpha;
  const double k1 = cosPhi + cosAlpha, k2 = sinPhi - sinAlpha * Dot(a, b);
  const double denominator = (k2 * sinPhi + k1 * cosPhi) * sinAlpha;
  double cosB = 1;
  if (denominator != 0) {
    cosB = (k2 + (k2 * cosPhi - k1 * sinPhi) * cosAlpha) / denominator;
    cosB = std::min(1.0, std::max(-1.0, cosB));
  }
  const Vec3d cp = a * cosB + perpendicular(c, a) * std::sqrt(1 - cosB * cosB);

  // Along the arc from b to cp, uniform in the cosine.
  const double cosTheta = 1 - u1 * (1 - Dot(cp, b));
  return b * cosTheta + perpendicular(cp, b) * std::sqrt(std::max(0.0, 1 - cosTheta * cosTheta));
}

}  // namespace lambert
