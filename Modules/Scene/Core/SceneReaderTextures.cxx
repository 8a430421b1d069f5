#include "Scene/Core/SceneReaderTextures.h"

#include <stb_image.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "Common/Core/Error.h"
#include "Scene/Core/RadianceFile.h"

namespace lambert {

namespace {

/// Means over triangles need no finer image: larger ones are halved until they fit.
constexpr int kMaximumSize = 1024;
/// Samples along the longest edge of a triangle; larger footprints use a coarser level.
constexpr int kMaximumSamples = 32;

const std::array<float, 256>& SrgbTable() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (size_t code = 0; code < 256; ++code) values[code] = LinearFromSrgb(float(code) / 255);
    return values;
  }();
  return table;
}

TextureValue DecodeTexel(const unsigned char* rgba, const TextureDecoding& decoding) {
  const auto& srgb = SrgbTable();
  TextureValue texel;
  texel.colour = decoding.srgb ? Spectrum(srgb[rgba[0]], srgb[rgba[1]], srgb[rgba[2]])
                               : Spectrum(rgba[0], rgba[1], rgba[2]) / 255;
  texel.alpha = float(rgba[3]) / 255;
  if (decoding.alphaCutoff >= 0) texel.alpha = texel.alpha >= decoding.alphaCutoff ? 1.f : 0.f;
  return texel;
}

/// Index of the texel at coordinate `x` (1 is one image) along an axis of `size` texels.
int WrapTexel(double x, int size, TextureWrap wrap) {
  if (wrap == TextureWrap::Clamp) x = std::min(1.0, std::max(0.0, x));
  if (wrap == TextureWrap::Repeat) x -= std::floor(x);
  if (wrap == TextureWrap::Mirror) {
    x -= 2 * std::floor(x / 2);
    if (x > 1) x = 2 - x;
  }
  return std::min(size - 1, std::max(0, int(x * size)));
}

}  // namespace

std::string TextureLibrary::Key(const std::string& name, const TextureDecoding& decoding) {
  return name + (decoding.srgb ? "|srgb|" : "|linear|") + std::to_string(decoding.alphaCutoff);
}

