#include "PngImage.h"

#include "Atlas/Core/DecodedImage.h"
#include "Atlas/Core/PngBytes.h"

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
  const DecodedImage image(file);
  return PngBytes(image.width, image.height, 4, image.codes.get());
}
}  // namespace lambert
