#include "SolveArguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <set>

#include "ArgumentChecks.h"
#include "Common/Core/CollectionFile.h"
#include "Common/Core/FileEnding.h"
#include "Engine/LitModelFile.h"
#include "Engine/ObjFile.h"
#include "Engine/PolyDataFile.h"
#include "Engine/SolutionFile.h"
#include "FilesOfRun.h"

namespace lambert {
namespace {

/// Of a name that was checked to be one of a method.
SolveMethod MethodOfName(const std::string& name) {
  return std::find_if(SolveMethods().begin(), SolveMethods().end(),
                      [&](const SolveMethodTraits& traits) { return traits.name == name; })
      ->method;
}

/// How hierarchical radiosity refines links and splits triangles.
void AddRefinementOptions(CLI::App* command, HierarchicalRadiosityOptions* solver) {
  std::map<std::string, OracleKind> oracles;
  for (const OracleKind kind : kOracleKinds) oracles[OracleName(kind)] = kind;
  command
      ->add_option_function<std::string>(
          "--oracle", [=](const std::string& name) { solver->oracle = oracles.at(name); },
          "What judges links")
      ->check(CLI::IsMember(oracles))
      ->default_str(OracleName(solver->oracle));
  command
      ->add_option_function<std::string>(
          "--schedule",
          [=](const std::string& name) {
            solver->schedule = name == "interleaved" ? Schedule::Interleaved : Schedule::Scheduled;
          },
          "Light settles between refinements, or bounces once after each")
      ->check(CLI::IsMember({"scheduled", "interleaved"}))
      ->default_str("scheduled");
  LeafMeshOptions* leafMesh = &solver->leafMesh;
  command
      ->add_option_function<std::string>(
          "--refinement",
          [=](const std::string& name) {
            leafMesh->refinement =
                name == "quadtree" ? PatchRefinement::Quadtree : PatchRefinement::Rectangle;
          },
          "Triangles are split across their minimum-area rectangle, or regularly into four")
      ->check(CLI::IsMember({"rectangle", "quadtree"}))
      ->default_str("rectangle");
  command
      ->add_option("--snap-tolerance", leafMesh->snapTolerance,
                   "Splitting lines move to vertices within this part of the rectangle, [0, 0.499]")
      ->check(Within(0, 0.499, "from 0 to 0.499"))
      ->capture_default_str();
}

}  // namespace

void SolveArguments::AddTo(CLI::App* command) {
  command_ = command;
  scene.AddTo(command);

  // How.
  command
      ->add_option("-o,--output", output,
                   "Solved scene, .vtp, .vtpc, .ply, .glb, .gltf, .html or .obj")
      ->required();
  this->AddMethodsTo(command);
  command->add_option("--threads", threads, "Threads; 0: all processors")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  lights.AddTo(command);

  this->AddOutputsTo(command);
}

void SolveArguments::AddMethodsTo(CLI::App* command) {
  std::vector<std::string> names;
  for (const SolveMethodTraits& traits : SolveMethods()) names.push_back(traits.name);
  command
      ->add_option_function<std::string>(
          "--method", [this](const std::string& name) { method.method = MethodOfName(name); },
          "How to solve")
      ->check(CLI::IsMember(names))
      ->default_str(names.front());
  command->add_option("--samples", method.reference.samples, "Reference: paths a vertex")
      ->check(CLI::Range(1, 100000000))
      ->capture_default_str();
  command
      ->add_option("--element-size", elementSize,
                   "Matrix, progressive, cached: longest edge, m; 0: 1/50 of the scene's diagonal")
      ->check(NotNegative())
      ->capture_default_str();
  command
      ->add_option("--output-size", method.cached.outputSize,
                   "Cached: longest edge of the output, m; 0: the element size")
      ->check(NotNegative())
      ->capture_default_str();
  command->add_option("--paths", method.cached.paths, "Cached: paths an element's side")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_option("--gather-rays", method.cached.gatherRays, "Cached: rays a point")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command
      ->add_option("--emitter-rays", method.cached.emitterRays,
                   "Cached: rays a point to emitting faces")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_option("--seed", seed, "Reference, cached: another seed, another choice of paths")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();

  // How well and how long, of hierarchical radiosity.
  command->add_option("--error", solver.error, "Wanted relative RMS error of irradiance, [1e-6, 1]")
      ->check(Within(1e-6, 1, "from 1e-6 to 1"))
      ->capture_default_str();
  command->add_option("--time", time, "Seconds since the program began, writing included")
      ->check(Within(1e-3, 1e9, "from 0.001 to 1e9"));
  command->add_option("--max-memory", solver.memoryLimit, "MB of the process, writing included")
      ->check(Within(1, 1e9, "from 1 to 1e9"));
  command->add_option("--iterations", solver.iterations, "Iterations after which to end")
      ->check(CLI::Range(1, 1000000));
  command->add_flag("!--no-final-gather", solver.finalGather,
                    "Deliver what links brought, without gathering anew at the points");
  AddRefinementOptions(command, &solver);
  command->add_option("--save-state", solver.saveState,
                      "File that gets all that a later run needs to go on from here");
  command->add_option("--resume", solver.resume, "File of --save-state that this run goes on from");
}

void SolveArguments::Check() const {
  RequireOptionsOfMethod();
  lights.Check();
  RequireOptionsOfOutputs();
  RequireOptionsOfAtlas();
  if (probe.empty() != probeOutput.empty()) {
    throw CLI::ValidationError("--probe", "--probe and --probe-output belong together");
  }
  RequirePngName(image);
  if (!falseColorRange.empty() && !(falseColorRange[1] > falseColorRange[0])) {
    throw CLI::ValidationError("--range", "goes from a number up to a larger one");
  }
  FilesOfRun files(scene.files);
  files.AddInput("--probe", probe);
  if (solver.resume != solver.saveState) files.AddInput("--resume", solver.resume);
  files.AddInput("--environment", lights.environment);
  files.AddInput("--atlas", atlasFile);
  if (!lightMap.empty() && !IsPolyDataFileName(lightMap)) {
    throw CLI::ValidationError("--lightmap", "the name has to end in .vtp or .vtpc");
  }
  files.AddOutputs(this->Outputs());
  ImageSize();
  ImageCamera(UpAxis::Y);
}

std::vector<OutputOfRun> SolveArguments::Outputs() const {
  std::vector<OutputOfRun> outputs = {{"--output", output, true},
                                      {"--probe-output", probeOutput},
                                      {"--verify-output", verifyOutput},
                                      {"--image", image},
                                      {"--report", report},
                                      {"--lightmap", lightMap, true},
                                      {"--save-state", solver.saveState}};
  const auto add = [&](const char* option, const std::vector<std::string>& names) {
    for (const std::string& name : names) outputs.push_back({option, name});
  };
  if (FileEnding(output) == ".obj") {
    add("--output", FilesBesideObj(output, this->MostPages()));
  }
  if (!lightMap.empty()) {
    for (const PageFormat format : std::set<PageFormat>(pageFormats.begin(), pageFormats.end())) {
      add("--lightmap", LightMapPageNames(lightMap, this->MostPages(), format));
    }
  }
  return outputs;
}

void SolveArguments::RequireOptionsOfOutputs() const {
  const auto refuse = [](bool isWrong, const char* option, const char* sentence) {
    if (isWrong) throw CLI::ValidationError(option, sentence);
  };
  const bool isModel = IsLitModelFileName(output), isObj = FileEnding(output) == ".obj";

  // Of the solved scene.
  refuse(!IsSolutionFileName(output) && !isModel, "--output",
         "the name has to end in .vtp, .vtpc, .ply, .glb, .gltf, .html or .obj");
  refuse(bothSides && FileEnding(output) != ".ply", "--both-sides",
         "is for PLY; all other outputs have both sides as it is");

  // Of textures.
  const bool isSizeGiven = command_->count("--baked-size") > 0;
  refuse(model.keepTextures && isObj, "--keep-textures",
         "OBJ has no light beside a texture; leave it to glTF and HTML");
  refuse(model.keepTextures && !isModel, "--keep-textures",
         "is for glTF and HTML; no other output has textures to keep");
  refuse(isSizeGiven && !isModel, "--baked-size",
         "is for glTF, HTML and OBJ; textures are baked into no other output");
  refuse(isSizeGiven && model.keepTextures, "--baked-size",
         "nothing is baked where --keep-textures keeps the textures");

  // Of pictures.
  refuse(dodgingAndBurning && (image.empty() || !falseColors.empty()), "--tone",
         "local is for a picture alone; give --image, without --false-colors");
  refuse(command_->count("--size") > 0 && image.empty(), "--size",
         "is for --image; no other output has pixels");
  const bool isSeen = !image.empty() || (isModel && !isObj);
  refuse(!camera.empty() && !isSeen, "--camera",
         "is for --image, glTF and HTML; no other output is seen from one place");

  // Of colours.
  const bool isPicture = !image.empty() && falseColors.empty();
  const bool arePagesPng =
      !lightMap.empty() && std::count(pageFormats.begin(), pageFormats.end(), PageFormat::Png) > 0;
  const bool isToned = isPicture || isModel || FileEnding(output) == ".ply" || arePagesPng;
  for (const char* option : {"--tone", "--key", "--exposure", "--ev", "--white"}) {
    refuse(command_->count(option) > 0 && !isToned, option,
           "is for --image without --false-colors, PLY, glTF, HTML, OBJ and --page-format png; no "
           "other output has colours in a tone");
  }
}

void SolveArguments::RequireOptionsOfMethod() const {
  const SolveMethodTraits& chosen = TraitsOf(method.method);
  for (const SolveMethodTraits& traits : SolveMethods()) {
    for (const std::string& option : traits.options) {
      const auto& own = chosen.options;
      if (std::find(own.begin(), own.end(), option) != own.end()) continue;
      if (command_->count(option) == 0) continue;
      throw CLI::ValidationError(option, "is no option of --method " + chosen.name);
    }
  }
}

void SolveArguments::RequireOptionsOfAtlas() const {
  if (command_->count("--atlas") == 0) return;
  if (!IsPolyDataFileName(atlasFile)) {
    throw CLI::ValidationError("--atlas", "the name has to end in .vtp or .vtpc");
  }
  for (const char* option : {"--pages", "--page-size", "--texel-size", "--padding", "--mip-levels",
                             "--stretch", "--texel-density"}) {
    if (command_->count(option) == 0) continue;
    throw CLI::ValidationError(option,
                               "is decided by the atlas of --atlas; leave out one of the two");
  }
}

int SolveArguments::MostPages() const {
  constexpr int kMostUsual = 256, kMostChecked = 4096;
  if (lightMap.empty()) return 1;
  const bool isOpen = atlas.texelSize > 0 || !atlasFile.empty();
  return isOpen ? kMostUsual : std::min(kMostChecked, atlas.pages);
}

RadiosityRunOptions SolveArguments::RunOptions() const {
  RadiosityRunOptions options;
  scene.Apply(&options);
  options.method = method;
  options.method.matrix.elementSize = elementSize;
  options.method.progressive.elementSize = elementSize;
  options.method.cached.elementSize = elementSize;
  options.method.reference.seed = options.method.cached.seed = seed;
  options.solver = solver;
  options.timeLimit = time;
  if (!lightMap.empty()) options.atlas = atlas;
  options.atlasFile = atlasFile;
  options.introducedTriangles = introducedTriangles;
  options.splitSurfaces = splitSurfaces;
  options.representations = representations;
  // A picture costs a GL context and four samples a pixel: some 2 s a megapixel drawn in software.
  const auto pixels = ImageSize();
  if (!image.empty()) options.outputSeconds += 0.5 + 2e-6 * pixels[0] * pixels[1];
  // A piece of a collection costs some 0.6 ms, however small.
  if (IsCollectionFileName(output)) options.outputSecondsPerPart = 1e-3;
  return options;
}

}  // namespace lambert
