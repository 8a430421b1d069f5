#include "Atlas/Core/PngBytes.h"

#include <stb_image_write.h>

#include "Common/Core/Error.h"

namespace lambert {

std::string PngBytes(int width, int height, int bands, const uint8_t* codes) {
  std::string bytes;
  const auto append = [](void* to, void* more, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(more), size_t(size));
  };
  if (!stbi_write_png_to_func(append, &bytes, width, height, bands, codes, bands * width)) {
    throw Error("An image of " + std::to_string(width) + " x " + std::to_string(height) +
                " texels could not be packed: there is no memory for it.");
  }
  return bytes;
}

}  // namespace lambert
