#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "Atlas/vtkAtlasAdapter.h"
#include "Commands.h"
#include "Common/Core/Error.h"
#include "Common/Core/OutputFile.h"
#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"
#include "Display/PictureFile.h"
#include "Engine/PolyDataFile.h"
#include "FilesOfRun.h"
#include "Interrupt.h"
#include "ProgressDisplay.h"

namespace lambert {
namespace {

/// Charts in colours of their own, pages side by side.
void WriteCharts(const RadiosityAtlas& atlas, const std::string& fileName) {
  constexpr unsigned char kEmpty = 24;
  constexpr int64_t kMostPixels = int64_t(1) << 28;
  constexpr uint64_t kDarkest = 80, kRange = 160;
  const int size = atlas.pageSize, pages = std::max(1, atlas.pages);
  if (int64_t(size) * size * pages > kMostPixels) {
    throw Error(
        "The picture would have more than 268 million pixels; take fewer or smaller pages.");
  }
  const std::vector<int32_t> chartOfFace = ChartOfFace(atlas.set);
  vtkNew<vtkImageData> image;
  image->SetDimensions(size * pages, size, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* texels = static_cast<unsigned char*>(image->GetScalarPointer());
  std::fill_n(texels, size_t(size) * size_t(size) * size_t(pages) * 3, kEmpty);
  for (int page = 0; page < atlas.pages; ++page) {
    const std::vector<int32_t> faces = FacesOfTexels(atlas, page);
    for (size_t i = 0; i < faces.size(); ++i) {
      if (faces[i] < 0) continue;
      const size_t x = size_t(page) * size_t(size) + i % size_t(size), y = i / size_t(size);
      const uint64_t bits = HashBits(uint64_t(chartOfFace[size_t(faces[i])]));
      for (size_t band = 0; band < 3; ++band) {
        texels[(y * size_t(size * pages) + x) * 3 + band] =
            static_cast<unsigned char>(kDarkest + (bits >> (16 * band)) % kRange);
      }
    }
  }
  WritePicture(image, fileName);
}

void WriteReport(const RadiosityAtlas& atlas, const std::string& fileName) {
  const nlohmann::ordered_json report = {
      {"faces", atlas.textureCoords.size()},
      {"charts", atlas.set.charts.size()},
      {"pages", atlas.pages},
      {"page_size_texels", atlas.pageSize},
      {"texel_size_m", atlas.texelSize},
      {"utilisation", atlas.utilisation},
      {"largest_stretch", LargestStretch(atlas.set)},
      {"seconds", {{"charts", atlas.chartSeconds}, {"pack", atlas.packSeconds}}}};
  WriteOutput(fileName, report.dump(2) + '\n');
}

}  // namespace

int Atlas(const AtlasArguments& arguments) {
  // Everything that can be refused is refused first.
  RequireWritable(arguments.Outputs());
  SetThreadCount(arguments.threads);
  CatchInterrupt();
  ProgressDisplay display(arguments.progress);
  const ProgressCallback progress = [&](double fraction, const char* detail) {
    display.Update(fraction, detail);
    return !IsInterrupted();
  };

  // The scene in clusters, those in charts, and charts on pages.
  RadiosityRunOptions options;
  arguments.scene.Apply(&options);
  options.atlas = arguments.atlas;
  RadiosityRun run(options);
  display.Begin("reading");
  run.Load(progress);
  RequireUnread(arguments.Outputs(), run.Reading().companions);
  display.Begin("clustering");
  run.Cluster(progress);
  display.Begin("atlas");
  run.LayFlat(progress);
  const RadiosityAtlas& atlas = run.Atlas();

  // What is asked for.
  display.Begin("write");
  vtkNew<vtkPolyData> mesh;
  PolyDataFromAtlas(atlas, run.GetScene(), mesh);
  WritePolyData(mesh, arguments.output);
  if (!arguments.image.empty()) WriteCharts(atlas, arguments.image);
  if (!arguments.report.empty()) WriteReport(atlas, arguments.report);
  display.EndStage();
  display.Finish();
  for (const std::string& warning : run.Warnings()) display.Say("warning: " + warning);
  std::printf("%s: %zu faces in %zu charts on %d page(s) of %d texels, %g m each, %.0f %% used\n",
              arguments.output.c_str(), atlas.textureCoords.size(), atlas.set.charts.size(),
              atlas.pages, atlas.pageSize, atlas.texelSize, 100 * atlas.utilisation);
  return 0;
}

}  // namespace lambert
