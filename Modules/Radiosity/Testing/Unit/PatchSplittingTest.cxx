// Where patches are cut, and how their polygons are triangulated.
#include "Radiosity/Core/PatchSplitting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "Radiosity/Core/PatchTriangulation.h"

namespace lambert {
namespace {

using Border = std::vector<PatchBorderVertex>;

Vec2d PlaceOf(const Border& border, const PatchCutEnd& end) {
  const Vec2d from = border[size_t(end.from)].position;
  return end.to < 0 ? from : from + (border[size_t(end.to)].position - from) * end.fraction;
}

double Area(Vec2d a, Vec2d b, Vec2d c) {
  return 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}

double Area(const Border& border) {
  double area = 0;
  for (size_t i = 2; i < border.size(); ++i) {
    area += Area(border[0].position, border[i - 1].position, border[i].position);
  }
  return area;
}

// A triangle with up to `most` t-vertices at random places of each side.
Border RandomBorder(std::mt19937* random, double height, int most) {
  std::uniform_real_distribution<double> unit(0, 1);
  const Vec2d corners[3] = {{0, 0}, {1.37, 0.1}, {1.3 * unit(*random), 0.2 + height}};
  Border border;
  for (int side = 0; side < 3; ++side) {
    std::vector<double> places(size_t((*random)() % uint32_t(most + 1)));
    for (double& t : places) t = unit(*random);
    std::sort(places.begin(), places.end());
    border.push_back({corners[side], true});
    for (const double t : places) {
      border.push_back({corners[side] * (1 - t) + corners[(side + 1) % 3] * t, false});
    }
  }
  return border;
}

TEST(PatchSplitting, RectangleOfARectangleIsItself) {
  const double angle = 0.3, c = std::cos(angle), s = std::sin(angle);
  Border border;
  for (const Vec2d p : {Vec2d(0, 0), Vec2d(3, 0), Vec2d(3, 1), Vec2d(0, 1)}) {
    border.push_back({{c * p.x - s * p.y, s * p.x + c * p.y}, true});
  }
  const PatchRectangle rectangle = MinimumPatchRectangle(border);
  // Roundings of doubles.
  EXPECT_NEAR(rectangle.length, 3, 1e-12);
  EXPECT_NEAR(rectangle.width, 1, 1e-12);
  EXPECT_NEAR(std::abs(rectangle.axis.x), c, 1e-12);
  EXPECT_NEAR(rectangle.center.x, c * 1.5 - s * 0.5, 1e-12);
}

TEST(PatchSplitting, RectangleIsNoLargerThanAnyOther) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const Border border = RandomBorder(&random, 0.5, 2);
    const PatchRectangle rectangle = MinimumPatchRectangle(border);
    for (double angle = 0; angle < 1.6; angle += 0.01) {
      double low[2] = {1e9, 1e9}, high[2] = {-1e9, -1e9};
      for (const PatchBorderVertex& v : border) {
        const double x = std::cos(angle) * v.position.x + std::sin(angle) * v.position.y;
        const double y = std::cos(angle) * v.position.y - std::sin(angle) * v.position.x;
        low[0] = std::min(low[0], x), high[0] = std::max(high[0], x);
        low[1] = std::min(low[1], y), high[1] = std::max(high[1], y);
      }
      // Areas within 1e-4 count as equal.
      EXPECT_LE(rectangle.length * rectangle.width,
                (high[0] - low[0]) * (high[1] - low[1]) * (1 + 2e-4));
    }
  }
}

TEST(PatchSplitting, CutGoesThroughTheMiddle) {
  const Border border = {{{0, 0}}, {{4, 0}}, {{4, 1}}, {{0, 1}}};
  for (const PatchCutEnd& end : CutPatch(border, 0.15)) {
    EXPECT_DOUBLE_EQ(PlaceOf(border, end).x, 2);
    EXPECT_GE(end.to, 0);
  }
}

TEST(PatchSplitting, CutSnapsToANearVertex) {
  // Within 0.15 of the length 4 of the middle, and beyond it.
  for (const double x : {2.5, 2.7}) {
    const Border border = {{{0, 0}}, {{x, 0}, false}, {{4, 0}}, {{4, 2}}, {{0, 2}}};
    const auto cut = CutPatch(border, 0.15);
    const bool isSnapped =
        (cut[0].to < 0 && cut[0].from == 1) || (cut[1].to < 0 && cut[1].from == 1);
    EXPECT_EQ(isSnapped, x == 2.5);
  }
}

