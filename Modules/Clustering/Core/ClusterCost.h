// What a growing cluster knows of itself, and the cost of joining two (thesis 4.2.2).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "Common/Core/Vector.h"

namespace lambert {

/// A cluster during the collapse, in units of its surface's diagonal. The fit quadric (4.2-4.4) is
/// kept as mean and covariance (4.5-4.7), which loses no digits to the distance from the origin.
/// Every face counts its three points.
struct ClusterMoments {
  Vec3f mean;                                            ///< (4.6)
  float xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;  ///< Z of (4.5)
  Vec3f vectorArea;                                      ///< (4.9)
  float area = 0;
  int32_t faces = 0;
  double perimeter = 0;  ///< a multiple of 2^-36, so that sums of it are exact

  static ClusterMoments OfTriangle(const Vec3f& a, const Vec3f& b, const Vec3f& c);
  /// Symmetric to the bit; the perimeter is left for the caller, who knows what is shared.
  static ClusterMoments Join(const ClusterMoments& a, const ClusterMoments& b);
  /// Mean squared distance of the points from their best plane: smallest eigenvalue of Z over their
  /// number.
  double FitError() const;
};

/// The place of an edge in the queue; lower joins first.
using CostRank = uint32_t;

/// Rank of joining a and b along edges of total length `shared`.
CostRank RankOfJoining(const ClusterMoments& a, const ClusterMoments& b, double shared,
                       double balance);

inline ClusterMoments ClusterMoments::OfTriangle(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  ClusterMoments m;
  m.mean = (a + b + c) / 3.f;
  for (const Vec3f& v : {a, b, c}) {
    const Vec3f d = v - m.mean;
    m.xx += d.x * d.x, m.yy += d.y * d.y, m.zz += d.z * d.z;
    m.xy += d.x * d.y, m.yz += d.y * d.z, m.zx += d.z * d.x;
  }
  m.vectorArea = Cross(b - a, c - a) * 0.5f;
  m.area = Length(m.vectorArea);
  m.faces = 1;
  return m;
}

inline ClusterMoments ClusterMoments::Join(const ClusterMoments& a, const ClusterMoments& b) {
  const float wa = float(a.faces), wb = float(b.faces), sum = wa + wb;
  const Vec3f d = a.mean - b.mean;
  const float w = 3 * (wa * wb) / sum;
  ClusterMoments m;
  m.mean = (a.mean * wa + b.mean * wb) / sum;
  m.xx = a.xx + b.xx + w * (d.x * d.x), m.xy = a.xy + b.xy + w * (d.x * d.y);
  m.yy = a.yy + b.yy + w * (d.y * d.y), m.yz = a.yz + b.yz + w * (d.y * d.z);
  m.zz = a.zz + b.zz + w * (d.z * d.z), m.zx = a.zx + b.zx + w * (d.z * d.x);
  m.vectorArea = a.vectorArea + b.vectorArea;
  m.area = a.area + b.area;
  m.faces = a.faces + b.faces;
  return m;
}

inline double ClusterMoments::FitError() const {
  // Smallest root of the characteristic polynomial x^3 - trace x^2 + minors x - determinant, by
  // Laguerre's method from below: exact where two eigenvalues vanish or all agree, and never past
  // the root.
  const double x = xx, y = yy, z = zz, a = xy, b = yz, c = zx;
  const double trace = x + y + z;
  const double minors = x * y - a * a + y * z - b * b + z * x - c * c;
  const double determinant = x * (y * z - b * b) - a * (a * z - b * c) + c * (a * b - y * c);
  double root = 0;
  for (int step = 0; step < 2; ++step) {
    const double value = ((root - trace) * root + minors) * root - determinant;
    const double slope = (3 * root - 2 * trace) * root + minors;
    const double curvature = 6 * root - 2 * trace;
    if (!(value < 0) || !(slope > 0)) break;
    const double discriminant = 4 * slope * slope - 6 * value * curvature;
    root -= 3 * value / (slope + std::sqrt(std::max(0.0, discriminant)));
  }
  return root / (3.0 * faces);
}

inline CostRank RankOfJoining(const ClusterMoments& a, const ClusterMoments& b, double shared,
                              double balance) {
  ClusterMoments m = ClusterMoments::Join(a, b);
  const double perimeter = a.perimeter + b.perimeter - 2 * shared;
  const double vectorArea = Length(m.vectorArea);

  // (4.8); for closed clusters, where both perimeter and vector area vanish, the shape factor is
  // left out.
  double cost = m.FitError() + balance * m.area;
  constexpr double kLeastVectorArea =
      1e-6;  // float sums of normals are good for as much, relative to the area
  if (perimeter > 0) {
    cost *= perimeter * perimeter / std::max({vectorArea, kLeastVectorArea * m.area, 1e-30});
  }

  // Orientation first: clusters whose normals agree are finished before any of wider spread begins.
  // 1 - |S| / A is (1 - cos t) / 2 for a cap of half-angle t: 8, 16, 33, 66 degrees.
  const double spread = m.area > 0 ? 1 - vectorArea / m.area : 0;
  CostRank rank = 0;
  for (const double limit : {0.005, 0.02, 0.08, 0.3}) rank += spread > limit;

  // Costs within an eighth of an octave are equal, so that rounding does not order flat clusters;
  // ties go by size.
  const float bounded = float(std::min(std::max(cost, 1e-37), 1e37));
  uint32_t bits;
  std::memcpy(&bits, &bounded, sizeof bits);
  return rank << 12 | bits >> 20;
}

}  // namespace lambert
