// Clusters that are kept are those that clustering anew makes.
#include "Clustering/Core/KeptClustering.h"

#include <gtest/gtest.h>

#include <cstring>

#include "ClusteringMeshes.h"
#include "Common/Core/Error.h"

namespace lambert {
namespace {

/// A mesh whose faces all differ in what they reflect.
TriangleMesh Painted(TriangleMesh mesh, float shade) {
  mesh.Complete();
  for (size_t face = 0; face < mesh.triangles.size(); ++face) {
    mesh.reflectance[face] = {shade, float(face) / float(mesh.triangles.size()), 0.5f};
  }
  return mesh;
}

/// Holds `kept` against clustering anew; true where it did that itself.
bool ClustersAnew(KeptClustering* kept, const TriangleMesh& mesh,
                  const FaceClusteringOptions& options = {}) {
  const std::vector<Part> parts(1);
  TriangleMesh own = mesh, other = mesh;
  FaceClusteringStatistics statistics;
  const ClusterTree& tree = kept->Cluster(&own, parts, options, &statistics);
  const ClusterTree fresh = ClusterFaces(&other, parts, options);
  EXPECT_EQ(tree.surfaceRoots, fresh.surfaceRoots);
  EXPECT_EQ(tree.nodes.size(), fresh.nodes.size());
  EXPECT_EQ(
      std::memcmp(tree.nodes.data(), fresh.nodes.data(), fresh.nodes.size() * sizeof(ClusterNode)),
      0);
  EXPECT_EQ(own.triangles, other.triangles);
  EXPECT_EQ(own.surfaceId, other.surfaceId);
  EXPECT_EQ(own.sourceCellId, other.sourceCellId);
  EXPECT_EQ(own.materialId, other.materialId);
  EXPECT_TRUE(own.reflectance == other.reflectance);
  return statistics.nodes > 0;
}

TEST(KeptClusteringTest, KeepsTheTreeOfWhatIsOnlyPaintedAnew) {
  KeptClustering kept;
  const TriangleMesh sphere = Sphere(12);
  EXPECT_TRUE(ClustersAnew(&kept, Painted(sphere, 0.2f)));
  EXPECT_FALSE(ClustersAnew(&kept, Painted(sphere, 0.2f)));
  EXPECT_FALSE(ClustersAnew(&kept, Painted(sphere, 0.7f)));
}

TEST(KeptClusteringTest, ClustersAnewWhatHasOtherSurfaces) {
  KeptClustering kept;
  TriangleMesh mesh = Painted(FlatGrid(8), 0.2f);
  EXPECT_TRUE(ClustersAnew(&kept, mesh));
  mesh.positions[0].z += 0.01f;
  EXPECT_TRUE(ClustersAnew(&kept, mesh));
  mesh.materialId[5] = 1;
  EXPECT_TRUE(ClustersAnew(&kept, mesh));
  std::swap(mesh.triangles[0], mesh.triangles[9]);
  EXPECT_TRUE(ClustersAnew(&kept, mesh));
  FaceClusteringOptions options;
  options.balance = 0.5;
  EXPECT_TRUE(ClustersAnew(&kept, mesh, options));
  EXPECT_FALSE(ClustersAnew(&kept, mesh, options));
}

// A run that was cancelled leaves nothing to be taken for a tree.
TEST(KeptClusteringTest, KeepsNothingOfWhatWasCancelled) {
  KeptClustering kept;
  const TriangleMesh mesh = Painted(Sphere(12), 0.2f);
  TriangleMesh cancelled = mesh;
  EXPECT_THROW(kept.Cluster(&cancelled, std::vector<Part>(1), {}, nullptr,
                            [](double, const char*) { return false; }),
               Cancelled);
  EXPECT_TRUE(ClustersAnew(&kept, mesh));
}

}  // namespace
}  // namespace lambert
