// What `solve` is asked for.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "Atlas/Core/LightMapPages.h"
#include "AtlasArguments.h"
#include "Display/Core/ToneMapping.h"
#include "Display/Core/UpAxis.h"
#include "Engine/RadiosityRun.h"
#include "LightArguments.h"
#include "Scene/Core/Scene.h"
#include "SceneArguments.h"

namespace CLI {
class App;
}

namespace lambert {

struct OutputOfRun;

struct SolveArguments {
  SceneArguments scene;
  std::string output;
  SolveMethodOptions method;
  double elementSize = 0;
  uint64_t seed = PathTracedBakeOptions().seed;
  HierarchicalRadiosityOptions solver;
  double time = 0;
  int threads = 0;
  LightArguments lights;
  std::string probe, probeOutput, image, size = "960x720", camera, up = "auto", report, lightMap,
                                         verifyOutput;
  std::optional<LitMeshSimplificationOptions> simplification;
  std::vector<PageFormat> pageFormats{PageFormat::Hdr};
  AtlasOptions atlas;
  std::string atlasFile;  ///< that the light map is drawn on, in place of one by `atlas`
  LitModelOptions model;  ///< of glTF and HTML, without its tone
  std::optional<int64_t> introducedTriangles;
  bool splitSurfaces = false;
  WantedRepresentations representations;
  bool probeGather = false, bothSides = false;
  ToneMappingOptions tone;
  bool dodgingAndBurning = false;
  std::string falseColors;
  std::vector<double> falseColorRange;
  int falseColorSteps = 0;
  bool isolines = false;
  ProgressStyle progress = ProgressStyle::Auto;
  int verifyPoints = 0;

  void AddTo(CLI::App* command);
  /// Throws CLI::ValidationError where options contradict each other or do not parse.
  void Check() const;
  /// Width and height in pixels.
  std::array<int, 2> ImageSize() const;
  /// What is up in `mesh`, for pictures, sun and skies: as asked for, y where all files are glTF,
  /// else guessed.
  UpAxis UpOf(const TriangleMesh& mesh) const;
  /// The camera that was asked for, if any.
  std::optional<Camera> ImageCamera(UpAxis imageUp) const;
  RadiosityRunOptions RunOptions() const;
  /// All files that may come out, those of as many pages as there can be.
  std::vector<OutputOfRun> Outputs() const;

 private:
  void AddMethodsTo(CLI::App* command);
  void AddOutputsTo(CLI::App* command);
  /// Pages that a light map may have.
  int MostPages() const;
  /// Throws CLI::ValidationError where an option was given that is another method's.
  void RequireOptionsOfMethod() const;
  /// Throws CLI::ValidationError where an option was given that an atlas of a file decides.
  void RequireOptionsOfAtlas() const;
  /// Throws CLI::ValidationError where an option was given of which no output would have anything.
  void RequireOptionsOfOutputs() const;

  CLI::App* command_ = nullptr;
};

}  // namespace lambert
