#include "Atlas/Core/DecodedImage.h"

#include <stb_image.h>

#include "Common/Core/Error.h"

namespace lambert {

DecodedImage::DecodedImage(const std::string& file) : codes(nullptr, stbi_image_free) {
  int bands = 0;
  codes.reset(stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(file.data()), int(file.size()),
                                    &width, &height, &bands, 4));
  if (!codes) throw Error("An image of the scene could not be decoded anew; save it as PNG.");
}

}  // namespace lambert
