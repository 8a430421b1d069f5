// What `atlas` is asked for.
#pragma once

#include <string>
#include <vector>

#include "Atlas/Core/RadiosityAtlas.h"
#include "ProgressStyle.h"
#include "SceneArguments.h"

namespace CLI {
class Option;
}

namespace lambert {

struct OutputOfRun;

/// How charts are cut and packed.
std::vector<CLI::Option*> AddAtlasOptions(CLI::App* command, AtlasOptions* atlas);

struct AtlasArguments {
  SceneArguments scene;
  std::string output, image, report;
  AtlasOptions atlas;
  int threads = 0;
  ProgressStyle progress = ProgressStyle::Auto;

  void AddTo(CLI::App* command);
  /// Throws CLI::ValidationError where names have the wrong ending or name one file twice.
  void Check() const;
  /// All files that may come out.
  std::vector<OutputOfRun> Outputs() const;
};

}  // namespace lambert
