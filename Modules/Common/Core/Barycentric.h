// Where a place lies in a triangle.
#pragma once

#include <optional>

#include "Common/Core/Vector.h"

namespace lambert {

/// Weights of the corners, sum 1, that the place nearest to `x` in the plane of a triangle has; one
/// is negative where it lies outside. None where the triangle has no area.
template <class T>
std::optional<Vec3<T>> BarycentricWeights(const Vec3<T>& p0, const Vec3<T>& p1, const Vec3<T>& p2,
                                          const Vec3<T>& x) {
  const Vec3<T> normal = Cross(p1 - p0, p2 - p0);
  const T square = LengthSquared(normal);
  if (!(square > 0)) return std::nullopt;
  const T w1 = Dot(Cross(x - p0, p2 - p0), normal) / square;
  const T w2 = Dot(Cross(p1 - p0, x - p0), normal) / square;
  return Vec3<T>{1 - w1 - w2, w1, w2};
}

}  // namespace lambert
