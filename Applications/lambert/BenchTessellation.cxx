#include <algorithm>
#include <filesystem>

#include "BenchMethods.h"
#include "BenchRuns.h"
#include "BenchStudies.h"
#include "Common/Core/Timer.h"
#include "Engine/SolutionFile.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {
namespace {

constexpr int64_t kFewestTriangles = 20000, kGrowth = 4;
/// Fewer vertices and paths than the sweep: what is shown is that the error stays, not its last
/// digit.
constexpr int kMostReceivers = 1500, kMostPaths = 1024;

/// Seconds to write the solution, all arrays of it; the file is not kept.
double TimeOutput(const BenchOutcome& outcome, const Scene& scene, const std::string& folder) {
  const std::string name = (std::filesystem::path(folder) / "Tessellation.vtp").string();
  const Timer timer;
  WriteSolution(outcome.solution, scene, name);
  const double seconds = timer.Seconds();
  std::filesystem::remove(name);
  return seconds;
}

BenchRow RunTessellation(const BenchArguments& arguments, int64_t triangles, int run) {
  BenchScene bench;
  bench.name = "knot";
  bench.scene = MakeKnotRoom(triangles);
  const BenchMethod& method = FindBenchMethod("hierarchical");
  BenchRow row = BeginRow("tessellation", bench, method, arguments.tessellationError);
  row.run = run;

  // The light, its stages, and what a bounding volume hierarchy takes of the setup.
  ForgetPeakMemory();
  const double cpuBefore = CpuSeconds();
  const BenchOutcome outcome = RunHierarchical(bench.scene, arguments.tessellationError);
  row.cpu = CpuSeconds() - cpuBefore;
  EnterOutcome(outcome, method, &row);
  const Timer timer;
  { const RayScene rays(bench.scene.mesh); }
  row.bvh = timer.Seconds();
  row.output = TimeOutput(outcome, bench.scene, arguments.output);

  // The error, to see that it is the same for all.
  BenchReferenceOptions options = arguments.reference;
  options.receivers = std::min(options.receivers, kMostReceivers);
  options.paths = std::min(options.paths, kMostPaths);
  const BenchReference reference = TraceBenchReference(bench, options);
  row.SetError(MeasureAtReceivers(bench, reference, outcome.solution, false));
  return row;
}

}  // namespace

void TessellateFiner(const BenchArguments& arguments, BenchTableWriter* table) {
  // Four times as many each, and the largest.
  std::vector<int64_t> sizes;
  for (int64_t size = kFewestTriangles; size < arguments.largest; size *= kGrowth) {
    sizes.push_back(size);
  }
  sizes.push_back(arguments.largest);

  struct Planned {
    int64_t triangles;
    int run;
  };
  std::vector<Planned> plan;
  for (int run = 1; run <= arguments.runs; ++run) {
    for (const int64_t size : sizes) plan.push_back({size, run});
  }
  Random random(arguments.seed);
  Shuffle(&plan, &random);
  int order = 0;
  for (const Planned& next : plan) {
    BenchRow row = RunTessellation(arguments, next.triangles, next.run);
    row.order = ++order;
    table->Append(row);
    Announce(row);
  }
}

}  // namespace lambert
