#include "PngImage.h"

#include "Atlas/Core/PngBytes.h"
#include "Common/Core/Error.h"

#include <stb_image.h>

#include <memory>

namespace lambert {
namespace {
bool BeginsWith(const std::string& bytes, const char* beginning) {
  return bytes.rfind(beginning, 0) == 0;
}
}  // namespace

std::string PngOf(const LitImage& image) {
  return PngBytes(image.width, image.height, 3, image.codes.data());
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
  return PngBytes(width, height, 4, codes.get());
}
}  // namespace lambert
