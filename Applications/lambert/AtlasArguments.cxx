#include "AtlasArguments.h"

#include <CLI/CLI.hpp>

#include "ArgumentChecks.h"
#include "Engine/PolyDataFile.h"
#include "FilesOfRun.h"

namespace lambert {

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
          ->add_option("--mip-levels", atlas->mipLevels,
                       "Levels of mip maps that take in nothing of other charts: padding of 1.5 * "
                       "2^LEVELS texels at least")
          ->check(CLI::Range(0, 5))
          ->capture_default_str(),
      command
          ->add_option("--stretch", atlas->stretch,
                       "By which lengths in a chart grow or shrink at most")
          ->check(Within(1, 1e6, "from 1 to 1e6"))
          ->capture_default_str()};
}

void AtlasArguments::AddTo(CLI::App* command) {
  scene.AddTo(command);
  command->add_option("-o,--output", output, "Mesh with its texture coordinates, .vtp or .vtpc")
      ->required();
  AddAtlasOptions(command, &atlas);
  command->add_option("--threads", threads, "Threads; 0: all processors")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command->add_option("--image", image, "PNG picture of the charts, pages side by side");
  command->add_option("--report", report, "Account of the run, JSON");
  AddProgress(command, &progress);
}

void AtlasArguments::Check() const {
  if (!IsPolyDataFileName(output)) {
    throw CLI::ValidationError("--output", "the name has to end in .vtp or .vtpc");
  }
  RequirePngName(image);
  FilesOfRun(scene.files).AddOutputs(this->Outputs());
}

std::vector<OutputOfRun> AtlasArguments::Outputs() const {
  return {{"--output", output, true}, {"--image", image}, {"--report", report}};
}

}  // namespace lambert
