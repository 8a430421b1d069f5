// What a scene may hold for its light to be computed. Beyond it areas and powers leave the range of
// floats and rays that of the ray tracer, and the light would be dark or not a number without a
// word.
#pragma once

#include <cmath>
#include <vector>

#include "Common/Core/TriangleMesh.h"
#include "Scene/Core/Light.h"

namespace lambert {

/// Diagonal of a scene, m.
constexpr double kSmallestScene = 1e-6, kLargestScene = 1e9;
/// Largest coordinate of a light or probe, m: well within what rays may have and squares of floats
/// hold.
constexpr float kFarthest = 1e15f;

/// Brightest light, of whatever unit: sums of its squares stay well within doubles, light that
/// bounces within floats.
constexpr float kBrightest = 1e30f;

/// Neither negative nor beyond that, in any band.
inline bool IsSolvable(const Spectrum& light) {
  const auto isGood = [](float band) { return band >= 0 && band <= kBrightest; };
  return isGood(light.r) && isGood(light.g) && isGood(light.b);
}

inline bool IsWithinReach(const Vec3f& point) {
  return std::abs(point.x) <= kFarthest && std::abs(point.y) <= kFarthest &&
         std::abs(point.z) <= kFarthest;
}

/// Throws Error where the diagonal of `mesh` is beyond the limits, or an exitance of its faces. A
/// mesh without extent passes.
void RequireSolvableMesh(const TriangleMesh& mesh);

/// Diagonal of the box of all but a hundredth of the faces at either end of each axis, by their
/// centers, m. Much less than that of the mesh where faces stray.
double DiagonalOfMost(const TriangleMesh& mesh);

/// Throws Error for a light whose intensity is negative or beyond the limit, that lies out of
/// reach, that shines in no direction or whose size none can have.
void RequireSolvableLights(const std::vector<Light>& lights);

}  // namespace lambert
