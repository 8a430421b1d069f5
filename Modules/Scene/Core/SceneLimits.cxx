#include "Scene/Core/SceneLimits.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "Common/Core/Error.h"

namespace lambert {

void RequireSolvableMesh(const TriangleMesh& mesh) {
  for (size_t face = 0; face < mesh.emittance.size(); ++face) {
    if (IsSolvable(mesh.emittance[face])) continue;
    throw Error("Face " + std::to_string(face) +
                " has an exitance that is negative, not a number or over 1e30 W/m2; repair the "
                "input.");
  }
  if (mesh.positions.empty()) return;
  const Box3f bounds = mesh.Bounds();
  const double diagonal = Length(Vec3d(bounds.high) - Vec3d(bounds.low));
  if (diagonal == 0 || (diagonal >= kSmallestScene && diagonal <= kLargestScene)) return;
  char text[160];
  std::snprintf(
      text, sizeof text,
      "The scene measures %g m across; light is computed from %g m to %g m: check the length unit.",
      diagonal, kSmallestScene, kLargestScene);
  throw Error(text);
}

double DiagonalOfMost(const TriangleMesh& mesh) {
  constexpr size_t kPartLeftOut = 100, kFew = 8;
  std::vector<float> centers(mesh.triangles.size());
  const size_t leftOut =
      centers.size() > kFew ? std::max<size_t>(1, centers.size() / kPartLeftOut) : 0;
  double square = 0;
  for (int axis = 0; axis < 3 && !centers.empty(); ++axis) {
    for (size_t face = 0; face < centers.size(); ++face) {
      const auto& p = mesh.triangles[face];
      centers[face] = (mesh.positions[size_t(p[0])][axis] + mesh.positions[size_t(p[1])][axis] +
                       mesh.positions[size_t(p[2])][axis]) /
                      3.f;
    }
    const auto low = centers.begin() + int64_t(leftOut),
               high = centers.end() - 1 - int64_t(leftOut);
    std::nth_element(centers.begin(), low, centers.end());
    const double least = double(*low);
    std::nth_element(centers.begin(), high, centers.end());
    square += (double(*high) - least) * (double(*high) - least);
  }
  return std::sqrt(square);
}

void RequireSolvableLights(const std::vector<Light>& lights) {
  for (const Light& light : lights) {
    const std::string name = "The light \"" + light.name + "\"";
    for (const Spectrum& given : {light.intensity, light.horizon, light.ground}) {
      if (IsSolvable(given)) continue;
      throw Error(name + " has an intensity that is negative, not a number or over 1e30; repair " +
                  "the input.");
    }
    if (!IsWithinReach(light.position)) {
      throw Error(
          name + " lies too far away or nowhere; repair the input or make it a directional light.");
    }
    const bool isSizeKnown =
        light.size >= 0 && (light.IsPlaced() ? light.size <= kFarthest : light.size < float(kPi));
    if (!isSizeKnown) {
      throw Error(name + " has a size that is negative, not a number or too large; a directional " +
                  "light is less than 180 degrees across.");
    }
    const bool isAimed = light.type != LightType::Point && light.type != LightType::Sky;
    if (isAimed && !(IsFinite(light.direction) && LengthSquared(Vec3d(light.direction)) > 0)) {
      throw Error(name + " shines in no direction; repair the input.");
    }
    if (!std::isfinite(light.rotation)) {
      throw Error(name + " is turned by what is not a finite number; repair the input.");
    }
  }
}

}  // namespace lambert
