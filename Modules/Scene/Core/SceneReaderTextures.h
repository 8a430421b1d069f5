// Images that colour surfaces: their means over triangles, as which they count for light, and
// lookups, for those who draw them.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "Common/Core/Spectrum.h"
#include "Common/Core/Vector.h"

namespace lambert {

enum class TextureWrap { Repeat, Mirror, Clamp };

/// How a material looks an image up.
struct TextureMap {
  int32_t image = -1;  ///< row of the library; -1: no texture
  int uvSet = 0;
  TextureWrap wrapU = TextureWrap::Repeat, wrapV = TextureWrap::Repeat;
  /// Image coordinates (u right, v down from the top left corner) of the mesh's uv (v up): two rows
  /// of an affine map.
  std::array<double, 6> fromUv{1, 0, 0, 0, -1, 1};

  explicit operator bool() const { return image >= 0; }
};

/// Colour and alpha, linear.
struct TextureValue {
  Spectrum colour{1.f};
  float alpha = 1;
};

/// What the bytes of an image mean.
struct TextureDecoding {
  bool srgb = true;  ///< 8-bit colours are sRGB codes; false: linear values
  float alphaCutoff =
      -1;  ///< from 0 up: alpha becomes 1 at or above it, 0 below (in each texel, before any mean)
};

/// An image as it came in.
struct TextureSource {
  std::string name;   ///< its file, or the scene's and its place in it
  std::string bytes;  ///< of an image file of 8-bit codes: PNG, JPEG, ...
  TextureDecoding decoding;
};

/// Decoded images with their mip maps; each is decoded once for each way to decode it.
class TextureLibrary {
 public:
  /// Row of the image in a file or in memory (`key` names it); -1 where it is missing or cannot be
  /// decoded.
  int32_t AddFile(const std::string& path, const TextureDecoding& decoding);
  int32_t AddMemory(const std::string& key, const unsigned char* bytes, size_t size,
                    const TextureDecoding& decoding);
  /// An image that is decoded already: width x height codes RGBA, top row first.
  int32_t AddPixels(const std::string& key, int width, int height, const unsigned char* rgba,
                    const TextureDecoding& decoding);

  /// Mean over the triangle with these mesh uvs, by area.
  TextureValue TriangleMean(const TextureMap& map, const std::array<Vec2f, 3>& uvs) const;

  /// Mean over the whole image.
  const TextureValue& ImageMean(const TextureMap& map) const;

  /// At mesh uv `uv`, bilinear between the texels of the level whose texels are about `width` wide;
  /// 1 is the root of the area of the image.
  TextureValue Lookup(const TextureMap& map, const Vec2f& uv, double width) const;

  /// The image as it came in; null where it came decoded or is of high dynamic range.
  std::shared_ptr<const TextureSource> Source(const TextureMap& map) const;

  /// The files that images were looked for in.
  const std::vector<std::string>& Files() const { return files_; }
  /// Names of the images that could not be read, each once.
  const std::vector<std::string>& Missing() const { return missing_; }

 private:
  struct Level {
    int width = 0, height = 0;
    std::vector<TextureValue> texels;
  };
  using Pyramid = std::vector<Level>;  ///< level 0 first, down to one texel

  static Level Halve(const Level& level);
  static std::string Key(const std::string& name, const TextureDecoding& decoding);
  int32_t Add(const std::string& key, Level base);
  int32_t NoteMissing(const std::string& key, const std::string& name);

  std::vector<Pyramid> images_;
  std::vector<std::string> files_;
  std::map<int32_t, std::shared_ptr<const TextureSource>> sources_;  ///< by row
  std::map<std::string, int32_t> rows_;
  std::vector<std::string> missing_;
};

}  // namespace lambert
