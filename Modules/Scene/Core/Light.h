// Light sources without geometry: rows of the light table.
#pragma once

#include <memory>
#include <string>

#include "Common/Core/Spectrum.h"
#include "Common/Core/Vector.h"

namespace lambert {

class EnvironmentImage;

enum class LightType {
  Point = 0,
  Spot = 1,
  Directional = 2,
  Sky = 3,
  GradientSky = 4,
  Environment = 5
};

struct Light {
  LightType type = LightType::Point;
  std::string name;
  Vec3f position;  ///< world space, m (point, spot)
  /// The way the light travels (spot, directional), unit; of skies the way down, from the zenith.
  Vec3f direction{0, 0, -1};
  /// Point and spot: intensity W/sr. Directional: irradiance W/m2 on a facet that faces it. Sky:
  /// radiance W/(m2 sr); of a gradient in the zenith, of an environment that of a texel of 1.
  Spectrum intensity;
  Spectrum horizon, ground;  ///< gradient sky: radiance at the horizon and below it, W/(m2 sr)
  std::string imageFile;     ///< environment: a Radiance HDR file
  std::shared_ptr<const EnvironmentImage> image;  ///< environment: what that file holds
  float rotation = 0;  ///< environment: its turn, radians, clockwise as seen from above
  /// Point and spot: radius of the ball that shines, m. Directional: angular diameter, radians,
  /// [0, pi).
  float size = 0;
  float innerConeAngle = 0;               ///< spot: half-angle of full intensity, radians
  float outerConeAngle = float(kPi) / 4;  ///< spot: half-angle where it ends, radians

  /// True for what gives no light.
  bool IsBlack() const {
    return intensity.IsBlack() &&
           (type != LightType::GradientSky || (horizon.IsBlack() && ground.IsBlack()));
  }
  /// True for what stands at a place (point, spot); the others are infinitely far.
  bool IsPlaced() const { return type == LightType::Point || type == LightType::Spot; }
  /// Fall-off of a spot in the unit direction `d` away from it, in [0,1] (glTF
  /// KHR_lights_punctual); 1 for others.
  float ConeFactor(const Vec3f& d) const {
    if (type != LightType::Spot) return 1;
    const float outer = std::cos(outerConeAngle);
    const float scale = 1 / std::max(0.001f, std::cos(innerConeAngle) - outer);
    const float t = std::min(1.f, std::max(0.f, (Dot(d, direction) - outer) * scale));
    return t * t;
  }
};

}  // namespace lambert
