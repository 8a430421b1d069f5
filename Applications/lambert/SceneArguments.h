// How files are read and cleaned.
#pragma once

#include <string>
#include <vector>

#include "Engine/RadiosityRun.h"

namespace CLI {
class App;
}

namespace lambert {

/// Options that all commands share.
struct SceneArguments {
  std::vector<std::string> files;
  std::string unit;
  std::vector<float> reflectance{0.5f, 0.5f, 0.5f};
  std::string metals = "base";
  std::vector<std::string> settings;
  bool twoSidedEmitters = false, opaqueGlass = false;
  bool noWeld = false, noZeroArea = false, noRepeated = false, noOrient = false,
       noEmitterFix = false;
  double featureAngle = CleaningOptions().featureAngle;

  void AddTo(CLI::App* command);
  void Apply(RadiosityRunOptions* options) const;
};

struct InfoArguments {
  SceneArguments scene;
  bool json = false;

  void AddTo(CLI::App* command);
};

}  // namespace lambert
