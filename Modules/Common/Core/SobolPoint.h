// Points that fill a square evenly, however many of them there are.
#pragma once

#include <cstdint>

#include "Common/Core/Random.h"
#include "Common/Core/Vector.h"

namespace lambert {

/// What each byte of a number adds to the second dimension of Sobol's sequence, by its value.
struct SobolBytes {
  uint32_t part[4][256] = {};

  constexpr SobolBytes() {
    uint32_t direction = 1u << 31;
    for (auto& ofByte : part) {
      for (uint32_t bit = 1; bit < 256; bit <<= 1) {
        for (uint32_t value = 0; value < 256; ++value) ofByte[value] ^= value & bit ? direction : 0;
        direction ^= direction >> 1;
      }
    }
  }
};
inline constexpr SobolBytes kSobolBytes;

/// The first two dimensions of Sobol's sequence, its bits flipped by those of `scramble`: in every
/// aligned block of 2^k numbers one in each box of area 2^-k.
inline Vec2f SobolPoint(uint32_t index, uint64_t scramble) {
  const auto& part = kSobolBytes.part;
  const uint32_t x = ReverseBits(index);
  const uint32_t y = part[0][index & 255] ^ part[1][index >> 8 & 255] ^ part[2][index >> 16 & 255] ^
                     part[3][index >> 24];
  return {float((x ^ uint32_t(scramble)) >> 8) * 0x1p-24f,
          float((y ^ uint32_t(scramble >> 32)) >> 8) * 0x1p-24f};
}

}  // namespace lambert
