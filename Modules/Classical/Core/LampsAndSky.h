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

  bool IsEmpty() const { return near_.IsEmpty() && far_.IsEmpty(); }
  /// Irradiance (W/m2) from lights at a place, by rays to their samples. Adds the rays to `cast`.
  Spectrum FromLamps(const LightReceiver& at, int64_t* cast) const;
  /// Irradiance (W/m2) from lights that are far, by rays to their samples, and from what fills the
  /// sky, by `skyRays` cosine-weighted and stratified rays, shifted by `seed`. Adds the rays to
  /// `cast`.
  Spectrum FromFar(const LightReceiver& at, int skyRays, uint64_t seed, int64_t* cast) const;

 private:
  const RayScene& rays_;
  LightSources near_, far_;
};

}  // namespace lambert
