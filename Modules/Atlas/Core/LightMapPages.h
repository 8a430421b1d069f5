// The pages of a light map as image files: of floats for renderers, of codes for what shows images.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "Atlas/Core/LightMap.h"

namespace lambert {

enum class PageFormat {
  Hdr,  ///< Radiance: four bytes a texel, about 1 % of the brightest band
  Exr,  ///< OpenEXR: 32-bit floats, the irradiance to the bit, packed without loss
  Png   ///< 8-bit codes
};

/// Names of the pages of the light map NAME.vtp (or .vtpc): NAME-0.hdr, NAME-1.hdr, ... by the
/// format.
std::vector<std::string> LightMapPageNames(const std::string& fileName, int pages,
                                           PageFormat format);

/// The codes that show an irradiance, W/m2, in a PNG.
using TexelCodes = std::function<std::array<uint8_t, 3>(const Spectrum& irradiance)>;

/// Writes a file a page under the names above, three bands R, G and B, the row of v = 1 first;
/// floats are irradiance, W/m2. `codes` is asked for Png alone. Throws Error where a file cannot be
/// written.
void WriteLightMapPages(const LightMap& map, const std::string& fileName, PageFormat format,
                        const TexelCodes& codes = {});

}  // namespace lambert