TEST(PatchSplitting, SnappingLeavesNoShortSides) {
  // An end is a vertex, or keeps from all of them by the tolerance; where the line must not lean,
  // by the width of the patch, as far as it might have leaned to a vertex.
  std::mt19937 random(7);
  int kept = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Border border = RandomBorder(&random, trial % 2 == 0 ? 0.6 : 0.02, 6);
    const PatchRectangle rectangle = MinimumPatchRectangle(border);
    for (const double tolerance : {0.05, 0.15}) {
      const auto cut = CutPatch(border, tolerance);
      const Vec2d a = PlaceOf(border, cut[0]), b = PlaceOf(border, cut[1]);
      const double width = std::hypot(b.x - a.x, b.y - a.y);
      const double least = std::min(tolerance * rectangle.length, width);
      for (const PatchCutEnd& end : cut) {
        if (end.to < 0) continue;
        ++kept;
        for (const int vertex : {end.from, end.to}) {
          const Vec2d way = PlaceOf(border, end) - border[size_t(vertex)].position;
          EXPECT_GE(std::hypot(way.x, way.y), least * (1 - 1e-9));  // Roundings of doubles.
        }
      }
    }
  }
  EXPECT_GT(kept, 1000);
}

TEST(PatchSplitting, MiddlesOfSidesAreTVerticesWhereThoseLieThere) {
  const Border border = {{{1, 0}, false}, {{2, 0}}, {{1, 1}}, {{0.5, 0.5}, false}, {{0, 0}}};
  EXPECT_TRUE(IsTriangle(border));
  const auto middles = SideMiddles(border);
  EXPECT_EQ(PlaceOf(border, middles[0]), Vec2d(1.5, 0.5));
  EXPECT_EQ(middles[0].from, 1);
  EXPECT_EQ(middles[0].to, 2);
  for (size_t side = 1; side < 3; ++side) {
    EXPECT_EQ(middles[side].from, side == 1 ? 3 : 0);
    EXPECT_EQ(middles[side].to, -1);
  }
  EXPECT_FALSE(IsTriangle({{{0, 0}}, {{1, 0}}, {{1, 1}}, {{0, 1}}}));
}

TEST(PatchSplitting, ThinPatchIsNotCutAslant) {
  // The lower vertex draws one end left, the upper one the other end right: by ten widths.
  const Border border = {{{0, 0}},   {{45, 0}, false}, {{100, 0}},
                         {{100, 1}}, {{56, 1}, false}, {{0, 1}}};
  const auto cut = CutPatch(border, 0.15);
  EXPECT_DOUBLE_EQ(PlaceOf(border, cut[0]).x, 45);
  EXPECT_DOUBLE_EQ(PlaceOf(border, cut[1]).x, 45);
}

TEST(PatchSplitting, FlatTriangleHasAHeight) {
  const Vec3d a(0, 0, 0), b(2, 0, 0);
  for (const Vec3d& c : {Vec3d(1, 0, 0), Vec3d(0, 0, 0), Vec3d(3, 0, 0)}) {
    const auto flat = FlattenTriangle(a, b, c);
    EXPECT_GT(Area(flat[0], flat[1], flat[2]), 0);
  }
  const auto flat = FlattenTriangle(a, a, a);
  EXPECT_GT(Area(flat[0], flat[1], flat[2]), 0);
}

TEST(PatchSplitting, ALineCutsTheBorderWhereItCrossesIt) {
  const Border square = {{{0, 0}}, {{2, 0}}, {{2, 1}}, {{1, 1}, false}, {{0, 1}}};
  const auto across = CutPatchAlong(square, {0.5, 0.2}, {0.5, 0.3});
  ASSERT_TRUE(across);
  for (const PatchCutEnd& end : *across) EXPECT_NEAR(PlaceOf(square, end).x, 0.5, 1e-12);
  EXPECT_NEAR(std::abs(PlaceOf(square, (*across)[0]).y - PlaceOf(square, (*across)[1]).y), 1,
              1e-12);

  // Through a vertex, and as near to one as makes no difference.
  for (const double x : {1., 1.0001}) {
    const auto through = CutPatchAlong(square, {x, -1}, {x, 3});
    ASSERT_TRUE(through);
    const auto isVertex = [](const PatchCutEnd& end) { return end.to < 0 && end.from == 3; };
    EXPECT_EQ(std::count_if(through->begin(), through->end(), isVertex), 1);
  }

  // Past it, along a side, through a corner alone, and no line at all.
  EXPECT_FALSE(CutPatchAlong(square, {3, 0}, {3, 1}));
  EXPECT_FALSE(CutPatchAlong(square, {0, 0}, {2, 0}));
  EXPECT_FALSE(CutPatchAlong(square, {-1, 1}, {1, -1}));
  EXPECT_FALSE(CutPatchAlong(square, {0.5, 0.5}, {0.5, 0.5}));
}

