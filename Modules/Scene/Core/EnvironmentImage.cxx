#include "Scene/Core/EnvironmentImage.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "Common/Core/Error.h"
#include "Scene/Core/RadianceFile.h"
#include "Scene/Core/SceneLimits.h"

namespace lambert {

EnvironmentImage::EnvironmentImage(int width, int height, std::vector<Spectrum> texels)
    : width_(width), height_(height), texels_(std::move(texels)) {
  if (width < 1 || height < 1 || texels_.size() != size_t(Count())) {
    throw Error("An environment image needs at least one texel.");
  }
  double sum[3] = {};
  for (int i = 0; i < Count(); ++i) {
    const Spectrum& texel = Texel(i);
    if (!IsSolvable(texel)) {
      throw Error("An environment image has a texel that is negative, not a number or over 1e30.");
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
  std::ifstream file(fileName, std::ios::binary);
  const std::vector<char> content{std::istreambuf_iterator<char>(file), {}};
  const auto* const bytes = reinterpret_cast<const unsigned char*>(content.data());
  if (!IsRadiance(bytes, content.size())) {
    throw Error(name + " is not there or not a Radiance HDR file (.hdr); give one.");
  }
  RadiancePixels image;
  try {
    image = DecodeRadiance(bytes, content.size());
  } catch (const Error& error) {
    throw Error(name + " " + error.what() + "; give a whole one.");
  }
  return std::make_shared<const EnvironmentImage>(image.width, image.height,
                                                  std::move(image.texels));
}

void ReadEnvironmentImages(std::vector<Light>* lights) {
  for (Light& light : *lights) {
    if (light.type == LightType::Environment) light.image = ReadEnvironmentImage(light.imageFile);
  }
}

}  // namespace lambert
