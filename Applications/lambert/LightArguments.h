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

  void AddTo(CLI::App* command);
  /// Throws CLI::ValidationError where numbers are none that a sun may have.
  void Check() const;
  /// `up`: unit, of the scene.
  std::vector<Light> Lights(const Vec3f& up) const;
};

}  // namespace lambert
