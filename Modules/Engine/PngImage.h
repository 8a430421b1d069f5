// Images as PNG in memory. C++ only.
#ifndef PngImage_h
#define PngImage_h

#include "LitModel.h"

namespace lambert {
/// The bytes of a PNG file of `image`, three bands of 8 bits. Throws Error where there is no room
/// for them.
LAMBERTENGINE_EXPORT std::string PngOf(const LitImage& image);
/// The bytes of an image file as viewers take them: PNG and JPEG as they are, other formats of
/// 8-bit codes as PNG with alpha. Throws Error for what cannot be decoded.
LAMBERTENGINE_EXPORT std::string ViewerImageOf(const std::string& file);

/// True for the bytes of a JPEG file.
LAMBERTENGINE_EXPORT bool IsJpeg(const std::string& file);
}  // namespace lambert

#endif
