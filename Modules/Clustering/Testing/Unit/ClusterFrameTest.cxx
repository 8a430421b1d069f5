#include "Clustering/Core/ClusterFrame.h"

#include <gtest/gtest.h>

#include "ClusteringMeshes.h"

namespace lambert {
namespace {

ClusterNode Whole(const TriangleMesh& mesh) {
  ClusterNode node;
  node.faceCount = int32_t(mesh.FaceCount());
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    node.area += mesh.Area(face);
    node.vectorArea += mesh.VectorArea(face);
  }
  return node;
}

void CheckFrame(const TriangleMesh& mesh, const ClusterNode& node) {
  const ClusterFrame frame = ComputeClusterFrame(mesh, node);
  ASSERT_TRUE(IsFinite(frame.center) && IsFinite(frame.halfExtent));
  for (int k = 0; k < 3; ++k) {
    ASSERT_TRUE(IsFinite(frame.axes[size_t(k)]));
    ASSERT_NEAR(Length(frame.axes[size_t(k)]), 1, 1e-5);  // float
    ASSERT_NEAR(Dot(frame.axes[size_t(k)], frame.axes[size_t((k + 1) % 3)]), 0, 1e-5);
    ASSERT_GE(frame.halfExtent[k], 0);
  }
  ASSERT_GT(Dot(Cross(frame.axes[0], frame.axes[1]), frame.axes[2]), 0.999f);
  // Where the normals cancel, what is left of their sum may lie in the plane: rounding decides.
  ASSERT_GE(Dot(frame.axes[2], node.vectorArea), -1e-6f * node.area);
  for (int32_t face = node.firstFace; face < node.firstFace + node.faceCount; ++face) {
    for (int k = 0; k < 3; ++k) {
      const Vec3d d = Vec3d(mesh.Corner(face, k)) - Vec3d(frame.center);
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_LE(std::abs(Dot(d, Vec3d(frame.axes[size_t(axis)]))),
                  double(frame.halfExtent[axis]));
      }
    }
  }
}

TEST(ClusterFrame, HoldsEveryClusterOfATree) {
  for (TriangleMesh mesh :
       {Torus(40, 16), Sphere(12), FlatGrid(12), SliverGrid(12), Soup(4, 50, 300)}) {
    const ClusterTree tree = ClusterFaces(&mesh, std::vector<Part>(3));
    for (const ClusterNode& node : tree.nodes) CheckFrame(mesh, node);
  }
}

TEST(ClusterFrame, HoldsClustersFarFromTheOrigin) {
  TriangleMesh mesh = Torus(30, 10);
  for (Vec3f& p : mesh.positions) p += Vec3f(5000, -3000, 100);
  CheckFrame(mesh, Whole(mesh));
}

TEST(ClusterFrame, OfATurnedRectangleIsTheRectangle) {
  TriangleMesh mesh = FlatGrid(6);
  const Vec3f u = Normalize(Vec3f(1, 2, 2)), v = Normalize(Vec3f(2, 1, -2)), n = Cross(u, v);
  for (Vec3f& p : mesh.positions) p = u * (3 * p.x) + v * p.y + n * 2;
  const ClusterFrame frame = ComputeClusterFrame(mesh, Whole(mesh));
  // Float coordinates of some metres.
  EXPECT_NEAR(frame.halfExtent.x, 1.5, 1e-5);
  EXPECT_NEAR(frame.halfExtent.y, 0.5, 1e-5);
  EXPECT_NEAR(frame.halfExtent.z, 0, 1e-5);
  EXPECT_NEAR(std::abs(Dot(frame.axes[0], u)), 1, 1e-5);
  EXPECT_NEAR(Dot(frame.axes[2], n), 1, 1e-5);
  EXPECT_NEAR(Length(frame.center - (u * 1.5f + v * 0.5f + n * 2.f)), 0, 1e-5);
}

TEST(ClusterFrame, OfDegenerateTrianglesIsFinite) {
  const std::array<std::array<Vec3f, 3>, 4> triangles{{
      {{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}},                 // a point
      {{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}},                 // a line
      {{{0, 0, 0}, {1000, 0, 0}, {500, 1e-6f, 0}}},        // a needle
      {{{1e-20f, 0, 0}, {0, 1e-20f, 0}, {0, 0, 1e-20f}}},  // an area that underflows
  }};
  for (const auto& t : triangles) {
    TriangleMesh mesh;
    mesh.positions = {t[0], t[1], t[2]};
    mesh.triangles = {{0, 1, 2}};
    CheckFrame(mesh, Whole(mesh));
  }
}

