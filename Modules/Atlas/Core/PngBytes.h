// Images as PNG in memory.
#pragma once

#include <cstdint>
#include <string>

namespace lambert {

/// The bytes of a PNG file of `codes`, 8 bits each of `bands` bands, row after row from above.
/// Throws Error where there is no room for them.
std::string PngBytes(int width, int height, int bands, const uint8_t* codes);

}  // namespace lambert
