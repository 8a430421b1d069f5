#include "Atlas/Core/ChartStraightening.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "Atlas/Core/ChartSegmentation.h"
#include "Atlas/Testing/Unit/AtlasMeshes.h"
#include "Clustering/Core/ClusterFrame.h"
#include "Common/Core/Random.h"

namespace lambert {
namespace {

using Pairs = std::vector<std::array<int32_t, 2>>;

/// An L of unit squares, two triangles each: four along one arm, three along the other. Turned.
std::vector<std::array<Vec2d, 3>> AnL() {
  const double c = std::cos(0.3), s = std::sin(0.3);
  const auto place = [&](double x, double y) { return Vec2d(c * x - s * y, s * x + c * y); };
  std::vector<std::array<Vec2d, 3>> faces;
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {2, 0}, {3, 0}, {0, 1}, {0, 2}}) {
    faces.push_back({place(x, y), place(x + 1, y), place(x + 1, y + 1)});
    faces.push_back({place(x, y), place(x + 1, y + 1), place(x, y + 1)});
  }
  return faces;
}

TEST(ChartStraightening, AnLIsCutWhereItBends) {
  const StraightCut cut = BestStraightCut(AnL());
  ASSERT_EQ(cut.side.size(), 12u);
  // Lines are tried every 11 degrees; along the nearest the rectangles are a little larger.
  EXPECT_NEAR(cut.rectangles, 6, 2);
  const std::vector<uint8_t> along = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1};
  const std::vector<uint8_t> other = {0, 0, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0};
  const auto isAs = [&](const std::vector<uint8_t>& sides) {
    bool same = true, opposite = true;
    for (size_t i = 0; i < sides.size(); ++i) {
      same = same && cut.side[i] == sides[i];
      opposite = opposite && cut.side[i] != sides[i];
    }
    return same || opposite;
  };
  EXPECT_TRUE(isAs(along) || isAs(other));
  EXPECT_TRUE(BestStraightCut({}).side.empty());
  EXPECT_TRUE(BestStraightCut({AnL()[0]}).side.empty());
}

// Of thousands of faces most cuts are not looked at one by one.
TEST(ChartStraightening, NoCutBetweenTwoFacesIsBetter) {
  Random random(3);
  std::vector<std::array<Vec2d, 3>> faces;
  for (int i = 0; i < 500; ++i) {
    const Vec2d p(2 * random.UniformDouble(), random.UniformDouble());
    faces.push_back({p, p + Vec2d(0.01, 0), p + Vec2d(0, 0.02)});
  }
  const StraightCut cut = BestStraightCut(faces);

  // The rectangles of all faces before each, and from each on, along either axis.
  const auto area = [&](const std::vector<std::array<Vec2d, 3>>& part) {
    Vec2d low = part[0][0], high = low;
    for (const auto& face : part) {
      for (const Vec2d& p : face) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
      }
    }
    return (high.x - low.x) * (high.y - low.y);
  };
  for (const bool isAcross : {false, true}) {
    std::sort(faces.begin(), faces.end(), [&](const auto& a, const auto& b) {
      return isAcross ? a[0].x < b[0].x : a[0].y < b[0].y;
    });
    for (auto middle = faces.begin() + 25; middle <= faces.end() - 25; ++middle) {
      EXPECT_GE(area({faces.begin(), middle}) + area({middle, faces.end()}),
                cut.rectangles * (1 - 1e-12));
    }
  }

  // Asked for better ones there are none.
  EXPECT_TRUE(BestStraightCut(faces, cut.rectangles).side.empty());
  EXPECT_FALSE(BestStraightCut(faces, cut.rectangles * 1.001).side.empty());
}

TEST(ChartStraightening, TeethAndIslandsGoOver) {
  // A strip of eight faces.
  std::vector<int32_t> neighbours(24, -1);
  for (int32_t face = 0; face < 8; ++face) {
    if (face > 0) neighbours[size_t(3 * face)] = face - 1;
    if (face < 7) neighbours[size_t(3 * face + 1)] = face + 1;
  }
  std::vector<uint8_t> side = {0, 0, 0, 1, 0, 1, 1, 1};
  RemoveTeeth(neighbours, &side);
  EXPECT_EQ(side, std::vector<uint8_t>({0, 0, 0, 1, 1, 1, 1, 1}));
  side = {1, 1, 0, 0, 0, 0, 1, 1};
  KeepLargestPieces(neighbours, &side);
  EXPECT_EQ(side, std::vector<uint8_t>({1, 1, 0, 0, 0, 0, 0, 0}));
}

TEST(ChartStraightening, PairsAreOfferedUntilNoneChanges) {
  const std::vector<double> empty = {3, 1, 2, 5};
  std::vector<Pairs> offered;
  StraightenedCharts charts;
  charts.borders = [] {
    return std::vector<ChartBorder>{{0, 1, 1}, {0, 2, 1}, {1, 3, 1}, {2, 3, 1}};
  };
  charts.empty = [&](int32_t chart) { return empty[size_t(chart)]; };
  charts.tryToCut = [&](const Pairs& pairs) {
    offered.push_back(pairs);
    return std::vector<uint8_t>(pairs.size(), offered.size() == 1);
  };
  StraightenBorders(charts);
  // Each pair once as it is: those that changed first are offered no more, nor are the others.
  const std::vector<Pairs> expected = {{{2, 3}, {0, 1}}, {{1, 3}, {0, 2}}};
  EXPECT_EQ(offered, expected);
}

/// The area of all charts over that of their smallest rectangles.
double FillOfRectangles(const ChartSet& set) {
  double area = 0, rectangles = 0;
  for (const Chart& chart : set.charts) {
    std::vector<Vec2f> points;
    for (const int32_t face : set.FacesOf(chart)) {
      const auto& p = set.places[size_t(face)];
      const Vec2f u = p[1] - p[0], v = p[2] - p[0];
      area += 0.5 * std::abs(double(u.x) * double(v.y) - double(u.y) * double(v.x));
      points.insert(points.end(), p.begin(), p.end());
    }
    const Vec2f half = MinimumAreaRectangle(points).halfExtent;
    rectangles += 4 * double(half.x) * double(half.y);
  }
  return area / rectangles;
}

// An L of arms one wide, three and two long, in its square of three, for two rectangles.

// Cut along their clusters alone, charts of a torus fill 0.59 of their rectangles.
TEST(ChartStraightening, ChartsOfATubeFillTheirRectangles) {
  const Clustered torus(Torus(160, 60));
  const ChartSet set = CutIntoCharts(torus.mesh, torus.tree);
  EXPECT_GT(FillOfRectangles(set), 0.65);
  EXPECT_LE(LargestStretch(set), 2.f);
}

}  // namespace
}  // namespace lambert
