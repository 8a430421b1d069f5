// Face clusters that are kept from one time to the next: they belong to the geometry, and a change
// of material or light makes none anew (thesis 2.4.3).
#pragma once

#include <cstdint>
#include <vector>

#include "Clustering/Core/FaceClustering.h"

namespace lambert {

class KeptClustering {
 public:
  /// As ClusterFaces; where points, faces, parts, the borders of materials and the options are
  /// those of the last time it only brings the faces of `mesh` into the order of the tree that
  /// there is. `statistics` are then left alone. Throws as ClusterFaces does, and keeps nothing
  /// then.
  const ClusterTree& Cluster(TriangleMesh* mesh, const std::vector<Part>& parts,
                             const FaceClusteringOptions& options,
                             FaceClusteringStatistics* statistics,
                             const ProgressCallback& progress = {});

 private:
  uint64_t key_ = 0;
  ClusterTree tree_;
  std::vector<int32_t> order_;      ///< per face in tree order: the face it was
  std::vector<int32_t> surfaceId_;  ///< per face in tree order
};

}  // namespace lambert