TEST(PatchSplitting, RandomLinesPartTheBorder) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-0.2, 1.2);
  int cuts = 0;
  for (int i = 0; i < 2000; ++i) {
    const Border border = RandomBorder(&random, 0.01 + 0.5 * std::abs(unit(random)), 4);
    const Vec2d a(unit(random), 0.5 * unit(random)), b(unit(random), 0.5 * unit(random));
    const auto ends = CutPatchAlong(border, a, b);
    if (!ends) continue;
    ++cuts;
    // Both ends on the line, to the thousandth of the border within which vertices count as on it.
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    for (const PatchCutEnd& end : *ends) {
      EXPECT_LT(std::abs(Area(a, b, PlaceOf(border, end))) * 2 / length, 2.1e-3);
    }
    EXPECT_GT(std::hypot(PlaceOf(border, (*ends)[0]).x - PlaceOf(border, (*ends)[1]).x,
                         PlaceOf(border, (*ends)[0]).y - PlaceOf(border, (*ends)[1]).y),
              0);
  }
  EXPECT_GT(cuts, 500);
}

TEST(PatchTriangulation, TrianglesCoverThePatchAndUseItsWholeBorder) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 2000; ++trial) {
    const Border border = RandomBorder(&random, trial % 2 == 0 ? 0.6 : 1e-4, 5);
    const auto triangles = TriangulatePatch(border);
    ASSERT_EQ(triangles.size(), border.size() - 2);
    double sum = 0;
    std::set<std::pair<int32_t, int32_t>> edges;
    for (const auto& t : triangles) {
      const double area = Area(border[size_t(t[0])].position, border[size_t(t[1])].position,
                               border[size_t(t[2])].position);
      // A triangle within a side would have an area of roundings, 1e-16.
      EXPECT_GT(area, 1e-15);
      sum += area;
      for (size_t i = 0; i < 3; ++i) edges.insert({t[i], t[(i + 1) % 3]});
    }
    EXPECT_NEAR(sum, Area(border), 1e-12);
    for (size_t i = 0; i < border.size(); ++i) {
      EXPECT_TRUE(edges.count({int32_t(i), int32_t((i + 1) % border.size())}));
    }
  }
}

TEST(PatchTriangulation, QuadrilateralTakesTheDelaunayDiagonal) {
  const Border wide = {{{0, 0}}, {{2, -0.5}}, {{4, 0}}, {{2, 0.5}}};
  for (const auto& t : TriangulatePatch(wide)) {
    EXPECT_EQ(std::count(t.begin(), t.end(), 1), 1);
    EXPECT_EQ(std::count(t.begin(), t.end(), 3), 1);
  }
  // The diagonal from a t-vertex, though the other one is shorter.
  const Border straight = {{{0, 0}}, {{1, 0}, false}, {{4, 0}}, {{0, 0.5}}};
  for (const auto& t : TriangulatePatch(straight)) EXPECT_EQ(std::count(t.begin(), t.end(), 1), 1);
}

TEST(PatchTriangulation, FoldedBorderStillGivesAllTriangles) {
  // A t-vertex far off its side: the border crosses itself, which constrained Delaunay cannot have.
  const Border border = {{{0, 0}}, {{1, 0}}, {{1, 1}}, {{0.5, -1}, false}, {{0, 1}}};
  const auto triangles = TriangulatePatch(border);
  EXPECT_EQ(triangles.size(), 3u);
  for (const auto& t : triangles) EXPECT_EQ(std::set<int32_t>(t.begin(), t.end()).size(), 3u);
}

}  // namespace
}  // namespace lambert
