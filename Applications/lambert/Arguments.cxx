#include "Arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "ArgumentChecks.h"
#include "Engine/LitModelFile.h"
#include "Engine/ObjFile.h"
#include "Engine/SolutionFile.h"

namespace lambert {
namespace {

const std::map<std::string, double> kUnits{
    {"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};
constexpr int kDefaultVerifyPoints = 2000;

/// Of a name that was checked to be one of a method.
SolveMethod MethodOfName(const std::string& name) {
  return std::find_if(SolveMethods().begin(), SolveMethods().end(),
                      [&](const SolveMethodTraits& traits) { return traits.name == name; })
      ->method;
}

void AddProgress(CLI::App* command, ProgressStyle* progress) {
  const std::map<std::string, ProgressStyle> styles{{"auto", ProgressStyle::Auto},
                                                    {"plain", ProgressStyle::Plain},
                                                    {"none", ProgressStyle::None}};
  command
      ->add_option_function<std::string>(
          "--progress",
          [progress, styles](const std::string& name) { *progress = styles.at(name); },
          "auto: a bar on a terminal, lines in a log; plain; none")
      ->check(CLI::IsMember({"auto", "plain", "none"}))
      ->default_str("auto");
}

/// How charts are cut and packed.
std::vector<CLI::Option*> AddAtlasOptions(CLI::App* command, AtlasOptions* atlas) {
  return {
      command->add_option("--pages", atlas->pages, "Pages that the charts may take")
          ->check(CLI::Range(1, 1000000))
          ->capture_default_str(),
      command->add_option("--page-size", atlas->pageSize, "Texels along a side of a page")
          ->check(CLI::Range(16, 16384))
          ->capture_default_str(),
      command
          ->add_option("--texel-size", atlas->texelSize,
                       "m, on up to 256 pages; 0: what fills the pages")
          ->check(NotNegative())
          ->capture_default_str(),
      command->add_option("--padding", atlas->padding, "Texels between a chart and what it takes")
          ->check(CLI::Range(0, 64))
          ->capture_default_str(),
      command
          ->add_option("--stretch", atlas->stretch,
                       "By which lengths in a chart grow or shrink at most")
          ->check(Within(1, 1e6, "from 1 to 1e6"))
          ->capture_default_str()};
}

/// How hierarchical radiosity refines links and splits triangles.
void AddRefinementOptions(CLI::App* command, HierarchicalRadiosityOptions* solver) {
  std::map<std::string, OracleKind> oracles;
  for (const OracleKind kind :
       {OracleKind::Doubt, OracleKind::Geometric, OracleKind::Bfa, OracleKind::Visibility}) {
    oracles[OracleName(kind)] = kind;
  }
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
                   "Splitting lines move to vertices within this part of the rectangle, [0, 0.5)")
      ->check(Within(0, 0.499, "from 0 to 0.499"))
      ->capture_default_str();
}

/// How light becomes the colours of pictures and of PLY.
void AddToneOptions(CLI::App* command, ToneMappingOptions* tone, bool* dodgingAndBurning) {
  const std::map<std::string, ToneCurve> curves{{"photographic", ToneCurve::Photographic},
                                                {"local", ToneCurve::Photographic},
                                                {"linear", ToneCurve::Linear},
                                                {"filmic", ToneCurve::Filmic}};
  command
      ->add_option_function<std::string>(
          "--tone",
          [=](const std::string& name) {
            tone->curve = curves.at(name);
            *dodgingAndBurning = name == "local";
          },
          "How luminance is compressed; local: pictures expose every place for its surround")
      ->check(CLI::IsMember({"photographic", "local", "linear", "filmic"}))
      ->default_str("photographic");
  command->add_option("--key", tone->key, "Display luminance of the mean of what is shown, (0, 1]")
      ->check(Within(1e-6, 1, "from 1e-6 to 1"))
      ->capture_default_str();
  command->add_option("--exposure", tone->exposure, "Stops (EV) brighter or darker")
      ->check(Within(-100, 100, "from -100 to 100"))
      ->capture_default_str();
  command
      ->add_option_function<double>(
          "--ev", [tone](double ev) { tone->exposureValue = ev; },
          "Exposure value at ISO 100 of a camera that does not adapt to the light")
      ->check(Within(-100, 100, "from -100 to 100"));
  command->add_option("--white", tone->white, "Keyed luminance of full white; 0: by the curve")
      ->check(NotNegative())
      ->capture_default_str();
}

/// Illuminance in place of what the eye sees.
void AddFalseColorOptions(CLI::App* command, SolveArguments* arguments) {
  CLI::Option* colors = command
                            ->add_option("--false-colors", arguments->falseColors,
                                         "Picture of illuminance beside a scale: lux, W/m2")
                            ->check(CLI::IsMember({"lux", "W/m2"}));
  command->add_option("--range", arguments->falseColorRange, "Ends of the scale")
      ->expected(2)
      ->check(NotNegative())
      ->needs(colors);
  command
      ->add_option("--steps", arguments->falseColorSteps,
                   "Steps of the scale; 0: 4 to 6, as is round")
      ->check(CLI::Range(0, 100))
      ->capture_default_str()
      ->needs(colors);
  command->add_flag("--isolines", arguments->isolines, "Lines of equal illuminance at its labels")
      ->needs(colors);
}

/// Which surfaces a light map takes.
void AddRepresentationOptions(CLI::App* command, CLI::Option* lightMap, SolveArguments* arguments) {
  command
      ->add_option_function<int64_t>(
          "--introduced", [=](int64_t most) { arguments->introducedTriangles = most; },
          "Light map: triangles that refinement may add to surfaces lit by their points")
      ->check(CLI::NonNegativeNumber)
      ->needs(lightMap);
  command
      ->add_option_function<std::vector<std::string>>(
          "--represent",
          [=](const std::vector<std::string>& wanted) {
            for (const std::string& text : wanted) {
              const size_t colon = text.rfind(':');
              const std::string kind = colon == std::string::npos ? "" : text.substr(colon + 1);
              if (kind != "points" && kind != "lightmap") {
                throw CLI::ValidationError("--represent", "needs MATERIAL:points|lightmap");
              }
              arguments->representations[text.substr(0, colon)] =
                  kind == "points" ? Representation::Points : Representation::LightMap;
            }
          },
          "MATERIAL:points|lightmap, whatever refinement did to it")
      ->allow_extra_args(false)
      ->needs(lightMap);
}

/// The images of a light map, and what models under one do with textures.
void AddMapOutputOptions(CLI::App* command, CLI::Option* lightMap, SolveArguments* arguments) {
  const std::map<std::string, PageFormat> formats{
      {"hdr", PageFormat::Hdr}, {"exr", PageFormat::Exr}, {"png", PageFormat::Png}};
  command
      ->add_option_function<std::vector<std::string>>(
          "--page-format",
          [=](const std::vector<std::string>& names) {
            arguments->pageFormats.clear();
            for (const std::string& name : names) {
              arguments->pageFormats.push_back(formats.at(name));
            }
          },
          "Pages of the light map: hdr, exr (floats), png (tone mapped); repeatable")
      ->check(CLI::IsMember({"hdr", "exr", "png"}))
      ->allow_extra_args(false)
      ->default_str("hdr")
      ->needs(lightMap);
  command
      ->add_flag("--keep-textures", arguments->model.keepTextures,
                 "glTF, HTML: textured surfaces keep their images, and are lit at their points")
      ->needs(lightMap);
  command
      ->add_option("--baked-size", arguments->model.bakedSize,
                   "glTF, HTML, OBJ: texels along a side of a page that textures are baked into")
      ->check(CLI::Range(16, 16384))
      ->capture_default_str()
      ->needs(lightMap);
}

void RequirePngName(const std::string& image) {
  const std::string ending = std::filesystem::path(image).extension().string();
  if (!image.empty() && ending != ".png" && ending != ".PNG") {
    throw CLI::ValidationError("--image", "the name has to end in .png");
  }
}

/// Files that a run reads and writes.
class FilesOfRun {
 public:
  explicit FilesOfRun(const std::vector<std::string>& scene) {
    for (const std::string& name : scene) this->Add("SCENE", name, false);
  }

  /// Throws CLI::ValidationError where an output would write over another file of the run.
  void Add(const std::string& option, const std::string& name, bool isOutput) {
    namespace fs = std::filesystem;
    if (name.empty()) return;
    std::error_code ignored;
    const fs::path place = fs::weakly_canonical(fs::absolute(name, ignored), ignored);
    if (fs::is_character_file(place, ignored) || fs::is_fifo(place, ignored)) return;
    const auto [other, isNew] = uses_.emplace(place.empty() ? name : place.string(), option);
    if (!isNew && isOutput) {
      throw CLI::ValidationError(option, "would write over the file of " + other->second);
    }
  }

 private:
  std::map<std::string, std::string> uses_;  ///< a file, and the option that names it
};

}  // namespace

void SceneArguments::AddTo(CLI::App* command) {
  command->add_option("SCENE", files, "Scene files: OBJ, glTF/GLB, PLY, STL, VTP")->required();
  command->add_option("--unit", unit, "Length unit of the files: m, cm, mm, in, ft")
      ->check(CLI::IsMember({"m", "cm", "mm", "in", "ft"}));
  command->add_option("--set", settings, "MATERIAL:reflectance=R,G,B|emission=R,G,B|two-sided")
      ->allow_extra_args(false);
  command
      ->add_option("--reflectance", reflectance, "Reflectance R G B of faces whose file gives none")
      ->expected(3)
      ->check(Within(0, 1, "from 0 to 1"))
      ->capture_default_str();
  command->add_flag("--two-sided-emitters", twoSidedEmitters,
                    "Every emitter emits from both sides");
  command->add_flag("--opaque-glass", opaqueGlass, "Transparent materials block and reflect");
  command
      ->add_option("--metals", metals, "Metals reflect their base colour, or black for none of it")
      ->check(CLI::IsMember({"base", "black"}))
      ->capture_default_str();
  command->add_flag("--no-weld", noWeld, "Do not join equal points");
  command->add_flag("--no-zero-area", noZeroArea, "Keep triangles without area");
  command->add_flag("--no-repeated", noRepeated, "Keep repeated triangles");
  command->add_flag("--no-orient", noOrient, "Do not wind pieces consistently");
  command->add_flag("--no-emitter-fix", noEmitterFix, "Do not turn inverted emitters");
  command->add_option("--feature-angle", featureAngle, "Degrees within which normals are smoothed")
      ->check(Within(0, 180, "from 0 to 180"))
      ->capture_default_str();
}

void SceneArguments::Apply(RadiosityRunOptions* options) const {
  options->files = files;
  options->settings = settings;
  options->reader.metresPerUnit = unit.empty() ? 0 : kUnits.at(unit);
  options->reader.defaultReflectance = ToSpectrum(reflectance);
  options->reader.twoSidedEmitters = twoSidedEmitters;
  options->reader.opaqueGlass = opaqueGlass;
  options->reader.blackMetals = metals == "black";
  options->cleaning.weld = !noWeld;
  options->cleaning.removeZeroArea = !noZeroArea;
  options->cleaning.removeRepeated = !noRepeated;
  options->cleaning.orient = !noOrient;
  options->cleaning.fixEmitters = !noEmitterFix;
  options->cleaning.featureAngle = featureAngle;
}

void SolveArguments::AddTo(CLI::App* command) {
  command_ = command;
  scene.AddTo(command);

  // How, how well and how long.
  command->add_option("-o,--output", output, "Solved scene, .vtp, .ply, .glb, .gltf, .html or .obj")
      ->required();
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
  command->add_option("--error", solver.error, "Wanted relative RMS error of irradiance, (0, 1]")
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
  command->add_option("--threads", threads, "Threads; 0: all processors")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  lights.AddTo(command);

  // What comes out beside the solution.
  command->add_option("--probe", probe, "CSV of probe points: x,y,z,nx,ny,nz");
  command->add_option("--probe-output", probeOutput, "CSV of readings: x,y,z,nx,ny,nz,r,g,b,kind");
  command->add_flag("--probe-gather", probeGather, "Probes gather on surfaces too");
  command->add_option("--image", image, "PNG picture (needs an X display, xvfb-run will do)");
  command->add_option("--size", size, "Size of the picture, WxH pixels")->capture_default_str();
  command->add_option("--camera", camera, "px,py,pz,fx,fy,fz[,fov]: eye, point looked at, degrees");
  command->add_option("--up", up, "What is up for picture, sun and skies: auto, x, y, z")
      ->check(CLI::IsMember({"auto", "x", "y", "z"}))
      ->capture_default_str();
  AddToneOptions(command, &tone, &dodgingAndBurning);
  AddFalseColorOptions(command, this);
  CLI::Option* map = command->add_option(
      "--lightmap", lightMap, "Mesh with texture coordinates, .vtp, its pages beside it");
  for (CLI::Option* option : AddAtlasOptions(command, &atlas)) option->needs(map);
  AddRepresentationOptions(command, map, this);
  AddMapOutputOptions(command, map, this);
  command->add_flag("--both-sides", bothSides, "PLY: keep both lit sides of a face");
  command
      ->add_option_function<double>(
          "--simplify",
          [this](double tolerance) { simplification.emplace().tolerance = tolerance; },
          "Fewer triangles, light within this fraction of what it was")
      ->check(Within(1e-6, 1, "from 1e-6 to 1"));
  command->add_option("--report", report, "Account of the run, JSON");
  command
      ->add_option("--verify", verifyPoints, "Measure the error at N points against a path trace")
      ->expected(0, 1)
      ->default_str(std::to_string(kDefaultVerifyPoints))
      ->check(CLI::Range(1, 10000000));
  AddProgress(command, &progress);
}

void SolveArguments::Check() const {
  RequireOptionsOfMethod();
  lights.Check();
  if (!IsSolutionFileName(output) && !IsLitModelFileName(output)) {
    throw CLI::ValidationError("--output",
                               "the name has to end in .vtp, .ply, .glb, .gltf, .html or .obj");
  }
  if (IsLitModelFileName(output) && (introducedTriangles || !representations.empty())) {
    throw CLI::ValidationError(
        "--output",
        "glTF, HTML and OBJ show all surfaces in one way; leave --introduced and "
        "--represent to .vtp and .ply");
  }
  if (FileEnding(output) == ".obj" && model.keepTextures) {
    throw CLI::ValidationError("--keep-textures",
                               "OBJ has no light beside a texture; leave it to glTF and HTML");
  }
  if (probe.empty() != probeOutput.empty()) {
    throw CLI::ValidationError("--probe", "--probe and --probe-output belong together");
  }
  RequirePngName(image);
  if (!falseColorRange.empty() && !(falseColorRange[1] > falseColorRange[0])) {
    throw CLI::ValidationError("--range", "goes from a number up to a larger one");
  }
  FilesOfRun files(scene.files);
  files.Add("--probe", probe, false);
  files.Add("--resume", solver.resume, false);
  if (solver.saveState != solver.resume) files.Add("--save-state", solver.saveState, true);
  files.Add("--output", output, true);
  if (FileEnding(output) == ".obj") {
    for (const std::string& name : FilesBesideObj(output, 1)) files.Add("--output", name, true);
  }
  files.Add("--probe-output", probeOutput, true);
  files.Add("--image", image, true);
  files.Add("--report", report, true);
  if (!lightMap.empty()) {
    if (std::filesystem::path(lightMap).extension() != ".vtp") {
      throw CLI::ValidationError("--lightmap", "the name has to end in .vtp");
    }
    files.Add("--lightmap", lightMap, true);
    for (const PageFormat format : pageFormats) {
      files.Add("--lightmap", LightMapPageNames(lightMap, 1, format).front(), true);
    }
  }
  ImageSize();
  ImageCamera(UpAxis::Y);
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

std::array<int, 2> SolveArguments::ImageSize() const {
  const std::vector<double> numbers = ParseNumbers(size, 'x');
  const auto isSide = [](double n) { return n >= 1 && n <= 8192 && n == std::floor(n); };
  if (numbers.size() != 2 || !isSide(numbers[0]) || !isSide(numbers[1])) {
    throw CLI::ValidationError("--size", "needs WxH, 1 to 8192 pixels each");
  }
  return {int(numbers[0]), int(numbers[1])};
}

UpAxis SolveArguments::UpOf(const TriangleMesh& mesh) const {
  static const std::map<std::string, UpAxis> kAxes{
      {"x", UpAxis::X}, {"y", UpAxis::Y}, {"z", UpAxis::Z}};
  if (up != "auto") return kAxes.at(up);
  const bool allSayIt = std::all_of(scene.files.begin(), scene.files.end(), [](const auto& file) {
    const std::string ending = std::filesystem::path(file).extension().string();
    return ending == ".gltf" || ending == ".glb";
  });
  return allSayIt ? UpAxis::Y : GuessUpAxis(mesh);
}

std::optional<Camera> SolveArguments::ImageCamera(UpAxis imageUp) const {
  if (camera.empty()) return {};
  const std::vector<double> n = ParseNumbers(camera, ',');
  if (n.size() != 6 && n.size() != 7) {
    throw CLI::ValidationError("--camera", "needs px,py,pz,fx,fy,fz or px,py,pz,fx,fy,fz,fov");
  }
  Camera view;
  view.position = {n[0], n[1], n[2]};
  view.focalPoint = {n[3], n[4], n[5]};
  if (n.size() == 7) view.verticalFieldOfView = n[6];
  const Vec3d forward = Normalize(view.focalPoint - view.position);
  if (forward == Vec3d() || !(view.verticalFieldOfView > 0 && view.verticalFieldOfView < 180)) {
    throw CLI::ValidationError(
        "--camera", "needs two different points and a field of view of 0 to 180 degrees");
  }
  // Straight up or down what lies ahead of a y-up camera, -z, is up in the picture.
  const bool isSteep = std::abs(ToYUp(forward, imageUp).y) > 0.999;
  view.viewUp = FromYUp(isSteep ? Vec3d(0, 0, -1) : Vec3d(0, 1, 0), imageUp);
  return view;
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
  options.introducedTriangles = introducedTriangles;
  options.representations = representations;
  // A picture costs a GL context and four samples a pixel: some 2 s a megapixel drawn in software.
  const auto pixels = ImageSize();
  if (!image.empty()) options.outputSeconds += 0.5 + 2e-6 * pixels[0] * pixels[1];
  return options;
}

void AtlasArguments::AddTo(CLI::App* command) {
  scene.AddTo(command);
  command->add_option("-o,--output", output, "Mesh with its texture coordinates, .vtp")->required();
  AddAtlasOptions(command, &atlas);
  command->add_option("--threads", threads, "Threads; 0: all processors")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command->add_option("--image", image, "PNG picture of the charts, pages side by side");
  command->add_option("--report", report, "Account of the run, JSON");
  AddProgress(command, &progress);
}

void AtlasArguments::Check() const {
  if (std::filesystem::path(output).extension() != ".vtp") {
    throw CLI::ValidationError("--output", "the name has to end in .vtp");
  }
  RequirePngName(image);
  FilesOfRun files(scene.files);
  files.Add("--output", output, true);
  files.Add("--image", image, true);
  files.Add("--report", report, true);
}

void InfoArguments::AddTo(CLI::App* command) {
  scene.AddTo(command);
  command->add_flag("--json", json, "Machine-readable");
}

}  // namespace lambert
