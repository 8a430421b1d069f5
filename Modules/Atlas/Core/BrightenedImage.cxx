#include "Atlas/Core/BrightenedImage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "Atlas/Core/DecodedImage.h"
#include "Atlas/Core/PngBytes.h"

namespace lambert {
namespace {

float LinearOf(size_t code) { return LinearFromSrgb(float(code) / 255); }

}  // namespace

Spectrum RoomAbove(const std::string& file, float alphaCutoff) {
  // The brightest code of every band.
  const DecodedImage image(file);
  const uint8_t* codes = image.codes.get();
  std::array<uint8_t, 3> most = {0, 0, 0};
  for (size_t texel = 0; texel < image.CodeCount(); texel += 4) {
    if (float(codes[texel + 3]) < alphaCutoff * 255) continue;
    for (size_t band = 0; band < 3; ++band) most[band] = std::max(most[band], codes[texel + band]);
  }

  Spectrum room(1);
  for (int band = 0; band < 3; ++band) {
    if (most[size_t(band)] > 0) room[band] = std::max(1.f, 1 / LinearOf(most[size_t(band)]));
  }
  return room;
}

std::string Brightened(const std::string& file, const Spectrum& factor) {
  std::array<std::array<uint8_t, 256>, 3> brighter;
  for (int band = 0; band < 3; ++band) {
    for (size_t code = 0; code < 256; ++code) {
      const float linear = std::min(1.f, factor[band] * LinearOf(code));
      brighter[size_t(band)][code] = uint8_t(std::lround(255 * SrgbFromLinear(linear)));
    }
  }
  const DecodedImage image(file);
  uint8_t* codes = image.codes.get();
  for (size_t texel = 0; texel < image.CodeCount(); texel += 4) {
    for (size_t band = 0; band < 3; ++band)
      codes[texel + band] = brighter[band][codes[texel + band]];
  }
  return PngBytes(image.width, image.height, 4, codes);
}

}  // namespace lambert
