// Radiance HDR files (Ward 1991), checked byte by byte: what is cut off is refused.
#pragma once

#include <cstddef>
#include <vector>

#include "Common/Core/Spectrum.h"

namespace lambert {

struct RadiancePixels {
  int width = 0, height = 0;
  std::vector<Spectrum> texels;  ///< the uppermost row first, as the exposures of the file say
};

/// Whether the bytes begin as such a file does.
bool IsRadiance(const unsigned char* bytes, size_t size);

/// Decodes RGBE pixels: plain, or with runs of either kind. Throws Error, the rest of a sentence
/// about the file ("is cut off"), for what is none, is damaged, holds no RGBE pixels, stands
/// otherwise than rows from above and from the left, or has more than 2^28 texels.
RadiancePixels DecodeRadiance(const unsigned char* bytes, size_t size);

}  // namespace lambert
