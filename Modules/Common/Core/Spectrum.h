// Light in three linear bands, RGB (BT.709 primaries). The unit stands with each quantity:
// radiance W/(m2 sr), exitance / irradiance / radiosity W/m2, intensity W/sr, power W.
#pragma once

#include <algorithm>
#include <cmath>

namespace lambert {

constexpr double kPi = 3.14159265358979323846;
/// Lumen per watt: the one constant that joins photometric files to the radiometric solver.
constexpr double kLumensPerWatt = 683.0;
/// No surface reflects more than this, per band, in any method or reference.
constexpr float kMaximumReflectance = 0.98f;

struct Spectrum {
  float r = 0, g = 0, b = 0;

  Spectrum() = default;
  explicit constexpr Spectrum(float gray) : r(gray), g(gray), b(gray) {}
  constexpr Spectrum(float r_, float g_, float b_) : r(r_), g(g_), b(b_) {}

  float& operator[](int band) { return (&r)[band]; }
  float operator[](int band) const { return (&r)[band]; }
  Spectrum operator+(const Spectrum& s) const { return {r + s.r, g + s.g, b + s.b}; }
  Spectrum operator-(const Spectrum& s) const { return {r - s.r, g - s.g, b - s.b}; }
  Spectrum operator*(const Spectrum& s) const { return {r * s.r, g * s.g, b * s.b}; }
  Spectrum operator*(float s) const { return {r * s, g * s, b * s}; }
  Spectrum operator/(float s) const { return {r / s, g / s, b / s}; }
  Spectrum& operator+=(const Spectrum& s) { return *this = *this + s; }
  Spectrum& operator*=(float s) { return *this = *this * s; }
  bool operator==(const Spectrum& s) const { return r == s.r && g == s.g && b == s.b; }
  bool operator!=(const Spectrum& s) const { return !(*this == s); }

  float MaxBand() const { return std::max(r, std::max(g, b)); }
  float Mean() const { return (r + g + b) / 3; }
  bool IsBlack() const { return r <= 0 && g <= 0 && b <= 0; }
  bool IsFinite() const { return std::isfinite(r) && std::isfinite(g) && std::isfinite(b); }
};

inline Spectrum operator*(float s, const Spectrum& spectrum) { return spectrum * s; }
/// A sum over many.
struct SpectrumSum {
  double r = 0, g = 0, b = 0;

  void Add(const Spectrum& s, double weight = 1) {
    r += double(s.r) * weight, g += double(s.g) * weight, b += double(s.b) * weight;
  }
  Spectrum Total() const { return {float(r), float(g), float(b)}; }
};

/// Sum of the squares of the bands.
inline double SquaredNorm(const Spectrum& s) {
  return double(s.r) * s.r + double(s.g) * s.g + double(s.b) * s.b;
}

/// Luminance weight of linear RGB (ITU-R BT.709).
inline float Luminance(const Spectrum& s) { return 0.2126f * s.r + 0.7152f * s.g + 0.0722f * s.b; }
/// Illuminance in lux of an irradiance in W/m2.
inline float Lux(const Spectrum& irradiance) {
  return float(kLumensPerWatt) * Luminance(irradiance);
}
/// The linear value of an 8-bit sRGB code scaled to [0,1].
inline float LinearFromSrgb(float code) {
  return code <= 0.04045f ? code / 12.92f : std::pow((code + 0.055f) / 1.055f, 2.4f);
}
inline float SrgbFromLinear(float value) {
  return value <= 0.0031308f ? 12.92f * value : 1.055f * std::pow(value, 1 / 2.4f) - 0.055f;
}

}  // namespace lambert
