// Images that viewers multiply by light, made brighter where light would have to exceed 1.
#pragma once

#include <string>

#include "Common/Core/Spectrum.h"

namespace lambert {

/// Of an image file of sRGB codes: the linear factors, 1 or more, by which its bands may be
/// multiplied and stay within the display. Texels of less alpha than `alphaCutoff` are holes, which
/// do not count. Throws Error for what cannot be decoded.
Spectrum RoomAbove(const std::string& file, float alphaCutoff);

/// Its bands multiplied by linear factors, as the bytes of a PNG file with alpha. Throws as above.
std::string Brightened(const std::string& file, const Spectrum& factor);

}  // namespace lambert
