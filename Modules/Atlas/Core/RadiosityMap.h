// What leaves the surfaces of an atlas, texel by texel: a light map with its materials in it.
#pragma once

#include <vector>

#include "Atlas/Core/LightMap.h"
#include "Scene/Core/BaseTexture.h"

namespace lambert {

struct RadiosityPage {
  int size = 0;                    ///< texels along a side
  std::vector<Spectrum> texels;    ///< row after row from below: radiosity, W/m2
  std::vector<uint8_t> isInChart;  ///< by texel: a face holds its middle
  bool isTextured = false;         ///< a base texture is baked in
  /// By texel: what a base texture has there in parts of its mean, which is what the texel then
  /// holds the radiosity of; 1 elsewhere. Empty where there is no such texture.
  std::vector<Spectrum> contrast;
};

/// By page: reflectance x irradiance + emittance of the face that lies at a texel; between the
/// charts of the nearest face, so that lookups and mip maps at borders take in nothing strange.
/// `sides` are those that show, by surface (BrighterSidesOfSurfaces): a face gives its emittance
/// where that side emits. With `textures`, those of the scene of `mesh`, reflectance follows them
/// within faces, and the pages that hold some have as many texels along a side as fit
/// `texturedSize`, a whole multiple of those of the light map; irradiance between its texels is
/// bilinear. With `isTextureApart` textures stand apart from the light, as RadiosityPage::contrast.
/// Throws Error where mesh, atlas and map do not belong together.
std::vector<RadiosityPage> MakeRadiosityMap(const TriangleMesh& mesh, const RadiosityAtlas& atlas,
                                            const LightMap& map, const std::vector<uint8_t>& sides,
                                            const BaseTextures* textures = nullptr,
                                            int texturedSize = 0, bool isTextureApart = false);

}  // namespace lambert
