// What leaves the surfaces of an atlas, texel by texel: a light map with its materials in it.
#pragma once

#include <vector>

#include "Atlas/Core/LightMap.h"

namespace lambert {

/// By page and texel, row after row from below: radiosity, W/m2, reflectance x irradiance +
/// emittance of the face that lies there; between the charts of the nearest face, so that lookups
/// and mip maps at borders take in nothing strange. `sides` are those that show, by surface
/// (BrighterSidesOfSurfaces): a face gives its emittance where that side emits. Throws Error where
/// mesh, atlas and map do not belong together.
std::vector<std::vector<Spectrum>> MakeRadiosityMap(const TriangleMesh& mesh,
                                                    const RadiosityAtlas& atlas,
                                                    const LightMap& map,
                                                    const std::vector<uint8_t>& sides);

}  // namespace lambert
