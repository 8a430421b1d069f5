#include "Clustering/Core/FaceRuns.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "Clustering/Core/ClusterFrame.h"
#include "ClusteringMeshes.h"

namespace lambert {
namespace {

/// Of clusters that hold many runs, some, and none.
std::vector<TriangleMesh> ManyFaces() {
  return {Torus(80, 32), Sphere(40), FlatGrid(40), SliverGrid(30), Soup(4, 50, 300)};
}

float LeastCosineByTrial(const TriangleMesh& mesh, const ClusterNode& node, const Vec3f& axis,
                         float negligible) {
  float least = 1;
  for (int32_t face = node.firstFace; face < node.firstFace + node.faceCount; ++face) {
    const float area = mesh.Area(face);
    if (area > negligible) least = std::min(least, Dot(mesh.VectorArea(face), axis) / area);
  }
  return least;
}

TEST(FaceRuns, GiveTheFramesThatFacesGive) {
  for (TriangleMesh mesh : ManyFaces()) {
    const ClusterTree tree = ClusterFaces(&mesh, std::vector<Part>(3));
    const FaceRuns runs(mesh);
    for (const ClusterNode& node : tree.nodes) {
      const ClusterFrame expected = ComputeClusterFrame(mesh, node);
      const ClusterFrame frame = ComputeClusterFrame(runs, node);
      ASSERT_EQ(frame.center, expected.center);
      ASSERT_EQ(frame.axes, expected.axes);
      ASSERT_EQ(frame.halfExtent, expected.halfExtent);
    }
  }
}

TEST(FaceRuns, FindTheNormalFarthestFromAnAxis) {
  for (TriangleMesh mesh : ManyFaces()) {
    const ClusterTree tree = ClusterFaces(&mesh, std::vector<Part>(3));
    const FaceRuns runs(mesh);
    for (const ClusterNode& node : tree.nodes) {
      const float mean = node.area / float(node.faceCount);
      for (const Vec3f& axis :
           {Normalize(node.vectorArea), Vec3f(0, 0, 1), Vec3f(0.6f, -0.8f, 0)}) {
        for (const float negligible : {0.f, mean}) {
          ASSERT_EQ(runs.LeastCosine(node, axis, negligible),
                    LeastCosineByTrial(mesh, node, axis, negligible));
        }
      }
    }
  }
}

TEST(FaceRuns, MeetEveryPoint) {
  for (TriangleMesh mesh : ManyFaces()) {
    const ClusterTree tree = ClusterFaces(&mesh, std::vector<Part>(3));
    const FaceRuns runs(mesh);
    const auto isBefore = [](const Vec3f& a, const Vec3f& b) {
      return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    for (const int32_t root : tree.surfaceRoots) {
      const ClusterNode& node = tree.nodes[size_t(root)];
      std::set<Vec3f, decltype(isBefore)> met(isBefore), expected(isBefore);
      runs.ForEachPoint(node, [&](const Vec3f& p) { met.insert(p); });
      for (int32_t face = node.firstFace; face < node.firstFace + node.faceCount; ++face) {
        for (int k = 0; k < 3; ++k) expected.insert(mesh.Corner(face, k));
      }
      ASSERT_EQ(met.size(), expected.size());
      EXPECT_TRUE(std::equal(met.begin(), met.end(), expected.begin()));
    }
  }
}

}  // namespace
}  // namespace lambert
