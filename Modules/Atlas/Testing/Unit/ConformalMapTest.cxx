#include "Atlas/Core/ConformalMap.h"

#include <gtest/gtest.h>

#include "Atlas/Testing/Unit/AtlasMeshes.h"

namespace lambert {
namespace {

// What is developable comes out as it is, to the rounding of its points.
TEST(ConformalMap, APlaneKeepsItsShape) {
  const ChartMesh plane = WholeChart(GridMesh(
      9, 5, [](double u, double v) { return Vec3f(float(u), float(2 * v), float(0.5 * u - v)); }));
  EXPECT_NEAR(Stretch(plane, ConformalMap(plane)), 1, 1e-4);
}

TEST(ConformalMap, ACylinderUnrolls) {
  const ChartMesh cylinder =
      WholeChart(GridMesh(64, 8, [](double u, double v) { return OnTurn(0.9 * u, 1, 3 * v); }));
  const std::vector<Vec2d> map = ConformalMap(cylinder);
  EXPECT_NEAR(Stretch(cylinder, map), 1, 1e-3);
  double longest = 0;
  for (const Vec2d& a : map)
    longest = std::max(longest, std::hypot(a.x - map[0].x, a.y - map[0].y));
  const double turn = 2 * 64 * std::sin(kPi * 0.9 / 64);  // Of the polygon.
  EXPECT_NEAR(longest, std::hypot(turn, 3), 1e-3);
}

TEST(ConformalMap, SliversDoNotPoisonWhatIsAroundThem) {
  // Needles of an aspect up to a million, and a vertex on an edge.
  const ChartMesh needles = WholeChart(SliverGrid(60));
  EXPECT_NEAR(Stretch(needles, ConformalMap(needles)), 1, 1e-2);
  TriangleMesh tee;
  tee.positions = {{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, -1, 0}};
  tee.triangles = {{0, 2, 3}, {2, 1, 3}, {0, 1, 2}, {1, 0, 4}};
  tee.Complete();
  const ChartMesh chart = WholeChart(tee);
  EXPECT_NEAR(Stretch(chart, ConformalMap(chart)), 1, 1e-6);
}

// A sphere without its lower half: a conformal map of a disc onto a disc shrinks its middle and
// grows its rim by root 2 at best.
TEST(ConformalMap, AHemisphereStretchesByRootTwo) {
  TriangleMesh mesh = GridMesh(48, 24, [](double u, double v) {
    const double z = std::cos(0.5 * kPi * std::max(v, 0.02));
    return OnTurn(u, std::sqrt(1 - z * z), z);
  });
  const ChartMesh half = WholeChart(mesh);
  ASSERT_EQ(half.borders.size(), 2u);  // A small hole at the pole.
  const double stretch = Stretch(half, ConformalMap(half));
  EXPECT_GT(stretch, 1.35);
  EXPECT_LT(stretch, 2.5);
}

TEST(ConformalMap, OverlapsAndFlipsAreFound) {
  // A strip that winds one and a half times about an axis, seen along it.
  const ChartMesh spiral = WholeChart(GridMesh(60, 2, [](double u, double v) {
    const double angle = 3 * kPi * u, radius = 1 + v;
    return Vec3f(float(radius * std::cos(angle)), float(radius * std::sin(angle)), float(0.1 * u));
  }));
  EXPECT_EQ(Stretch(spiral, ProjectedMap(spiral, {0, 0, 1})), 0);
  EXPECT_EQ(Stretch(spiral, ProjectedMap(spiral, {0, 0, -1})), 0);

  // One turn less does not overlap; from behind all of it is flipped.
  const ChartMesh turn = WholeChart(GridMesh(60, 2, [](double u, double v) {
    const double angle = 1.5 * kPi * u, radius = 1 + v;
    return Vec3f(float(radius * std::cos(angle)), float(radius * std::sin(angle)), 0);
  }));
  const bool isUp = Stretch(turn, ProjectedMap(turn, {0, 0, 1})) > 0;
  const bool isDown = Stretch(turn, ProjectedMap(turn, {0, 0, -1})) > 0;
  EXPECT_NE(isUp, isDown);

  // A single flipped triangle.
  const ChartMesh grid = WholeChart(FlatGrid(4));
  std::vector<Vec2d> map = ProjectedMap(grid, {0, 0, 1});
  EXPECT_NEAR(Stretch(grid, map), 1, 1e-6);
  size_t inner = 0;
  while (grid.positions[inner].x != 0.5 || grid.positions[inner].y != 0.5) ++inner;
  map[inner] = map[inner] + (map[0] - map[inner]) * 3;
  EXPECT_EQ(Stretch(grid, map), 0);
}

// A border that crosses itself while no triangle is flipped: a flat ring that is opened and wound
// once more than it may.
TEST(ConformalMap, HolesAreNoOverlaps) {
  TriangleMesh ring = GridMesh(24, 2, [](double u, double v) { return OnTurn(u, 2 - v, 0); });
  const ChartMesh chart = WholeChart(ring);
  ASSERT_EQ(chart.borders.size(), 2u);
  const double up = Stretch(chart, ProjectedMap(chart, {0, 0, 1}));
  const double down = Stretch(chart, ProjectedMap(chart, {0, 0, -1}));
  EXPECT_NEAR(std::max(up, down), 1, 1e-5);
  EXPECT_EQ(std::min(up, down), 0);
}

}  // namespace
}  // namespace lambert
