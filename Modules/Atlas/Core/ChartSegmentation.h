// Which clusters become charts: down the tree of every surface until they can be laid flat (thesis
// 5.2.1, 5.2.3).
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "Clustering/Core/FaceClustering.h"
#include "Common/Core/Progress.h"
#include "Common/Core/TriangleMesh.h"

namespace lambert {

struct ChartOptions {
  double stretch =
      2;  ///< by which lengths in a chart grow or shrink at most, as a factor, [1, inf)
  double longest = 0;  ///< m that a chart extends at most, unless an edge does; 0: any
  /// m2 that a chart leaves empty of its smallest rectangle at most; 0: any. Frames that large
  /// charts would not fit into are cut.
  double mostEmpty = 0;
  /// m around a chart that its padding takes, [0, inf]. Charts are cut apart where the parts need
  /// less room with it; none are where it is infinite.
  double margin = std::numeric_limits<double>::infinity();
};

/// A cluster laid flat, or several that lie beside each other.
struct Chart {
  int32_t first = 0, faceCount = 0;  ///< of ChartSet::faces
  int32_t cornerCount = 0;           ///< different places in it
  bool isProjected = false;          ///< seen along its normal, else a conformal map
  float stretch = 1;                 ///< by which lengths in it grow or shrink at most
};

struct ChartSet {
  std::vector<Chart> charts;   ///< by their first face; every face lies in one
  std::vector<int32_t> faces;  ///< chart after chart, in each ascending
  /// By face: of its corners in the plane of their chart, m. Charts have the area of their cluster
  /// about, and lie each about its own origin.
  std::vector<std::array<Vec2f, 3>> places;
  /// By face: of its corners within their chart, [0, cornerCount); one number, one place.
  std::vector<std::array<int32_t, 3>> corners;

  ChartOptions options;  ///< that they were cut by
  /// The extents from which and under which ChartOptions::longest leaves all charts as they are, m.
  double leastLongest = 0, mostLongest = std::numeric_limits<double>::infinity();
  /// The margins above which and up to which ChartOptions::margin leaves all charts as they are, m.
  double leastMargin = -1, mostMargin = std::numeric_limits<double>::infinity();

  struct FaceRange {
    const int32_t *first, *last;
    const int32_t* begin() const { return first; }
    const int32_t* end() const { return last; }
  };
  FaceRange FacesOf(const Chart& chart) const {
    return {faces.data() + chart.first, faces.data() + chart.first + chart.faceCount};
  }

  /// Whether `other` options cut the same mesh into the same charts, as far as is known.
  bool IsOf(const ChartOptions& other) const;
};

/// By face: its chart.
std::vector<int32_t> ChartOfFace(const ChartSet& set);
/// Of all its charts; 1 where there are none.
float LargestStretch(const ChartSet& set);

/// The largest clusters that a map lays flat without overlaps and within the stretch, and small
/// neighbours of them joined. `mesh` is in the order of `tree`. A face alone always is a chart.
/// Does not depend on the number of threads. Throws Error for options out of range and where the
/// tree is not that of the mesh, Cancelled.
ChartSet CutIntoCharts(const TriangleMesh& mesh, const ClusterTree& tree,
                       const ChartOptions& options = {}, const ProgressCallback& progress = {});

}  // namespace lambert
