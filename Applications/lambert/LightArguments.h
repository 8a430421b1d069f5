// The lights that the command line adds to a scene: a sun and a sky.
#pragma once

#include <string>
#include <vector>

#include "Scene/Core/Light.h"

namespace CLI {
class App;
}

namespace lambert {

struct LightArguments {
  std::vector<float> sun;     ///< azimuth and elevation, degrees; R G B, W/m2
  float sunDiameter = 0.53f;  ///< degrees
  std::vector<float> sky;     ///< R G B, W/(m2 sr)

  std::vector<float> skyGradient;  ///< R G B in the zenith and at the horizon, W/(m2 sr)
  std::vector<float> ground;       ///< R G B below the horizon, W/(m2 sr)
  std::string environment;         ///< file
  float environmentScale = 1, environmentRotation = 0;  ///< degrees

  void AddTo(CLI::App* command);
  /// Throws CLI::ValidationError where numbers are none that a sun may have.
  void Check() const;
  /// `up`: unit, of the scene. Throws Error for an image that cannot be read.
  std::vector<Light> Lights(const Vec3f& up) const;
};

}  // namespace lambert
