// Light of element sides, and where it went.
#pragma once

#include <cstdint>
#include <vector>

#include "Classical/Core/ElementSides.h"
#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

/// Light of every side, in the order of ElementSides.
struct SideLight {
  std::vector<Spectrum> fromLamps;   ///< irradiance of point and spot lights, W/m2
  std::vector<Spectrum> fromFar;     ///< irradiance of skies and directional lights, W/m2
  std::vector<Spectrum> irradiance;  ///< all of it, on what is exposed, W/m2
  std::vector<Spectrum> radiosity;   ///< W/m2

  /// Only what the sides emit.
  explicit SideLight(const ElementSides& sides)
      : fromLamps(size_t(sides.Count())),
        fromFar(fromLamps),
        irradiance(fromLamps),
        radiosity(sides.emittance) {}
  /// Gathers `fromLamps` and `fromFar`, the mean over each side's places; `skyRays` a side. Adds
  /// the rays to `rays`.
  void GatherLights(const Scene& scene, const ElementSides& sides, const RayScene& rayScene,
                    int skyRays, int64_t* rays);
  /// Irradiance by 2 element + side, for the `keys` sides of a mesh: the mean over a side, of which
  /// what is buried is dark; black where not modelled.
  std::vector<Spectrum> IrradianceByKey(const ElementSides& sides, int64_t keys) const;
};

/// Fills `emitted`, `absorbed` and `escaped` (W per band) of the statistics, each found on its own.
/// Emitted: by faces, and by point and spot lights; skies and directional lights count with what
/// arrives from them (`light.fromFar`). Absorbed: by the sides. Escaped: what leaves the sides, by
/// rays that meet nothing; light of point lights too.
void MeasureElementBalance(const Scene& scene, const ElementSides& sides, const SideLight& light,
                           const RayScene& rayScene, SolverStatistics* statistics);

}  // namespace lambert
