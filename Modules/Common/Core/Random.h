// Counter-based random numbers: a value depends on the seeds alone, never on the thread or on what
// was drawn before.
#pragma once

#include <cstdint>

#include "Common/Core/Spectrum.h"
#include "Common/Core/Vector.h"

namespace lambert {

/// Mixes 64 bits (splitmix64 finalizer).
inline uint64_t HashBits(uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}
inline uint64_t HashBits(uint64_t a, uint64_t b) { return HashBits(a ^ HashBits(b)); }

/// A stream of uniform numbers in [0,1), by seed.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(HashBits(seed)) {}
  uint64_t Bits() { return HashBits(state_ += 0x9e3779b97f4a7c15ull); }
  float Uniform() { return float(Bits() >> 40) * 0x1p-24f; }
  double UniformDouble() { return double(Bits() >> 11) * 0x1p-53; }

 private:
  uint64_t state_;
};

/// The bits of `i`, the last first.
constexpr uint32_t ReverseBits(uint32_t i) {
  i = (i << 16) | (i >> 16);
  i = ((i & 0x00ff00ffu) << 8) | ((i & 0xff00ff00u) >> 8);
  i = ((i & 0x0f0f0f0fu) << 4) | ((i & 0xf0f0f0f0u) >> 4);
  i = ((i & 0x33333333u) << 2) | ((i & 0xccccccccu) >> 2);
  return ((i & 0x55555555u) << 1) | ((i & 0xaaaaaaaau) >> 1);
}

/// Radical inverse of `i` in base 2, shifted (Cranley-Patterson) by `shift`, in [0,1).
inline float RadicalInverse(uint32_t i, float shift) {
  const float value = float(ReverseBits(i) >> 8) * 0x1p-24f + shift;
  return value < 1 ? value : value - 1;
}

/// Cosine-weighted direction about +z from two uniform numbers (pdf cos/pi).
inline Vec3f CosineHemisphere(float u, float v) {
  const float radius = std::sqrt(u), angle = float(2 * kPi) * v;
  return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(std::max(0.f, 1 - u))};
}

/// Barycentric coordinates (b1, b2) uniform over a triangle p0 + b1 (p1-p0) + b2 (p2-p0).
inline Vec2f UniformTriangle(float u, float v) {
  const float root = std::sqrt(u);
  return {root * (1 - v), root * v};
}

/// The place p0 + b1 (p1-p0) + b2 (p2-p0).
inline Vec3f PlaceOnTriangle(const Vec3f& p0, const Vec3f& p1, const Vec3f& p2, const Vec2f& b) {
  return p0 + (p1 - p0) * b.x + (p2 - p0) * b.y;
}

/// A place on a convex polygon, uniform in area where `u` and `v` are uniform in [0, 1].
inline Vec3f PlaceOnPolygon(const Vec3f* corners, int count, float u, float v) {
  const auto areaOf = [&](int i) {
    return Length(Cross(corners[i - 1] - corners[0], corners[i] - corners[0]));
  };
  float total = 0;
  for (int i = 2; i < count; ++i) total += areaOf(i);
  int triangle = 2;
  float left = u * total, area = areaOf(2);
  for (; triangle + 1 < count && left >= area; area = areaOf(++triangle)) left -= area;
  u = area > 0 ? std::min(1.f, left / area) : 0.5f;
  return PlaceOnTriangle(corners[0], corners[triangle - 1], corners[triangle],
                         UniformTriangle(u, v));
}

}  // namespace lambert
