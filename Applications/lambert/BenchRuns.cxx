#include "BenchRuns.h"

#include <malloc.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <fstream>

#include "Common/Core/Parallel.h"
#include "Common/Core/Timer.h"

namespace lambert {

BenchRow BeginRow(const std::string& study, const BenchScene& scene, const BenchMethod& method,
                  double value) {
  BenchRow row;
  row.study = study;
  row.scene = scene.name;
  row.triangles = double(scene.scene.mesh.FaceCount());
  row.vertices = double(scene.scene.mesh.PointCount());
  if (scene.coarse) row.coarseTriangles = double(scene.coarse->mesh.FaceCount());
  row.method = method.name;
  row.knob = method.knob;
  row.value = value;
  row.threads = ThreadCount();
  double load = 0;
  if (getloadavg(&load, 1) == 1) row.load = load;
  return row;
}

void EnterOutcome(const BenchOutcome& outcome, const BenchMethod& method, BenchRow* row) {
  const SolverStatistics& s = outcome.statistics;
  row->seconds = outcome.seconds;
  row->iterations = outcome.iterations;
  // Stages that a method of one function does not tell apart stay unknown.
  if (outcome.clustering > 0) {
    row->clustering = outcome.clustering;
    row->setup = outcome.setup;
    row->reconstruction = outcome.reconstruction;
  }
  if (method.hasElements) {
    row->elements = double(s.Elements());
    row->links = double(s.Links());
  }
  row->rays = double(s.rays);
  row->stoppedBy = s.stoppedBy;
  if (const int64_t bytes = PeakMemoryBytes()) row->peakMegabytes = double(bytes) / 1e6;
}

void Announce(const BenchRow& row) {
  std::printf("%s %s, %s, %s %g, run %g: ", row.study.c_str(), row.scene.c_str(),
              row.method.c_str(), row.knob.c_str(), row.value, row.run);
  if (!row.note.empty()) {
    std::printf("%s\n", row.note.c_str());
  } else {
    std::printf("%.3g s, error %.2f %%\n", row.seconds, 100 * row.rms);
  }
  std::fflush(stdout);
}

double CpuSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void ForgetPeakMemory() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
}

}  // namespace lambert
