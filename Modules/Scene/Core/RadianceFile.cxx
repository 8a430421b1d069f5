#include "Scene/Core/RadianceFile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "Common/Core/Error.h"

namespace lambert {

namespace {

constexpr int64_t kMostTexels = int64_t(1) << 28;
/// Stored band by band a byte holds fewer texels than this: 127 take eight.
constexpr size_t kMostTexelsOfByte = 64;
/// Rows as wide as this may be stored band by band.
constexpr int kLeastBandWidth = 8, kMostBandWidth = 0x7fff;

using Rgbe = std::array<uint8_t, 4>;

/// Mantissas of eight bits and the exponent that they share.
Spectrum ToSpectrum(const Rgbe& pixel) {
  if (pixel[3] == 0) return {};
  const float unit = std::ldexp(1.f, int(pixel[3]) - (128 + 8));
  return {float(pixel[0]) * unit, float(pixel[1]) * unit, float(pixel[2]) * unit};
}

class Bytes {
 public:
  Bytes(const unsigned char* bytes, size_t size) : at_(bytes), end_(bytes + size) {}

  uint8_t Next() {
    if (at_ == end_) throw Error("is cut off");
    return *at_++;
  }
  Rgbe NextPixel() {
    Rgbe pixel;
    for (uint8_t& byte : pixel) byte = Next();
    return pixel;
  }
  std::string Line() {
    std::string line;
    for (uint8_t c = Next(); c != '\n'; c = Next()) line += char(c);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return line;
  }
  /// True, and read, where a row of that width begins that is stored band by band.
  bool BeginsBands(int width) {
    if (width < kLeastBandWidth || width > kMostBandWidth || end_ - at_ < 4) return false;
    if (at_[0] != 2 || at_[1] != 2 || at_[2] != width >> 8 || at_[3] != (width & 0xff)) {
      return false;
    }
    at_ += 4;
    return true;
  }

 private:
  const unsigned char* at_;
  const unsigned char* const end_;
};

/// Each band in runs of one value and stretches of others.
void ReadBands(Bytes* bytes, int width, std::vector<Rgbe>* row) {
  constexpr int kRun = 128;
  row->resize(size_t(width));
  for (size_t band = 0; band < 4; ++band) {
    for (int x = 0; x < width;) {
      int count = bytes->Next();
      const bool isRun = count > kRun;
      if (isRun) count -= kRun;
      if (count == 0 || count > width - x) throw Error("is damaged");
      uint8_t value = isRun ? bytes->Next() : 0;
      for (; count > 0; --count, ++x) {
        if (!isRun) value = bytes->Next();
        (*row)[size_t(x)][band] = value;
      }
    }
  }
}

/// Pixels; one of mantissas 1 says how often the one before comes again, each such one behind
/// another a digit to base 256.
void ReadPixels(Bytes* bytes, int width, std::vector<Rgbe>* row) {
  row->clear();
  int shift = 0;
  while (int64_t(row->size()) < width) {
    const Rgbe pixel = bytes->NextPixel();
    if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
      row->push_back(pixel);
      shift = 0;
      continue;
    }
    const int64_t count = shift <= 16 ? int64_t(pixel[3]) << shift : width;
    if (row->empty() || count > width - int64_t(row->size())) throw Error("is damaged");
    row->resize(row->size() + size_t(count), Rgbe(row->back()));
    shift += 8;
  }
}

/// The lines before the pixels; `exposure` by which they were multiplied.
void ReadHeader(Bytes* bytes, int* width, int* height, double* exposure) {
  if (bytes->Line().substr(0, 2) != "#?") throw Error("is no Radiance HDR file");
  for (std::string line = bytes->Line(); !line.empty(); line = bytes->Line()) {
    if (line.substr(0, 7) == "FORMAT=" && line != "FORMAT=32-bit_rle_rgbe") {
      throw Error("holds no RGB, but " + line.substr(7));
    }
    if (line.substr(0, 9) == "EXPOSURE=") *exposure *= std::strtod(line.c_str() + 9, nullptr);
  }
  if (!(*exposure > 0 && std::isfinite(*exposure))) throw Error("has an exposure of no meaning");
  if (std::sscanf(bytes->Line().c_str(), "-Y %d +X %d", height, width) != 2) {
    throw Error("is not stored in rows from above and from the left");
  }
  if (*width < 1 || *height < 1 || int64_t(*width) * *height > kMostTexels) {
    throw Error("is damaged or too large");
  }
}

}  // namespace

bool IsRadiance(const unsigned char* bytes, size_t size) {
  const std::string begin(reinterpret_cast<const char*>(bytes), std::min<size_t>(size, 10));
  return begin == "#?RADIANCE" || begin.substr(0, 6) == "#?RGBE";
}

RadiancePixels DecodeRadiance(const unsigned char* bytes, size_t size) {
  Bytes left(bytes, size);
  RadiancePixels image;
  double exposure = 1;
  ReadHeader(&left, &image.width, &image.height, &exposure);

  // Room for no more than the bytes hold band by band; runs of pixels may hold more.
  image.texels.reserve(
      std::min(size_t(image.width) * size_t(image.height), size * kMostTexelsOfByte));

  // Rows, each stored in a way of its own.
  std::vector<Rgbe> row;
  for (int y = 0; y < image.height; ++y) {
    if (left.BeginsBands(image.width)) {
      ReadBands(&left, image.width, &row);
    } else {
      ReadPixels(&left, image.width, &row);
    }
    for (const Rgbe& pixel : row) image.texels.push_back(ToSpectrum(pixel) * float(1 / exposure));
  }
  return image;
}

}  // namespace lambert
