#include "BenchArguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "BenchMethods.h"

namespace lambert {
namespace {

const std::vector<std::string> kStudies{"sweep", "tessellation", "convergence"};

/// Numbers above 0, separated by commas.
CLI::Option* AddValues(CLI::App* command, const std::string& name, std::vector<double>* values,
                       double high, const std::string& description) {
  return command->add_option(name, *values, description)
      ->delimiter(',')
      ->check(CLI::Range(1e-6, high))
      ->capture_default_str();
}

}  // namespace

void BenchArguments::AddTo(CLI::App* command) {
  scene.AddTo(command);
  command->get_option("SCENE")->required(false);
  command->add_option("-o,--output", output, "Folder for CSV, tables and charts")
      ->capture_default_str();
  command->add_option("--studies", studies, "sweep,tessellation,convergence")
      ->delimiter(',')
      ->check(CLI::IsMember(kStudies));
  command->add_option("--methods", methods, "Methods, separated by commas; all without it")
      ->delimiter(',');
  command->add_option("--runs", runs, "Runs of everything, in random order")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--threads", threads, "Threads; 0: all processors")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command->add_option("--seed", seed, "Of the order, the vertices and the reference")
      ->capture_default_str();

  // The knobs.
  AddValues(command, "--errors", &errors, 1, "Wanted errors of hierarchical");
  AddValues(command, "--samples", &samples, 1e7, "Paths a vertex of reference");
  AddValues(command, "--gather-rays", &gatherRays, 1e6, "Gather rays a vertex of cached");
  AddValues(command, "--element-sizes", &elementSizes, 1,
            "Elements of matrix and progressive, fractions of the scene's diagonal");
  command->add_option("--longest", longest, "Seconds; a run expected to take more is left out")
      ->check(CLI::Range(0.001, 1e6))
      ->capture_default_str();

  // The vertices and the truth there.
  command
      ->add_option("--vertices", vertices,
                   "To which scenes of under 10000 are tessellated; 0: left as they are")
      ->check(CLI::Range(int64_t(0), int64_t(100000000)))
      ->capture_default_str();
  command->add_option("--receivers", reference.receivers, "Vertices at which errors are measured")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_option("--reference-paths", reference.paths, "Paths of the reference at each")
      ->check(CLI::Range(2, 100000000))
      ->capture_default_str();
  command->add_option("--references", reference.folder,
                      "Folder where references are kept; OUTPUT/References without it");

  // The other studies, and what is drawn.
  command->add_option("--largest", largest, "Triangles of the finest tessellation")
      ->check(CLI::Range(int64_t(20000), int64_t(50000000)))
      ->capture_default_str();
  command->add_option("--tessellation-error", tessellationError, "Error wanted of tessellations")
      ->check(CLI::Range(1e-3, 1.0))
      ->capture_default_str();
  command->add_option("--convergence-error", convergenceError, "Error wanted of convergence runs")
      ->check(CLI::Range(1e-4, 1.0))
      ->capture_default_str();
  command->add_option("--convergence-seconds", convergenceSeconds, "For which they are watched")
      ->check(CLI::Range(0.01, 1e6))
      ->capture_default_str();
  command->add_flag("--quick", quick, "Few, coarse runs: to see that everything works");
  command->add_flag("--redraw", redraw, "Tables and charts anew from OUTPUT/Measurements.csv");
  command->add_flag("--no-charts", noCharts, "Tables alone; no display is needed");
}

void BenchArguments::Check() {
  if (reference.folder.empty()) reference.folder = output + "/References";
  reference.seed = seed;
  if (scene.files.empty() && !redraw && (Has("sweep") || Has("convergence"))) {
    throw CLI::RequiredError("SCENE");
  }
  if (!quick) return;
  runs = 1;
  errors = {0.5, 0.1};
  samples = {4, 16};
  gatherRays = {16, 64};
  elementSizes = {0.2, 0.1};
  longest = convergenceSeconds = 1e6;  // What is run does not depend on the machine.
  vertices = std::min<int64_t>(vertices, 1000);
  reference.receivers = 200;
  reference.paths = 512;
  largest = 20000;
  tessellationError = convergenceError = 0.3;
}

bool BenchArguments::Has(const std::string& study) const {
  return std::find(studies.begin(), studies.end(), study) != studies.end();
}

std::vector<double> BenchArguments::Values(const std::string& knob) const {
  std::vector<double> values = knob == "error"         ? errors
                               : knob == "samples"     ? samples
                               : knob == "gather_rays" ? gatherRays
                                                       : elementSizes;
  std::sort(values.begin(), values.end());
  if (!IsFinerUpward(knob)) std::reverse(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

}  // namespace lambert
