#include "Classical/Core/LampsAndSky.h"

namespace lambert {

namespace {

Scene LightsOf(const Scene& scene, bool isFar) {
  Scene part;
  for (const Light& light : scene.lights) {
    const bool far = light.type == LightType::Sky || light.type == LightType::Directional;
    if (far == isFar && !light.intensity.IsBlack()) part.lights.push_back(light);
  }
  return part;
}

}  // namespace

LampsAndSky::LampsAndSky(const Scene& scene, const RayScene& rays)
    : rays_(rays),
      near_(LightsOf(scene, false)),
      far_(LightsOf(scene, true)),
      lamps_(near_, rays),
      suns_(far_, rays) {}

Spectrum LampsAndSky::FromLamps(const LightReceiver& at, int64_t* cast) const {
  return lamps_.FromLights(at, cast);
}

Spectrum LampsAndSky::FromFar(const LightReceiver& at, int skyRays, uint64_t seed,
                              int64_t* cast) const {
  const Spectrum sum = suns_.FromLights(at, cast);
  if (suns_.Sky().IsBlack()) return sum;

  // The open part of the cosine-weighted hemisphere.
  Random random(seed);
  const float shift0 = random.Uniform(), shift1 = random.Uniform();
  Vec3f u, v;
  CoordinateSystem(at.normal, &u, &v);
  int open = 0;
  for (int i = 0; i < skyRays; ++i) {
    const Vec3f d =
        CosineHemisphere((float(i) + shift0) / float(skyRays), RadicalInverse(uint32_t(i), shift1));
    const Vec3f direction = Normalize(u * d.x + v * d.y + at.normal * d.z);
    if (Dot(direction, at.geometric) <= 0) continue;
    ++*cast;
    open += rays_.OccludedDirection(at.position, direction) ? 0 : 1;
  }
  return sum + suns_.Sky() * (float(kPi) * float(open) / float(skyRays));
}

}  // namespace lambert
