// Light that comes from no face: lamps near by, and what is infinitely far.
#pragma once

#include <cstdint>

#include "Classical/Core/SourceLight.h"

namespace lambert {

class LampsAndSky {
 public:
  /// Keeps a reference to `rays`, which holds the scene's mesh.
  LampsAndSky(const Scene& scene, const RayScene& rays);
  LampsAndSky(const LampsAndSky&) = delete;

  bool IsEmpty() const { return near_.lights.empty() && far_.lights.empty(); }
  /// Irradiance (W/m2) from point and spot lights, by a ray each. Adds the rays to `cast`.
  Spectrum FromLamps(const LightReceiver& at, int64_t* cast) const;
  /// Irradiance (W/m2) from directional lights, by a ray each, and from skies, by `skyRays`
  /// cosine-weighted and stratified rays, shifted by `seed`. Adds the rays to `cast`.
  Spectrum FromFar(const LightReceiver& at, int skyRays, uint64_t seed, int64_t* cast) const;

 private:
  const RayScene& rays_;
  Scene near_, far_;  ///< only their lights
  SourceLight lamps_, suns_;
};

}  // namespace lambert
