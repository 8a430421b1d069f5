#include <cstdio>
#include <filesystem>

#include "BenchArguments.h"
#include "BenchMethods.h"
#include "BenchReport.h"
#include "BenchStudies.h"
#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Display/vtkRadiosityImageWriter.h"

namespace lambert {
namespace {

std::string InFolder(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / name).string();
}

/// All studies that were asked for, one scene after the other.
void Measure(const BenchArguments& arguments, const std::string& tableName) {
  BenchTableWriter table(tableName);
  if (arguments.Has("sweep") || arguments.Has("convergence")) {
    for (const std::string& file : arguments.scene.files) {
      const BenchScene scene = LoadBenchScene(file, arguments.scene, arguments.vertices);
      const BenchReference reference = TraceBenchReference(scene, arguments.reference);
      if (arguments.Has("sweep")) SweepMethods(arguments, scene, reference, &table);
      if (arguments.Has("convergence")) WatchConvergence(arguments, scene, reference, &table);
    }
  }
  if (arguments.Has("tessellation")) TessellateFiner(arguments, &table);
}

}  // namespace

int Bench(const BenchArguments& arguments) {
  // What can be refused at once.
  for (const std::string& name : arguments.methods) FindBenchMethod(name);
  std::error_code failed;
  std::filesystem::create_directories(arguments.output, failed);
  if (failed) throw Error("The folder " + arguments.output + " cannot be made.");
  if (!arguments.noCharts && !vtkRadiosityImageWriter::IsDisplayAvailable()) {
    throw Error(
        "Drawing charts needs an X display and none answers: run under xvfb-run, or give "
        "--no-charts.");
  }
  SetThreadCount(arguments.threads);

  // Measure, then read the table back: what is drawn is what is written.
  const std::string table = InFolder(arguments.output, "Measurements.csv");
  if (!arguments.redraw) Measure(arguments, table);
  const std::vector<BenchRow> rows = ReadBenchTable(table);
  WriteBenchTables(rows, arguments.output);
  if (!arguments.noCharts) DrawBenchCharts(rows, arguments.output);
  return 0;
}

}  // namespace lambert
