#include "Atlas/Core/ChartMesh.h"

#include <gtest/gtest.h>

#include "Atlas/Testing/Unit/AtlasMeshes.h"
#include "Common/Core/Error.h"

namespace lambert {
namespace {

TEST(ChartMesh, AGridIsADisc) {
  const ChartMesh chart = WholeChart(FlatGrid(7));
  EXPECT_TRUE(chart.IsFlat());
  EXPECT_EQ(chart.positions.size(), 64u);
  ASSERT_EQ(chart.borders.size(), 1u);
  EXPECT_EQ(chart.borders[0].size(), 28u);
}

TEST(ChartMesh, ClosedSurfacesAndHandlesAreNotFlat) {
  const ChartMesh sphere = WholeChart(Sphere(10)), torus = WholeChart(Torus(20, 10));
  EXPECT_TRUE(sphere.isConnected && sphere.borders.empty() && sphere.genus == 0);
  EXPECT_FALSE(sphere.IsFlat());
  EXPECT_TRUE(torus.isConnected && torus.borders.empty());
  EXPECT_EQ(torus.genus, 1);

  // A torus with a face less has a border, and still a handle.
  TriangleMesh open = Torus(20, 10);
  open.triangles.pop_back();
  open = [&] {
    TriangleMesh copy;
    copy.positions = open.positions;
    copy.triangles = open.triangles;
    copy.Complete();
    return copy;
  }();
  const ChartMesh cut = WholeChart(open);
  EXPECT_EQ(cut.borders.size(), 1u);
  EXPECT_EQ(cut.genus, 1);
  EXPECT_FALSE(cut.IsFlat());
}

TEST(ChartMesh, ATubeHasTwoBorders) {
  const ChartMesh tube =
      WholeChart(GridMesh(12, 4, [](double u, double v) { return OnTurn(u, 1, v); }));
  EXPECT_EQ(tube.borders.size(), 2u);
  EXPECT_TRUE(tube.IsFlat());
}

TEST(ChartMesh, AMoebiusBandIsCutWhereFrontMeetsBack) {
  const ChartMesh band = WholeChart(MoebiusBand(24, 3));
  EXPECT_TRUE(band.IsFlat());
  EXPECT_EQ(band.borders.size(), 1u);
}

TEST(ChartMesh, FacesThatMeetInAPointOrAtACrowdedEdgeAreApart) {
  const ChartMesh fan = WholeChart(NonManifoldFan(5));
  EXPECT_FALSE(fan.isConnected);
  EXPECT_EQ(fan.borders.size(), 5u);
  EXPECT_EQ(fan.positions.size(), 15u);

  TriangleMesh bow;
  bow.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  bow.triangles = {{0, 1, 2}, {0, 3, 4}};
  bow.Complete();
  const ChartMesh two = WholeChart(bow);
  EXPECT_FALSE(two.isConnected);
  EXPECT_EQ(two.positions.size(), 6u);
}

TEST(ChartMesh, ARangeOfFacesHasABorderOfItsOwn) {
  TriangleMesh mesh = FlatGrid(4);
  mesh.surfaceId.assign(mesh.triangles.size(), 0);
  const std::vector<int32_t> neighbours = FindNeighbours(mesh);
  const ChartMesh row =
      MakeChartMesh(mesh, neighbours, FacesFrom(8, 8));  // The second row of cells.
  EXPECT_TRUE(row.IsFlat());
  EXPECT_EQ(row.positions.size(), 10u);
  EXPECT_EQ(row.borders[0].size(), 10u);
}

TEST(ChartMesh, AMeshWithoutSurfacesIsRefused) { EXPECT_THROW(FindNeighbours(FlatGrid(2)), Error); }

TEST(ChartMesh, TrianglesLieOnTheirLongestEdge) {
  ChartMesh chart;
  chart.positions = {{0, 0, 0}, {0, 0, 3}, {0, 4, 0}};
  chart.triangles = {{0, 1, 2}};
  const FlatTriangle flat = Flatten(chart, 0);
  EXPECT_EQ(flat.first, 1);
  EXPECT_DOUBLE_EQ(flat.length, 5);
  EXPECT_DOUBLE_EQ(flat.height, 12. / 5);
  EXPECT_DOUBLE_EQ(flat.x, 9. / 5);
  chart.positions[0] = {0, 2, 1.5};
  EXPECT_TRUE(Flatten(chart, 0).IsSliver());
}

}  // namespace
}  // namespace lambert
