// Irradiance straight from the sources: closed form where nothing is in the way, rays for what is.
#pragma once

#include <cstdint>
#include <vector>

#include "Common/Core/Random.h"
#include "Scene/Core/LightSource.h"
#include "Scene/Core/Scene.h"
#include "Visibility/Core/EmitterTree.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

/// A place that light is asked for.
using LightReceiver = LitPlace;

/// Irradiance (W/m2) from the samples of lights without geometry, by the place alone. Adds the rays
/// cast to `cast`.
Spectrum FromSamples(const LightSources& lights, const LightReceiver& at, const RayScene& rays,
                     int64_t* cast);

class SourceLight {
 public:
  /// Keeps references to both; `rays` holds the scene's mesh.
  SourceLight(const Scene& scene, const RayScene& rays);

  /// Irradiance (W/m2) from emitting faces by `count` rays, in proportion to what these send where
  /// nothing is in the way. Adds the rays cast to `cast`.
  Spectrum FromEmitters(const LightReceiver& at, int count, Random* random, int64_t* cast) const;
  /// Irradiance (W/m2) from the samples of lights without geometry, by the place alone.
  Spectrum FromLights(const LightReceiver& at, int64_t* cast) const {
    return FromSamples(lights_, at, rays_, cast);
  }

  /// What rays that meet nothing find in a unit direction, W/(m2 sr).
  Spectrum Sky(const Vec3f& direction) const { return lights_.Radiance(direction); }

 private:
  /// What of an emitting side of a face lies above the horizon, or a piece of it.
  struct Piece {
    Vec3f corners[3];      ///< counter-clockwise from the emitting side
    Spectrum irradiance;   ///< that it sends where nothing is in the way, W/m2
    float strength = 0;    ///< mean of that over the bands
    float factor = 0;      ///< form factor from the receiver
    int32_t emitter = -1;  ///< row of emitters_
  };
  struct Emitter {
    Vec3f corners[3];
    Spectrum exitance;  ///< W/m2
  };

  Spectrum FromFewEmitters(const LightReceiver& at, int count, Random* random, int64_t* cast) const;
  Spectrum FromManyEmitters(const LightReceiver& at, int count, Random* random,
                            int64_t* cast) const;
  bool Unblocked(const LightReceiver& at, const Vec3f& place, int64_t* cast) const;
  void Evaluate(const LightReceiver& at, Piece* piece) const;

  const Scene& scene_;
  const RayScene& rays_;
  EmitterTree tree_;
  std::vector<Emitter> emitters_;  ///< where they are few; else empty
  LightSources lights_;
};

}  // namespace lambert
