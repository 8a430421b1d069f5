// Images as PNG in memory. C++ only.
#ifndef PngImage_h
#define PngImage_h

#include "LitModel.h"

namespace lambert {
/// The bytes of a PNG file of `image`, three bands of 8 bits. Throws Error where there is no room
/// for them.
LAMBERTENGINE_EXPORT std::string PngOf(const LitImage& image);
}  // namespace lambert

#endif
