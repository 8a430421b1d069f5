#include "Classical/Core/LampPlace.h"

#include <algorithm>
#include <cmath>

#include "Common/Core/SphericalTriangle.h"

namespace lambert {

namespace {

/// From this form factor on, rays are spread over the hemisphere until one meets the triangle;
/// below it, over the triangle until one stands upright enough.
constexpr double kLargeFactor = 0.25;
/// After so many tries, of which each succeeds at least at about every fourth, the last one counts.
constexpr int kMostTries = 64;
/// Below this solid angle (sr) rounding is more than what places differ by.
constexpr double kSpeck = 1e-8;

/// A triangle as seen from a point.
struct SeenTriangle {
  Vec3d corners[3];  ///< relative to the point, m
  Vec3d normal;      ///< not of unit length
  SeenTriangle(const Vec3f* absolute, const Vec3f& position) {
    for (int c = 0; c < 3; ++c) corners[c] = Vec3d(absolute[c]) - Vec3d(position);
    normal = Cross(corners[1] - corners[0], corners[2] - corners[0]);
  }

  /// True where the ray from the point meets the triangle.
  bool IsMet(const Vec3d& direction) const {
    const double a = Dot(direction, Cross(corners[0], corners[1]));
    const double b = Dot(direction, Cross(corners[1], corners[2]));
    const double c = Dot(direction, Cross(corners[2], corners[0]));
    return Distance(direction) > 0 &&
           ((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0));
  }
  /// To the triangle's plane, m; 0 where the ray does not meet it.
  double Distance(const Vec3d& direction) const {
    const double slope = Dot(direction, normal);
    return slope != 0 ? std::max(0.0, Dot(corners[0], normal) / slope) : 0;
  }
};

/// The largest cosine to the unit vector `axis` on the shorter arc between unit vectors a and b.
double LargestCosine(const Vec3d& a, const Vec3d& b, const Vec3d& axis) {
  const Vec3d pole = Cross(a, b);
  const double atEnds = std::max(Dot(a, axis), Dot(b, axis)), squared = LengthSquared(pole);
  if (!(squared > 0)) return atEnds;
  const double height = Dot(pole, axis);
  const Vec3d nearest = axis - pole * (height / squared);
  const bool isWithin = Dot(Cross(a, nearest), pole) > 0 && Dot(Cross(nearest, b), pole) > 0;
  return isWithin ? std::sqrt(std::max(0.0, 1 - height * height / squared)) : atEnds;
}

double LargestCosine(const SeenTriangle& triangle, const Vec3d* toward, const Vec3d& axis) {
  if (triangle.IsMet(axis)) return 1;
  return std::max({LargestCosine(toward[0], toward[1], axis),
                   LargestCosine(toward[1], toward[2], axis),
                   LargestCosine(toward[2], toward[0], axis)});
}

/// Of cosine-weighted directions one that meets the triangle.
Vec3d PickOverHemisphere(const SeenTriangle& triangle, const Vec3f& normal, Random* random) {
  Vec3f s, t;
  CoordinateSystem(normal, &s, &t);
  for (int i = 0; i < kMostTries; ++i) {
    const float u = random->Uniform(), v = random->Uniform();
    const Vec3f local = CosineHemisphere(u, v);
    const Vec3d direction(s * local.x + t * local.y + normal * local.z);
    if (triangle.IsMet(direction)) return direction;
  }
  return {};
}

/// Of directions to the triangle, uniform over solid angle, one taken by its cosine.
Vec3d PickOverTriangle(const SeenTriangle& triangle, const Vec3f& normal, Random* random) {
  Vec3d toward[3];
  for (int c = 0; c < 3; ++c) toward[c] = Normalize(triangle.corners[c]);
  const SphericalTriangle sphere(toward[0], toward[1], toward[2]);
  if (!(sphere.SolidAngle() > kSpeck)) return {};
  const Vec3d axis(normal);
  const double largest = LargestCosine(triangle, toward, axis);
  Vec3d direction;
  for (int i = 0; i < kMostTries; ++i) {
    const double u = random->UniformDouble(), v = random->UniformDouble();
    direction = sphere.Sample(u, v);
    if (random->UniformDouble() * largest < Dot(direction, axis)) break;
  }
  return direction;
}

}  // namespace

Vec3f PickLampPlace(const Vec3f* corners, const Vec3f& position, const Vec3f& normal,
                    double formFactor, Random* random) {
  const SeenTriangle triangle(corners, position);
  const Vec3d direction = formFactor > kLargeFactor ? PickOverHemisphere(triangle, normal, random)
                                                    : PickOverTriangle(triangle, normal, random);
  const double distance = triangle.Distance(direction);
  if (distance > 0 && std::isfinite(distance)) return Vec3f(Vec3d(position) + direction * distance);
  const float u = random->Uniform(), v = random->Uniform();
  return PlaceOnTriangle(corners[0], corners[1], corners[2], UniformTriangle(u, v));
}

}  // namespace lambert
