#include "Scene/Core/EnvironmentImage.h"

#include <stb_image.h>

#include <algorithm>
#include <cmath>

#include "Common/Core/Error.h"

namespace lambert {

EnvironmentImage::EnvironmentImage(int width, int height, std::vector<Spectrum> texels)
    : width_(width), height_(height), texels_(std::move(texels)) {
  if (width < 1 || height < 1 || texels_.size() != size_t(Count())) {
    throw Error("An environment image needs at least one texel.");
  }
  double sum[3] = {};
  for (int i = 0; i < Count(); ++i) {
    const Spectrum& texel = Texel(i);
    if (!texel.IsFinite() || std::min({texel.r, texel.g, texel.b}) < 0) {
      throw Error("An environment image has a texel that is negative or not a finite number.");
    }
    for (int band = 0; band < 3; ++band) sum[band] += double(texel[band]) * SolidAngle(i);
  }
  for (int band = 0; band < 3; ++band) mean_[band] = float(sum[band] / (4 * kPi));
}

double EnvironmentImage::SineAbove(int row) const { return std::cos(kPi * row / height_); }

double EnvironmentImage::SolidAngle(int index) const {
  const int row = index / width_;
  return 2 * kPi / width_ * (SineAbove(row) - SineAbove(row + 1));
}

int EnvironmentImage::IndexOf(const ImageDirection& direction) const {
  const double down = std::acos(std::clamp(direction.sine, -1.0, 1.0)) / kPi;
  const double around = 0.5 + direction.azimuth / (2 * kPi);
  const int row = std::min(height_ - 1, int(down * height_));
  const int column = std::min(width_ - 1, int((around - std::floor(around)) * width_));
  return row * width_ + column;
}

ImageDirection EnvironmentImage::PlaceOn(int index, const Vec2f& u) const {
  const int row = index / width_, column = index % width_;
  const double above = SineAbove(row), below = SineAbove(row + 1);
  return {((column + double(u.x)) / width_ - 0.5) * 2 * kPi, above + (below - above) * double(u.y)};
}

std::shared_ptr<const EnvironmentImage> ReadEnvironmentImage(const std::string& fileName) {
  const std::string name = "The environment image " + fileName;
  if (!stbi_is_hdr(fileName.c_str())) {
    throw Error(name + " is not there or not a Radiance HDR file (.hdr); give one.");
  }
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<float, void (*)(void*)> pixels(
      stbi_loadf(fileName.c_str(), &width, &height, &channels, 3), stbi_image_free);
  if (!pixels) throw Error(name + " is damaged or too large.");
  std::vector<Spectrum> texels(size_t(width) * size_t(height));
  for (size_t i = 0; i < texels.size(); ++i) {
    const float* const p = pixels.get() + 3 * i;
    texels[i] = {p[0], p[1], p[2]};
  }
  return std::make_shared<const EnvironmentImage>(width, height, std::move(texels));
}

}  // namespace lambert
