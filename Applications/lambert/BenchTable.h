// The measurements of a bench: one row a run, written as CSV and read back for charts.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "Reference/Core/SolutionError.h"

namespace lambert {

/// What a run measured. A number that is not known is NaN, an empty field in the file. Seconds are
/// wall time.
struct BenchRow {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  std::string study;  ///< sweep, tessellation or convergence
  std::string scene, method, knob;
  double value = kUnknown;  ///< of the knob
  double run = kUnknown;    ///< 1, 2, ...
  double order = kUnknown;  ///< when it was run, counted from 1 within its study

  // The scene, and the machine.
  double triangles = kUnknown, vertices = kUnknown;
  double coarseTriangles = kUnknown;  ///< before tessellation; unknown where there was none
  double threads = kUnknown;
  double load = kUnknown;  ///< mean number of runnable threads in the minute before

  // Time: from the loaded mesh on to the light at the vertices, and its stages.
  double seconds = kUnknown;
  double cpu = kUnknown;  ///< of all threads; on a busy machine steadier than wall time
  double clustering = kUnknown, setup = kUnknown, iterations = kUnknown, reconstruction = kUnknown;
  double bvh = kUnknown;     ///< a bounding volume hierarchy of the scene, built apart
  double output = kUnknown;  ///< writing a .vtp; not part of `seconds`

  // Work.
  double elements = kUnknown, links = kUnknown, rays = kUnknown;
  double peakMegabytes = kUnknown;  ///< of the process during the run, scene and reference included

  // Error at the vertices, fractions.
  double rms = kUnknown, rmsLow = kUnknown, rmsHigh = kUnknown, bounded = kUnknown, bias = kUnknown,
         percentile95 = kUnknown;
  double receivers = kUnknown, missed = kUnknown;  ///< missed: lit, and not modelled
  double noise = kUnknown;  ///< relative RMS noise of the reference, subtracted from `rms`

  std::string stoppedBy;
  std::string note;  ///< why a run failed

  void SetError(const SolutionError& error);
};

/// Writes a header, then rows as they come; every row is on the disk when Append returns. Throws
/// Error where the file cannot be written.
class BenchTableWriter {
 public:
  explicit BenchTableWriter(const std::string& fileName);
  void Append(const BenchRow& row);

 private:
  void Write(const std::string& line);
  std::string fileName_;
};

/// The rows of a file; columns of other names are passed over. Throws Error, naming the line.
std::vector<BenchRow> ReadBenchTable(const std::string& fileName);

}  // namespace lambert
