#include "Scene/Core/PointNormals.h"

#include <gtest/gtest.h>

#include "Scene/Testing/Unit/SmallMeshes.h"

namespace lambert {
namespace {

using namespace testing;

PointNormalCounts Complete(double featureAngle, TriangleMesh* mesh) {
  MeshTopology topology = ConnectFaces(*mesh);
  const PointNormalCounts counts = CompletePointNormals(featureAngle, mesh, &topology);
  EXPECT_EQ(topology.positionId.size(), mesh->positions.size());
  EXPECT_EQ(mesh->normals.size(), mesh->positions.size());
  return counts;
}

TEST(PointNormals, CubeHasTwentyFour) {
  TriangleMesh cube = MakeCube();
  EXPECT_EQ(Complete(30, &cube).made, 24);
  EXPECT_EQ(cube.PointCount(), 24);
  for (int64_t face = 0; face < 12; ++face) {
    for (const int32_t point : cube.triangles[size_t(face)]) {
      EXPECT_EQ(cube.normals[size_t(point)], cube.FrontNormal(face));
    }
  }
}

TEST(PointNormals, CubeOfAWideFeatureAngleIsRound) {
  // The three faces at a corner count alike, however the squares are cut.
  TriangleMesh cube = MakeCube();
  Complete(91, &cube);
  EXPECT_EQ(cube.PointCount(), 8);
  for (size_t point = 0; point < 8; ++point) {
    EXPECT_LT(Length(cube.normals[point] - Normalize(cube.positions[point])), 1e-6f);
  }
}

TEST(PointNormals, PointsAtOnePlaceShareTheNormalOfTheirFaces) {
  // A cube whose triangles share no point.
  const TriangleMesh cube = MakeCube();
  TriangleMesh soup = cube;
  soup.positions.clear();
  for (auto& triangle : soup.triangles) {
    for (int32_t& point : triangle) {
      soup.positions.push_back(cube.positions[size_t(point)]);
      point = int32_t(soup.positions.size()) - 1;
    }
  }
  EXPECT_EQ(Complete(91, &soup).made, 36);
  ASSERT_EQ(soup.PointCount(), 36);
  for (size_t point = 0; point < 36; ++point) {
    EXPECT_LT(Length(soup.normals[point] - Normalize(soup.positions[point])), 1e-6f);
  }
}

TEST(PointNormals, CylinderIsSmoothOnItsBarrelAndSharpAtItsRims) {
  TriangleMesh cylinder = MakeCylinder(90);
  Complete(30, &cylinder);
  EXPECT_EQ(cylinder.PointCount(), 2 + 4 * 90);
  for (size_t point = 0; point < cylinder.positions.size(); ++point) {
    const Vec3f& normal = cylinder.normals[point];
    if (std::abs(normal.z) > 0.5f) continue;
    // Three or so float roundings of coordinates about 1.
    EXPECT_LT(Length(normal - Vec3f(cylinder.positions[point].x, cylinder.positions[point].y, 0)),
              1e-5f);
  }

  // 8 sides of 45 degrees are edges.
  TriangleMesh octagon = MakeCylinder(8);
  Complete(30, &octagon);
  EXPECT_EQ(octagon.PointCount(), 2 + 6 * 8);
}

TEST(PointNormals, FilesNormalsStayAndBrokenOnesAreRepaired) {
  TriangleMesh square = MakeSquare();
  const float nan = std::nanf("");
  square.normals = {{0.6f, 0, 0.8f}, {nan, 0, 1}, {0, 0, 0}, {0, 0, 7}};
  const PointNormalCounts counts = Complete(30, &square);
  EXPECT_EQ(counts.made, 0);
  EXPECT_EQ(counts.repaired, 2);
  EXPECT_FLOAT_EQ(square.normals[0].x, 0.6f);
  for (const size_t point : {1, 2, 3}) EXPECT_EQ(square.normals[point], Vec3f(0, 0, 1));
}

TEST(PointNormals, OfPointsWithoutAreaAreStillUnit) {
  TriangleMesh flat = MakeMesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}}, {{0, 1, 2}});
  Complete(30, &flat);
  for (const Vec3f& normal : flat.normals) EXPECT_EQ(normal, Vec3f(0, 0, 1));
}

TEST(PointNormals, CreasedPointsKeepTheirNumberAndGetCopiesBehind) {
  TriangleMesh cube = MakeCube();
  const std::vector<Vec3f> before = cube.positions;
  Complete(30, &cube);
  for (size_t point = 0; point < before.size(); ++point) {
    EXPECT_EQ(cube.positions[point], before[point]);
  }
}

}  // namespace
}  // namespace lambert
