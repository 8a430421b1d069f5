#include "Clustering/Core/KeptClustering.h"

#include <numeric>

#include "Clustering/Core/FaceOrder.h"
#include "Common/Core/ContentHash.h"

namespace lambert {

namespace {

/// Of all that the tree depends on.
uint64_t KeyOf(const TriangleMesh& mesh, const std::vector<Part>& parts,
               const FaceClusteringOptions& options) {
  uint64_t key = HashOf<double>({options.balance}, 1);
  key = HashOf(mesh.positions, key);
  key = HashOf(mesh.triangles, key);
  key = HashOf(mesh.materialId, key);
  key = HashOf(mesh.partId, key);
  for (const Part& part : parts) {
    key = HashBits(key, uint64_t(part.meshId));
    key = HashOfBytes(part.objectToWorld.data(), sizeof part.objectToWorld, key);
  }
  return key;
}

}  // namespace

const ClusterTree& KeptClustering::Cluster(TriangleMesh* mesh, const std::vector<Part>& parts,
                                           const FaceClusteringOptions& options,
                                           FaceClusteringStatistics* statistics,
                                           const ProgressCallback& progress) {
  // The tree that there is.
  mesh->Complete();
  const uint64_t key = KeyOf(*mesh, parts, options);
  if (key == key_) {
    ReorderFaces(order_, mesh);
    mesh->surfaceId = surfaceId_;
    return tree_;
  }

  // Another one; the numbers of the faces ride along in place of the source's.
  key_ = 0;
  std::vector<int64_t> source = mesh->sourceCellId;
  std::iota(mesh->sourceCellId.begin(), mesh->sourceCellId.end(), 0);
  tree_ = ClusterFaces(mesh, parts, options, statistics, progress);
  order_.assign(mesh->sourceCellId.begin(), mesh->sourceCellId.end());
  for (size_t face = 0; face < order_.size(); ++face) {
    mesh->sourceCellId[face] = source[size_t(order_[face])];
  }
  surfaceId_ = mesh->surfaceId;
  key_ = key;
  return tree_;
}

}  // namespace lambert
