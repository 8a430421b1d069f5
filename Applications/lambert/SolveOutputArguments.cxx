// What comes out of `solve` beside the solution.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>

#include "ArgumentChecks.h"
#include "SolveArguments.h"

namespace lambert {
namespace {

constexpr int kDefaultVerifyPoints = 2000;

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
          "How luminance is compressed; local: --image alone exposes every place for its surround")
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
void AddFalseColorOptions(CLI::App* command, CLI::Option* image, SolveArguments* arguments) {
  CLI::Option* colors = command
                            ->add_option("--false-colors", arguments->falseColors,
                                         "Picture of illuminance beside a scale: lux, W/m2")
                            ->check(CLI::IsMember({"lux", "W/m2"}))
                            ->needs(image);
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

/// How fine its texels are.
void AddTexelDensity(CLI::App* command, CLI::Option* lightMap, AtlasOptions* atlas) {
  command
      ->add_option_function<std::string>(
          "--texel-density",
          [=](const std::string& name) {
            atlas->density =
                name == "illumination" ? TexelDensity::Illumination : TexelDensity::Uniform;
          },
          "uniform, or illumination: finer texels where light varies, as many in all")
      ->check(CLI::IsMember({"uniform", "illumination"}))
      ->default_str("uniform")
      ->needs(lightMap);
}

/// Adds what `text` wants of surfaces: MATERIAL, part=NAME or surface=NUMBER, a colon and the kind.
void AddWanted(const std::string& text, WantedRepresentations* wanted) {
  const auto require = [](bool isRight) {
    if (isRight) return;
    throw CLI::ValidationError(
        "--represent", "needs MATERIAL, part=NAME or surface=NUMBER, then :points or :lightmap");
  };
  const size_t colon = std::min(text.rfind(':'), text.size());
  const std::string whole = text.substr(0, colon), kind = text.substr(colon);
  require(!whole.empty() && (kind == ":points" || kind == ":lightmap"));
  const Representation representation =
      kind == ":points" ? Representation::Points : Representation::LightMap;

  // A name that begins otherwise is that of a material.
  const size_t equals = whole.find('=');
  const std::string sort = equals == std::string::npos ? "" : whole.substr(0, equals);
  const std::string name = whole.substr(equals + 1);
  if (sort == "surface") {
    int32_t surface = -1;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), surface);
    require(error == std::errc() && end == name.data() + name.size() && surface >= 0);
    wanted->bySurface[surface] = representation;
  } else if (sort == "part") {
    wanted->byPart[name] = representation;
  } else {
    wanted->byMaterial[sort == "material" ? name : whole] = representation;
  }
}

/// Which surfaces a light map takes.
void AddRepresentationOptions(CLI::App* command, CLI::Option* lightMap, SolveArguments* arguments) {
  CLI::Option* introduced = command->add_option_function<int64_t>(
      "--introduced", [=](int64_t most) { arguments->introducedTriangles = most; },
      "Light map: triangles that refinement may add to surfaces lit by their points");
  introduced->check(CLI::NonNegativeNumber)->needs(lightMap);
  command
      ->add_flag(
          "--split-surfaces", arguments->splitSurfaces,
          "Surfaces show at points what refinement left as it was, the rest in the light map")
      ->needs(introduced);
  command
      ->add_option_function<std::vector<std::string>>(
          "--represent",
          [=](const std::vector<std::string>& wanted) {
            for (const std::string& text : wanted) AddWanted(text, &arguments->representations);
          },
          "Light map: MATERIAL:points|lightmap, part=NAME:..., surface=NUMBER:... (of the report), "
          "whatever refinement did to it")
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
      ->add_flag(
          "--keep-textures", arguments->model.keepTextures,
          "Light map, glTF, HTML: textured surfaces keep their images, and are lit at their points")
      ->needs(lightMap);
  command
      ->add_option(
          "--baked-size", arguments->model.bakedSize,
          "Light map, glTF, HTML, OBJ: texels along a side of a page that textures are baked into")
      ->check(CLI::Range(16, 16384))
      ->capture_default_str()
      ->needs(lightMap);
}

}  // namespace

void SolveArguments::AddOutputsTo(CLI::App* command) {
  CLI::Option* probes =
      command->add_option("--probe", probe, "CSV of probe points: x,y,z,nx,ny,nz");
  command->add_option("--probe-output", probeOutput, "CSV of readings: x,y,z,nx,ny,nz,r,g,b,kind");
  command->add_flag("--probe-gather", probeGather, "Probes gather on surfaces too")->needs(probes);
  CLI::Option* picture =
      command->add_option("--image", image, "PNG picture (needs an X display, xvfb-run will do)");
  command->add_option("--size", size, "Size of the picture, WxH pixels")->capture_default_str();
  command->add_option("--camera", camera, "px,py,pz,fx,fy,fz[,fov]: eye, point looked at, degrees");
  command->add_option("--up", up, "What is up for picture, sun and skies: auto, x, y, z")
      ->check(CLI::IsMember({"auto", "x", "y", "z"}))
      ->capture_default_str();
  AddToneOptions(command, &tone, &dodgingAndBurning);
  AddFalseColorOptions(command, picture, this);
  CLI::Option* map = command->add_option(
      "--lightmap", lightMap, "Mesh with texture coordinates, .vtp or .vtpc, its pages beside it");
  for (CLI::Option* option : AddAtlasOptions(command, &atlas)) option->needs(map);
  AddTexelDensity(command, map, &atlas);
  command
      ->add_option("--atlas", atlasFile,
                   "Light map: drawn on this mesh of `lambert atlas` or of an earlier light map")
      ->needs(map);
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
  CLI::Option* verified = command
                              ->add_option("--verify", verifyPoints,
                                           "Measure the error at N points against a path trace")
                              ->expected(0, 1)
                              ->default_str(std::to_string(kDefaultVerifyPoints))
                              ->check(CLI::Range(1, 10000000));
  command
      ->add_option("--verify-output", verifyOutput,
                   "CSV of these points, those that hold most of the error first")
      ->needs(verified);
  AddProgress(command, &progress);
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

}  // namespace lambert
