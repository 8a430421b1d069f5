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

/// Directions uniform over the spherical triangle of the unit vectors a, b, c (Arvo 1995, in the
/// form of pbrt's fourth edition, section 6.5.4). The triangle must not be degenerate.
class SphericalTriangle {
 public:
  SphericalTriangle() = default;
  SphericalTriangle(const Vec3d& a, const Vec3d& b, const Vec3d& c) : a_(a), b_(b) {
    // The interior angle at a. A sample takes a share of the solid angle.
    const Vec3d ab = Normalize(Cross(a, b)), ca = Normalize(Cross(c, a));
    cosAlpha_ = -Dot(ab, ca);
    sinAlpha_ = Length(Cross(ab, ca));
    solidAngle_ = lambert::SolidAngle(a, b, c);
    towardC_ = Perpendicular(c, a);
    cosAB_ = Dot(a, b);
  }

  double SolidAngle() const { return solidAngle_; }  ///< sr

  /// u0, u1 in [0,1).
  Vec3d Sample(double u0, double u1) const {
    // The corner c moves along the edge ca to cp, so that the triangle a, b, cp has its share.
    const double share = u0 * solidAngle_;
    const double sinShare = -std::sin(share), cosShare = -std::cos(share);  // of pi more than it
    const double sinPhi = sinShare * cosAlpha_ - cosShare * sinAlpha_;
    const double cosPhi = cosShare * cosAlpha_ + sinShare * sinAlpha_;
    const double k1 = cosPhi + cosAlpha_, k2 = sinPhi - sinAlpha_ * cosAB_;
    const double denominator = (k2 * sinPhi + k1 * cosPhi) * sinAlpha_;
    double cosB = 1;
    if (denominator != 0) {
      cosB = (k2 + (k2 * cosPhi - k1 * sinPhi) * cosAlpha_) / denominator;
      cosB = std::min(1.0, std::max(-1.0, cosB));
    }
    const Vec3d cp = a_ * cosB + towardC_ * std::sqrt(1 - cosB * cosB);

    // Along the arc from b to cp, uniform in the cosine.
    const double cosTheta = 1 - u1 * (1 - Dot(cp, b_));
    return b_ * cosTheta +
           Perpendicular(cp, b_) * std::sqrt(std::max(0.0, 1 - cosTheta * cosTheta));
  }

 private:
  static Vec3d Perpendicular(const Vec3d& v, const Vec3d& w) {
    return Normalize(v - w * Dot(v, w));
  }

  Vec3d a_, b_;
  Vec3d towardC_;  ///< unit, perpendicular to a
  double solidAngle_ = 0, cosAlpha_ = 1, sinAlpha_ = 0, cosAB_ = 1;
};

}  // namespace lambert
