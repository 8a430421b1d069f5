// Where a place lies in a triangle.
#pragma once

#include <optional>

#include "Common/Core/Vector.h"

namespace lambert {

/// Weights of the corners, sum 1, that the place nearest to `x` in the plane of a triangle has; one
/// is negative where it lies outside. None where the triangle has no area.
inline std::optional<Vec3f> BarycentricWeights(const Vec3f& p0, const Vec3f& p1, const Vec3f& p2,
                                               const Vec3f& x) {
  const Vec3f normal = Cross(p1 - p0, p2 - p0);
  const float square = LengthSquared(normal);
  if (!(square > 0)) return std::nullopt;
  const float w1 = Dot(Cross(x - p0, p2 - p0), normal) / square;
  const float w2 = Dot(Cross(p1 - p0, x - p0), normal) / square;
  return Vec3f{1 - w1 - w2, w1, w2};
}

}  // namespace lambert