int32_t TextureLibrary::AddFile(const std::string& path, const TextureDecoding& decoding) {
  const auto known = rows_.find(Key(path, decoding));
  if (known != rows_.end()) return known->second;
  files_.push_back(path);
  std::ifstream stream(path, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
  return AddMemory(path, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(),
                   decoding);
}

int32_t TextureLibrary::AddMemory(const std::string& name, const unsigned char* bytes, size_t size,
                                  const TextureDecoding& decoding) {
  const std::string key = Key(name, decoding);
  const auto known = rows_.find(key);
  if (known != rows_.end()) return known->second;

  // High dynamic range images hold linear values as they are.
  int width = 0, height = 0, channels = 0;
  if (IsRadiance(bytes, size)) {
    try {
      const RadiancePixels image = DecodeRadiance(bytes, size);
      Level level{image.width, image.height, std::vector<TextureValue>(image.texels.size())};
      for (size_t i = 0; i < level.texels.size(); ++i) level.texels[i].colour = image.texels[i];
      return Add(key, std::move(level));
    } catch (const Error&) {
      return NoteMissing(key, name);
    }
  }

  unsigned char* rgba =
      size > 0 ? stbi_load_from_memory(bytes, int(size), &width, &height, &channels, 4) : nullptr;
  if (!rgba) return NoteMissing(key, name);
  const int32_t row = AddPixels(name, width, height, rgba, decoding);
  stbi_image_free(rgba);
  if (row >= 0) {
    const std::string file(reinterpret_cast<const char*>(bytes), size);
    sources_[row] = std::make_shared<TextureSource>(TextureSource{name, file, decoding});
  }
  return row;
}

int32_t TextureLibrary::AddPixels(const std::string& name, int width, int height,
                                  const unsigned char* rgba, const TextureDecoding& decoding) {
  const std::string key = Key(name, decoding);
  const auto known = rows_.find(key);
  if (known != rows_.end()) return known->second;
  if (width <= 0 || height <= 0) return NoteMissing(key, name);
  Level level{width, height, std::vector<TextureValue>(size_t(width) * size_t(height))};
  for (size_t i = 0; i < level.texels.size(); ++i) {
    level.texels[i] = DecodeTexel(rgba + 4 * i, decoding);
  }
  return Add(key, std::move(level));
}

TextureLibrary::Level TextureLibrary::Halve(const Level& fine) {
  Level coarse{std::max(1, fine.width / 2), std::max(1, fine.height / 2), {}};
  coarse.texels.resize(size_t(coarse.width) * size_t(coarse.height));
  for (int y = 0; y < coarse.height; ++y) {
    for (int x = 0; x < coarse.width; ++x) {
      // The fine texels under this one; an odd row or column goes to the last.
      const int x0 = 2 * x, y0 = 2 * y;
      const int x1 = x + 1 == coarse.width ? fine.width : x0 + 2;
      const int y1 = y + 1 == coarse.height ? fine.height : y0 + 2;
      TextureValue sum{Spectrum(0.f), 0};
      for (int j = y0; j < y1; ++j) {
        for (int i = x0; i < x1; ++i) {
          const TextureValue& texel = fine.texels[size_t(j) * size_t(fine.width) + size_t(i)];
          sum.colour += texel.colour;
          sum.alpha += texel.alpha;
        }
      }
      const float count = float((x1 - x0) * (y1 - y0));
      coarse.texels[size_t(y) * size_t(coarse.width) + size_t(x)] = {sum.colour / count,
                                                                     sum.alpha / count};
    }
  }
  return coarse;
}

int32_t TextureLibrary::Add(const std::string& key, Level base) {
  while (std::max(base.width, base.height) > kMaximumSize) base = Halve(base);
  Pyramid pyramid{std::move(base)};
  while (pyramid.back().texels.size() > 1) pyramid.push_back(Halve(pyramid.back()));
  images_.push_back(std::move(pyramid));
  return rows_[key] = int32_t(images_.size()) - 1;
}

int32_t TextureLibrary::NoteMissing(const std::string& key, const std::string& name) {
  if (std::find(missing_.begin(), missing_.end(), name) == missing_.end()) missing_.push_back(name);
  return rows_[key] = -1;
}

std::shared_ptr<const TextureSource> TextureLibrary::Source(const TextureMap& map) const {
  const auto source = sources_.find(map.image);
  return source != sources_.end() ? source->second : nullptr;
}

const TextureValue& TextureLibrary::ImageMean(const TextureMap& map) const {
  return images_[size_t(map.image)].back().texels[0];
}

TextureValue TextureLibrary::TriangleMean(const TextureMap& map,
                                          const std::array<Vec2f, 3>& uvs) const {
  const Pyramid& pyramid = images_[size_t(map.image)];

  // The triangle in image coordinates.
  std::array<Vec2d, 3> corners;
  const auto& m = map.fromUv;
  for (size_t i = 0; i < 3; ++i) {
    const double u = uvs[i].x, v = uvs[i].y;
    corners[i] = {m[0] * u + m[1] * v + m[2], m[3] * u + m[4] * v + m[5]};
    if (!std::isfinite(corners[i].x) || !std::isfinite(corners[i].y)) {
      return ImageMean(map);
    }
  }

  // The level at which the longest edge spans no more texels than samples.
  const auto edge = [&](size_t i, const Level& level) {
    const Vec2d d = corners[(i + 1) % 3] - corners[i];
    return std::hypot(d.x * level.width, d.y * level.height);
  };
  size_t level = 0;
  double longest = 0;
  for (;; ++level) {
    longest = std::max({edge(0, pyramid[level]), edge(1, pyramid[level]), edge(2, pyramid[level])});
    if (longest <= kMaximumSamples || level + 1 == pyramid.size()) break;
  }

  // Mean over the n x n equal sub-triangles, four to a texel's width where they can be.
  const Level& texels = pyramid[level];
  const int n = int(std::min(double(kMaximumSamples), std::max(1.0, std::ceil(4 * longest))));
  TextureValue sum{Spectrum(0.f), 0};
  const auto add = [&](double b1, double b2) {
    const Vec2d p = corners[0] * (1 - b1 - b2) + corners[1] * b1 + corners[2] * b2;
    const int x = WrapTexel(p.x, texels.width, map.wrapU);
    const int y = WrapTexel(p.y, texels.height, map.wrapV);
    const TextureValue& texel = texels.texels[size_t(y) * size_t(texels.width) + size_t(x)];
    sum.colour += texel.colour;
    sum.alpha += texel.alpha;
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      add((i + 1 / 3.) / n, (j + 1 / 3.) / n);
      if (i + j + 1 < n) add((i + 2 / 3.) / n, (j + 2 / 3.) / n);
    }
  }
  const float count = float(n) * float(n);
  return {sum.colour / count, sum.alpha / count};
}

TextureValue TextureLibrary::Lookup(const TextureMap& map, const Vec2f& uv, double width) const {
  // The level: each has texels twice as wide as the one before.
  const Pyramid& pyramid = images_[size_t(map.image)];
  const double texels = width * std::sqrt(double(pyramid[0].width) * double(pyramid[0].height));
  const double octave = std::round(std::log2(std::max(1., texels)));
  const Level& level = pyramid[std::min(pyramid.size() - 1, size_t(octave))];

  // Between the middles of its texels, as glTF has it.
  const auto& m = map.fromUv;
  const double x = (m[0] * uv.x + m[1] * uv.y + m[2]) * level.width - 0.5;
  const double y = (m[3] * uv.x + m[4] * uv.y + m[5]) * level.height - 0.5;
  if (!std::isfinite(x) || !std::isfinite(y)) return ImageMean(map);
  const double left = std::floor(x), top = std::floor(y);
  TextureValue sum{Spectrum(0.f), 0};
  for (const int j : {0, 1}) {
    for (const int i : {0, 1}) {
      const int column = WrapTexel((left + i + 0.5) / level.width, level.width, map.wrapU);
      const int row = WrapTexel((top + j + 0.5) / level.height, level.height, map.wrapV);
      const TextureValue& texel = level.texels[size_t(row) * size_t(level.width) + size_t(column)];
      const float part =
          float((i == 0 ? 1 - (x - left) : x - left) * (j == 0 ? 1 - (y - top) : y - top));
      sum.colour += texel.colour * part;
      sum.alpha += texel.alpha * part;
    }
  }
  return sum;
}

}  // namespace lambert
