// Light of lamps without geometry, and of the sky, at a point.
#pragma once

#include <cstdint>
#include <vector>

#include "Scene/Core/Light.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

/// Irradiance (W/m2) at `position` for the unit normal `normal` of all point, spot, directional and
/// sky lights, with their shadows; only directions above `geometric` count. Lamps take one ray
/// each, skies `skyRays` together, cosine-weighted and stratified, shifted by `seed`. Adds the rays
/// to `rays`.
Spectrum IrradianceFromLights(const std::vector<Light>& lights, const RayScene& rayScene,
                              const Vec3f& position, const Vec3f& normal, const Vec3f& geometric,
                              int skyRays, uint64_t seed, int64_t* rays);

}  // namespace lambert
