// What `lambert bench` is asked for.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "BenchReference.h"
#include "SceneArguments.h"

namespace CLI {
class App;
}

namespace lambert {

struct BenchArguments {
  SceneArguments scene;  ///< each file a scene of its own
  std::string output = "bench";
  std::vector<std::string> studies{"sweep", "tessellation", "convergence"};
  std::vector<std::string> methods;  ///< empty: all
  int runs = 3, threads = 0;
  uint64_t seed = 1;  ///< of the order of runs, of the vertices chosen, of the reference

  // The knobs.
  std::vector<double> errors{0.5, 0.3, 0.2, 0.1, 0.05, 0.03, 0.02};
  std::vector<double> samples{4, 16, 64, 256, 1024};
  std::vector<double> gatherRays{16, 64, 256, 1024};
  std::vector<double> elementSizes{0.16, 0.08, 0.04, 0.02, 0.01};  ///< of the scene's diagonal
  double longest = 120;  ///< s that a run may be expected to take; a finer one is left out

  // What is measured, and against what.
  BenchReferenceOptions reference;
  int64_t vertices = 10680;  ///< to which a coarse scene is tessellated; 0: left as it is

  // The other studies.
  int64_t largest = 5000000;       ///< triangles of the finest tessellation
  double tessellationError = 0.1;  ///< wanted of each
  double convergenceError = 0.02;  ///< wanted of the run that is watched
  double convergenceSeconds = 30;  ///< after which it is not watched any more

  bool quick = false;   ///< few and coarse runs: to see that all works
  bool redraw = false;  ///< charts of the table in `output`, without measuring
  bool noCharts = false;

  void AddTo(CLI::App* command);
  /// Throws CLI::ValidationError where options contradict each other; sets what --quick stands for.
  void Check();
  bool Has(const std::string& study) const;
  /// Values of a method's knob, coarse ones first.
  std::vector<double> Values(const std::string& knob) const;
};

/// Runs the bench and draws its charts; returns the exit code. Throws Error.
int Bench(const BenchArguments& arguments);

}  // namespace lambert
