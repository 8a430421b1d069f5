#include "SceneArguments.h"

#include <CLI/CLI.hpp>
#include <map>

#include "ArgumentChecks.h"

namespace lambert {
namespace {

const std::map<std::string, double> kUnits{
    {"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};

}  // namespace

void SceneArguments::AddTo(CLI::App* command) {
  command->add_option("SCENE", files, "Scene files: OBJ, glTF/GLB, PLY, STL, VTP, VTPC")
      ->required();
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

void InfoArguments::AddTo(CLI::App* command) {
  scene.AddTo(command);
  command->add_flag("--json", json, "Machine-readable");
}

}  // namespace lambert
