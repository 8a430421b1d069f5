#include "Classical/Core/LampsAndSky.h"

namespace lambert {

LampsAndSky::LampsAndSky(const Scene& scene, const RayScene& rays)
    : rays_(rays),
      near_(SelectLights(scene.lights, false)),
      far_(SelectLights(scene.lights, true)) {}

Spectrum LampsAndSky::FromLamps(const LightReceiver& at, int64_t* cast) const {
  return FromSamples(near_, at, rays_, cast);
}

Spectrum LampsAndSky::FromFar(const LightReceiver& at, int skyRays, uint64_t seed,
                              int64_t* cast) const {
  const Spectrum sum = FromSamples(far_, at, rays_, cast);
  if (!far_.FillSky()) return sum;

  // What the open part of the cosine-weighted hemisphere shows.
  Random random(seed);
  const float shift0 = random.Uniform(), shift1 = random.Uniform();
  Vec3f u, v;
  CoordinateSystem(at.normal, &u, &v);
  Spectrum seen;
  for (int i = 0; i < skyRays; ++i) {
    const Vec3f d =
        CosineHemisphere((float(i) + shift0) / float(skyRays), RadicalInverse(uint32_t(i), shift1));
    const Vec3f direction = Normalize(u * d.x + v * d.y + at.normal * d.z);
    if (Dot(direction, at.geometric) <= 0) continue;
    ++*cast;
    if (!rays_.OccludedDirection(at.position, direction)) seen += far_.Radiance(direction);
  }
  return sum + seen * (float(kPi) / float(skyRays));
}

}  // namespace lambert
