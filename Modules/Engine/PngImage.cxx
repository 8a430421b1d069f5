#include "PngImage.h"

#include "Common/Core/Error.h"

#include <stb_image.h>
#include <stb_image_write.h>

#include <memory>

namespace lambert {
namespace {
/// `codes` of `bands` bands, row after row from above.
std::string Pack(int width, int height, int bands, const unsigned char* codes) {
  std::string bytes;
  const auto append = [](void* context, void* data, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data),
                                               static_cast<size_t>(size));
  };
  if (!stbi_write_png_to_func(append, &bytes, width, height, bands, codes, bands * width)) {
    throw Error("An image of " + std::to_string(width) + " x " + std::to_string(height) +
                " texels could not be packed: there is no memory for it.");
  }
  return bytes;
}

bool BeginsWith(const std::string& bytes, const char* beginning) {
  return bytes.rfind(beginning, 0) == 0;
}
}  // namespace

std::string PngOf(const LitImage& image) {
  return Pack(image.width, image.height, 3, image.codes.data());
}

bool IsJpeg(const std::string& file) { return BeginsWith(file, "\xff\xd8\xff"); }

std::string ViewerImageOf(const std::string& file) {
  if (IsJpeg(file) || BeginsWith(file, "\x89PNG")) {
    return file;
  }
  int width = 0, height = 0, bands = 0;
  const std::unique_ptr<stbi_uc, void (*)(void*)> codes(
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(file.data()),
                            static_cast<int>(file.size()), &width, &height, &bands, 4),
      stbi_image_free);
  if (!codes) {
    throw Error("An image of the scene could not be decoded anew; save it as PNG.");
  }
  return Pack(width, height, 4, codes.get());
}
}  // namespace lambert
