// Images of files, decoded to codes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace lambert {

/// RGBA codes of 8 bits, row after row from above.
struct DecodedImage {
  int width = 0, height = 0;
  std::unique_ptr<uint8_t, void (*)(void*)> codes;

  /// Of the bytes of an image file. Throws Error for what cannot be decoded.
  explicit DecodedImage(const std::string& file);
  size_t CodeCount() const { return size_t(width) * size_t(height) * 4; }
};

}  // namespace lambert
