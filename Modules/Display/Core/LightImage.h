// A picture of light as it is: linear, in W/m2.
#pragma once

#include <algorithm>
#include <vector>

#include "Common/Core/Spectrum.h"

namespace lambert {

struct LightImage {
  int width = 0, height = 0;
  std::vector<Spectrum> pixels;  ///< row after row from below

  /// The pixel that holds a place of [0, 1]^2, v upward; the nearest one of places outside.
  const Spectrum& At(float u, float v) const {
    const int x = std::clamp(int(u * float(width)), 0, width - 1);
    const int y = std::clamp(int(v * float(height)), 0, height - 1);
    return pixels[size_t(y) * size_t(width) + size_t(x)];
  }
};

/// The last level of a light map's mip map whose lookups inside charts take in no more than a
/// hundredth of what others differ by, where `padding` texels lie about each: lookups reach 1.5
/// texels of their level, and a texel less hardly shows. 0: the page itself.
inline int SafeMipLevel(int padding) {
  int level = 0;
  while (3 << level <= padding + 1) ++level;
  return level;
}

}  // namespace lambert
