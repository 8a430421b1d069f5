#include "PngImage.h"

#include "Common/Core/Error.h"

#include <stb_image_write.h>

namespace lambert {
std::string PngOf(const LitImage& image) {
  std::string bytes;
  const auto append = [](void* context, void* data, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data),
                                               static_cast<size_t>(size));
  };
  if (!stbi_write_png_to_func(append, &bytes, image.width, image.height, 3, image.codes.data(),
                              3 * image.width)) {
    throw Error("The image \"" + image.name + "\" could not be packed: there is no memory for it.");
  }
  return bytes;
}
}  // namespace lambert
