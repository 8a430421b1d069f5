// Radiance by direction from a picture of everything around.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "Common/Core/Spectrum.h"
#include "Common/Core/Vector.h"
#include "Scene/Core/Light.h"

namespace lambert {

/// A direction as an environment image sees it: `azimuth` in radians, clockwise from the middle
/// of the image as seen from above, and the sine of the elevation.
struct ImageDirection {
  double azimuth = 0, sine = 0;
};

/// An equirectangular image: rows from the zenith down in even steps of angle, columns clockwise
/// all around. Radiance is constant within a texel, so that every integral over it is a sum.
class EnvironmentImage {
 public:
  /// `texels`: width x height, W/(m2 sr) of a scale of one's own, the uppermost row first. Throws
  /// Error where there are none, or one is negative or not finite.
  EnvironmentImage(int width, int height, std::vector<Spectrum> texels);

  int Count() const { return width_ * height_; }
  const Spectrum& Texel(int index) const { return texels_[size_t(index)]; }
  double SolidAngle(int index) const;  ///< of a texel, sr
  /// The texel in a direction.
  int IndexOf(const ImageDirection& direction) const;
  /// The place at `u` in [0,1)^2 of a texel, uniform over its solid angle.
  ImageDirection PlaceOn(int index, const Vec2f& u) const;
  /// Mean over all directions.
  Spectrum Mean() const { return mean_; }

 private:
  double SineAbove(int row) const;  ///< of the elevation of the upper edge of a row

  int width_, height_;
  std::vector<Spectrum> texels_;
  Spectrum mean_;
};

/// Reads a Radiance HDR file. Throws Error where it is none or cannot be read.
std::shared_ptr<const EnvironmentImage> ReadEnvironmentImage(const std::string& fileName);
/// Reads those of all environments among `lights`, from the files that they name.
void ReadEnvironmentImages(std::vector<Light>* lights);

}  // namespace lambert
