#include "BenchMethods.h"
#include "BenchRuns.h"
#include "BenchStudies.h"

namespace lambert {

void WatchConvergence(const BenchArguments& arguments, const BenchScene& scene,
                      const BenchReference& reference, BenchTableWriter* table) {
  const BenchMethod& method = FindBenchMethod("hierarchical");
  for (int run = 1; run <= arguments.runs; ++run) {
    RunHierarchical(
        scene.scene, arguments.convergenceError,
        [&](double seconds, const IterationRecord& record, const RadiositySolution& solution) {
          BenchRow row = BeginRow("convergence", scene, method, record.iteration);
          row.knob = "iteration";
          row.run = run;
          row.order = run;
          row.seconds = seconds;
          row.elements = double(record.elements);
          row.links = double(record.links);
          row.rays = double(record.rays);
          row.SetError(MeasureAtReceivers(scene, reference, solution, false));
          table->Append(row);
          Announce(row);
          return seconds < arguments.convergenceSeconds;
        });
  }
}

}  // namespace lambert
