#include "Classical/Core/LightsAtPoint.h"

#include "Common/Core/Random.h"

namespace lambert {

namespace {

/// Irradiance of one lamp on a facet with normal `normal`, with nothing in the way.
Spectrum OpenIrradiance(const Light& light, const Vec3f& position, const Vec3f& normal) {
  if (light.type == LightType::Directional) {
    return light.intensity * std::max(0.f, -Dot(normal, Normalize(light.direction)));
  }
  const Vec3f offset = light.position - position;
  const float squared = LengthSquared(offset);
  if (!(squared > 0)) return {};
  const Vec3f toward = offset / std::sqrt(squared);
  return light.intensity *
         (std::max(0.f, Dot(normal, toward)) * light.ConeFactor(-toward) / squared);
}

/// Part of the cosine-weighted hemisphere of `normal` that is open to the sky.
float OpenSky(const RayScene& rayScene, const Vec3f& position, const Vec3f& normal,
              const Vec3f& geometric, int rays, uint64_t seed) {
  Random random(seed);
  const float shift0 = random.Uniform(), shift1 = random.Uniform();
  Vec3f u, v;
  CoordinateSystem(normal, &u, &v);
  int open = 0;
  for (int i = 0; i < rays; ++i) {
    const Vec3f d =
        CosineHemisphere((float(i) + shift0) / float(rays), RadicalInverse(uint32_t(i), shift1));
    const Vec3f direction = u * d.x + v * d.y + normal * d.z;
    if (Dot(direction, geometric) <= 0) continue;
    open += rayScene.OccludedDirection(position, direction) ? 0 : 1;
  }
  return float(open) / float(rays);
}

}  // namespace

Spectrum IrradianceFromLights(const std::vector<Light>& lights, const RayScene& rayScene,
                              const Vec3f& position, const Vec3f& normal, const Vec3f& geometric,
                              int skyRays, uint64_t seed, int64_t* rays) {
  Spectrum sum, sky;
  for (const Light& light : lights) {
    if (light.type == LightType::Sky) {
      sky += light.intensity;
      continue;
    }
    const bool isFar = light.type == LightType::Directional;
    const Vec3f toward = isFar ? -light.direction : light.position - position;
    const Spectrum open = OpenIrradiance(light, position, normal);
    if (open.IsBlack() || Dot(toward, geometric) <= 0) continue;
    ++*rays;
    const bool blocked = isFar ? rayScene.OccludedDirection(position, toward)
                               : rayScene.Occluded(position, light.position);
    if (!blocked) sum += open;
  }
  if (!sky.IsBlack() && skyRays > 0) {
    *rays += skyRays;
    sum += sky * (float(kPi) * OpenSky(rayScene, position, normal, geometric, skyRays, seed));
  }
  return sum;
}

}  // namespace lambert
