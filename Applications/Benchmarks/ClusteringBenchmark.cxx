// What clustering costs: reads scenes and prints, for each, time and memory a triangle and the
// depth of the trees.
//   lambert-clustering-benchmark [--threads N] [--balance K] FILE...
#include <malloc.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

#include "Clustering/Core/ClusterCut.h"
#include "Clustering/Core/FaceClustering.h"
#include "Clustering/Core/VolumeClustering.h"
#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Common/Core/Timer.h"
#include "Scene/Core/SceneCleaning.h"
#include "Scene/Core/SceneReader.h"

namespace lambert {
namespace {

/// Mean of 1 - |S| / A, by area, over the clusters of a cut into one for every 64 faces: 0 where
/// all are flat.
double Spread(const ClusterTree& tree, int64_t faces) {
  double lost = 0, area = 0;
  for (const int32_t node : CutToCount(tree, int64_t(tree.surfaceRoots.size()) + faces / 64)) {
    const ClusterNode& cluster = tree.nodes[size_t(node)];
    lost += double(cluster.area) - Length(Vec3d(cluster.vectorArea));
    area += cluster.area;
  }
  return area > 0 ? lost / area : 0;
}

/// Gives back what reading has freed, and starts the peak anew from what is in use (Linux).
void ForgetPeakMemory() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
}

void Measure(const std::string& file, const FaceClusteringOptions& options) {
  Scene scene = AssembleScene(ReadScene({file}));
  scene.mesh.Complete();
  const double faces = double(scene.mesh.FaceCount());

  // Faces.
  ForgetPeakMemory();
  const int64_t before = PeakMemoryBytes();
  FaceClusteringStatistics statistics;
  const ClusterTree tree = ClusterFaces(&scene.mesh, scene.parts, options, &statistics);
  const int64_t peak = PeakMemoryBytes() - before;
  const double resident = double(tree.nodes.capacity() * sizeof(ClusterNode) +
                                 tree.surfaceRoots.capacity() * sizeof(int32_t));

  // Volumes above them.
  std::vector<Box3f> boxes;
  for (const int32_t root : tree.surfaceRoots) boxes.push_back(tree.nodes[size_t(root)].bounds);
  const Timer timer;
  const size_t volumeNodes = ClusterVolumes(boxes).size();
  const double volumeSeconds = timer.Seconds();

  std::printf(
      "%s: %.0f triangles, %lld surfaces, %.3f s, %.2f us and %.0f (peak +%.0f) bytes a triangle, "
      "depth %d "
      "(%.2f log2 n), spread %.4f, %zu volumes in %.4f s\n",
      file.c_str(), faces, static_cast<long long>(statistics.surfaces), statistics.seconds,
      1e6 * statistics.seconds / faces, resident / faces, double(peak) / faces,
      statistics.maximumDepth, statistics.maximumDepthOverLog, Spread(tree, scene.mesh.FaceCount()),
      volumeNodes, volumeSeconds);
}

}  // namespace
}  // namespace lambert

int main(int argc, char** argv) {
  lambert::FaceClusteringOptions options;
  try {
    for (int i = 1; i < argc; ++i) {
      const std::string argument = argv[i];
      if (argument == "--threads" && i + 1 < argc) {
        lambert::SetThreadCount(std::stoi(argv[++i]));
      } else if (argument == "--balance" && i + 1 < argc) {
        options.balance = std::stod(argv[++i]);
      } else {
        lambert::Measure(argument, options);
      }
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