double AreaOf(const Rectangle2& r) { return 4.0 * r.halfExtent.x * r.halfExtent.y; }

/// Smallest of the rectangles along every pair of points: one of them lies along a side of the
/// hull.
double SmallestByTrial(const std::vector<Vec2f>& points) {
  double smallest = std::numeric_limits<double>::max();
  for (const Vec2f& a : points) {
    for (const Vec2f& b : points) {
      const Vec2d d = Vec2d(b) - Vec2d(a);
      const double length = std::hypot(d.x, d.y);
      if (length == 0) continue;
      Vec2d low{1e30, 1e30}, high{-1e30, -1e30};
      for (const Vec2f& p : points) {
        const double s = (p.x * d.x + p.y * d.y) / length, t = (p.y * d.x - p.x * d.y) / length;
        low = {std::min(low.x, s), std::min(low.y, t)},
        high = {std::max(high.x, s), std::max(high.y, t)};
      }
      smallest = std::min(smallest, (high.x - low.x) * (high.y - low.y));
    }
  }
  return smallest;
}

TEST(MinimumAreaRectangle, IsTheSmallestAndHoldsThePoints) {
  for (uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    std::vector<Vec2f> points;
    const int count = 3 + int(seed % 30);
    for (int i = 0; i < count; ++i) points.push_back({random.Uniform() * 3 + 10, random.Uniform()});
    const Rectangle2 r = MinimumAreaRectangle(points);
    EXPECT_NEAR(AreaOf(r), SmallestByTrial(points), 1e-5);  // float corners of a few metres
    EXPECT_NEAR(std::hypot(r.axis.x, r.axis.y), 1, 1e-6);
    EXPECT_GE(r.halfExtent.x, r.halfExtent.y);
    for (const Vec2f& p : points) {
      const Vec2f d = p - r.center;
      EXPECT_LE(std::abs(d.x * r.axis.x + d.y * r.axis.y), r.halfExtent.x + 1e-5f);
      EXPECT_LE(std::abs(d.y * r.axis.x - d.x * r.axis.y), r.halfExtent.y + 1e-5f);
    }
  }
}

TEST(MinimumAreaRectangle, OfFewOrCollinearPoints) {
  EXPECT_EQ(MinimumAreaRectangle({}).halfExtent, Vec2f(0, 0));
  const Rectangle2 point = MinimumAreaRectangle({{2, 3}, {2, 3}});
  EXPECT_EQ(point.center, Vec2f(2, 3));
  EXPECT_EQ(point.halfExtent, Vec2f(0, 0));
  EXPECT_EQ(point.axis, Vec2f(1, 0));
  const Rectangle2 line = MinimumAreaRectangle({{0, 0}, {3, 4}, {1.5f, 2}, {0.75f, 1}});
  EXPECT_FLOAT_EQ(line.halfExtent.x, 2.5f);
  EXPECT_NEAR(line.halfExtent.y, 0, 1e-6);
  EXPECT_NEAR(std::abs(line.axis.x), 0.6, 1e-6);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(MinimumAreaRectangle({{nan, 0}, {1, 1}}).center, Vec2f(1, 1));
}

TEST(MinimumAreaRectangle, OfNeedlesAndHugeCoordinatesIsFinite) {
  for (uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const float thin = std::ldexp(1.f, -int(seed % 60)),
                scale = std::ldexp(1.f, int(seed % 100) - 50);
    std::vector<Vec2f> points;
    for (int i = 0; i < 20; ++i) {
      const float t = random.Uniform();
      points.push_back({scale * t, scale * (0.7f * t + thin * random.Uniform())});
    }
    const Rectangle2 r = MinimumAreaRectangle(points);
    ASSERT_TRUE(std::isfinite(r.center.x + r.center.y + r.axis.x + r.axis.y + r.halfExtent.x +
                              r.halfExtent.y));
    ASSERT_NEAR(std::hypot(r.axis.x, r.axis.y), 1, 1e-6);
    // Never more than along the first axis of the plane.
    ASSERT_LE(AreaOf(r), 4.0 * scale * scale);
  }
}

}  // namespace
}  // namespace lambert
