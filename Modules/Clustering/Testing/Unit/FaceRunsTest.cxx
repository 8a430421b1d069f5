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

// Sums by runs are rounded otherwise than face by face, by 1e-16 of them an addition: of 10,000
// faces by 1e-12.
TEST(FaceRuns, TellTheSpreadThatFacesTell) {
  for (TriangleMesh mesh : ManyFaces()) {
    const ClusterTree tree = ClusterFaces(&mesh, std::vector<Part>(3));
    const FaceRuns runs(mesh);
    for (const ClusterNode& node : tree.nodes) {
      const PointSpread expected =
          PointSpread::OfCorners(mesh, node.firstFace, node.firstFace + node.faceCount);
      const PointSpread spread = runs.SpreadOf(node);
      const Vec3d& d = expected.diagonal;
      const double square = d.x + d.y + d.z, size = std::sqrt(square / expected.count);
      ASSERT_EQ(spread.count, expected.count);
      ASSERT_LE(Length(spread.mean - expected.mean), 1e-12 * (size + Length(expected.mean)));
      ASSERT_LE(Length(spread.diagonal - expected.diagonal), 1e-12 * square);
      ASSERT_LE(Length(spread.mixed - expected.mixed), 1e-12 * square);
    }
  }
}

// Where points spread alike to all sides the axes are chance, and the box holds them all the same.
TEST(FaceRuns, GiveFramesThatHoldTheFaces) {
  for (TriangleMesh mesh : ManyFaces()) {
    const ClusterTree tree = ClusterFaces(&mesh, std::vector<Part>(3));
    const FaceRuns runs(mesh);
    for (const ClusterNode& node : tree.nodes) {
      const ClusterFrame frame = ComputeClusterFrame(runs, node);
      for (int32_t face = node.firstFace; face < node.firstFace + node.faceCount; ++face) {
        for (int corner = 0; corner < 3; ++corner) {
          const Vec3d offset = Vec3d(mesh.Corner(face, corner)) - Vec3d(frame.center);
          for (int k = 0; k < 3; ++k) {
            ASSERT_LE(std::abs(Dot(offset, Vec3d(frame.axes[size_t(k)]))), frame.halfExtent[k]);
          }
        }
      }
    }
  }
}

// What lies within what was met does not move the box.
TEST(FaceRuns, GiveTheFramesOfTheFaces) {
  for (TriangleMesh mesh : ManyFaces()) {
    const ClusterTree tree = ClusterFaces(&mesh, std::vector<Part>(3));
    const FaceRuns runs(mesh);
    for (const int32_t root : tree.surfaceRoots) {
      const ClusterNode& node = tree.nodes[size_t(root)];
      const ClusterFrame frame = ComputeClusterFrame(runs, node);
      Vec3d low, high;
      for (int32_t face = node.firstFace; face < node.firstFace + node.faceCount; ++face) {
        for (int corner = 0; corner < 3; ++corner) {
          const Vec3d offset = Vec3d(mesh.Corner(face, corner)) - Vec3d(frame.center);
          for (int k = 0; k < 3; ++k) {
            const double along = Dot(offset, Vec3d(frame.axes[size_t(k)]));
            low[k] = std::min(low[k], along), high[k] = std::max(high[k], along);
          }
        }
      }
      // As tight as floats tell.
      const float size = node.bounds.Diagonal();
      for (int k = 0; k < 3; ++k) {
        ASSERT_NEAR(high[k], double(frame.halfExtent[k]), 1e-6 * double(size));
        ASSERT_NEAR(low[k], -double(frame.halfExtent[k]), 1e-6 * double(size));
      }
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
      runs.ForEachOuterPoint(
          node, [&](const Vec3f& p) { met.insert(p); }, [](const Box3f&) { return false; });
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
