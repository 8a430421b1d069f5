// The leaf mesh: after output no vertex lies inside another triangle's edge, whatever was split.
#include "Radiosity/Core/LeafMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <tuple>

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "LeafMeshChecks.h"

namespace lambert {
namespace {

using namespace testing;

TEST(LeafMesh, UnsplitFacesComeOutAsTheyWentIn) {
  const TriangleMesh mesh = Grid(4, true, 1);
  LeafMesh leaves(mesh);
  const int32_t patch = leaves.FacePatch(3, kBack);
  EXPECT_EQ(leaves.FacePatch(3, kBack), patch);
  std::vector<uint8_t> lit(size_t(mesh.FaceCount()), 1);
  lit[3] = 2;
  lit[4] = 0;
  const auto triangles = leaves.Triangulate(lit);
  ASSERT_EQ(int64_t(triangles.size()), mesh.FaceCount() - 1);
  EXPECT_EQ(triangles[3].side, kBack);
  EXPECT_EQ(triangles[3].patch, patch);
  EXPECT_EQ(triangles[3].vertices, mesh.triangles[3]);
  EXPECT_EQ(triangles[4].face, 5);
  EXPECT_EQ(triangles[4].patch, -1);
  EXPECT_TRUE(leaves.Vertices().empty());
  EXPECT_THROW(leaves.Triangulate({}), Error);
}

TEST(LeafMesh, RightTriangleIsCutThroughItsApex) {
  const TriangleMesh mesh = MakeMesh({{0, 0, 0}, {2, 0, 0}, {1, 1, 0}}, {{0, 1, 2}});
  LeafMesh leaves(mesh);
  const auto halves = leaves.Split(leaves.FacePatch(0, kFront));
  EXPECT_EQ(leaves.PatchCount(), 3);
  for (const int32_t half : halves) {
    EXPECT_EQ(leaves.Corners(half).size(), 3u);
    EXPECT_DOUBLE_EQ(PolygonArea(leaves.Corners(half)), 0.5);
    EXPECT_EQ(leaves.PatchFace(half), 0);
  }
  EXPECT_EQ(leaves.Split(0), halves);  // Of a split patch they are the same again.
  EXPECT_EQ(leaves.Parts(0), halves);
  EXPECT_TRUE(leaves.Parts(halves[0]).empty());
  ASSERT_EQ(leaves.Vertices().size(), 1u);
  EXPECT_EQ(leaves.Vertices()[0].position, Vec3f(1, 0, 0));
}

TEST(LeafMesh, NoVertexLiesInsideAnEdge) {
  for (uint32_t seed = 1; seed <= 6; ++seed) {
    for (const TriangleMesh& mesh : {Grid(4, false, seed), Grid(4, true, seed), Fan(3), Fan(5)}) {
      LeafMesh leaves(mesh);
      SplitAtRandom(mesh, 90, 0.05f, seed, &leaves);
      ExpectSoundOutput(mesh, Output(mesh, &leaves));
    }
  }
}

TEST(LeafMesh, SliversStayWatertight) {
  for (uint32_t seed = 1; seed <= 4; ++seed) {
    const TriangleMesh mesh = Slivers(5);
    LeafMesh leaves(mesh);
    SplitAtRandom(mesh, 120, 0.002f, seed, &leaves);
    ExpectSoundOutput(mesh, Output(mesh, &leaves));
  }
}

TEST(LeafMesh, RefiningOnBetweenOutputsKeepsItSound) {
  const TriangleMesh mesh = Grid(4, true, 9);
  LeafMesh stepwise(mesh), atOnce(mesh);
  std::mt19937 random(5);
  std::vector<int32_t> splits;
  std::vector<int32_t> open = {stepwise.FacePatch(14, kFront), stepwise.FacePatch(15, kFront)};
  for (int i = 0; i < 60; ++i) {
    const size_t pick = random() % open.size();
    splits.push_back(open[pick]);
    const auto halves = stepwise.Split(open[pick]);
    open[pick] = halves[0];
    open.push_back(halves[1]);
    if (i % 7 == 0) ExpectSoundOutput(mesh, Output(mesh, &stepwise));
  }
  atOnce.FacePatch(14, kFront);
  atOnce.FacePatch(15, kFront);
  for (const int32_t patch : splits) atOnce.Split(patch);
  const Output a(mesh, &stepwise), b(mesh, &atOnce);
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  for (size_t i = 0; i < a.triangles.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      EXPECT_EQ(a.Corner(a.triangles[i], corner), b.Corner(b.triangles[i], corner));
    }
  }
}

TEST(LeafMesh, AStripIsCutOutAlongTwoLines) {
  // From a quarter of the longest side to a half of the left one, three hundredths wide.
  const TriangleMesh mesh = MakeMesh({{0, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  LeafMesh leaves(mesh);
  const int32_t whole = leaves.FacePatch(0, kFront);
  const LeafLine first = {LeafBorderPlace{1, 2, 0.25}, LeafBorderPlace{2, 0, 0.5}};
  const LeafLine second = {LeafBorderPlace{1, 2, 0.28}, LeafBorderPlace{2, 0, 0.47}};
  const std::vector<int32_t> parts = leaves.SplitAlong(whole, {first, second});
  ASSERT_EQ(parts.size(), 3u);
  std::vector<double> areas;
  for (const int32_t part : parts) areas.push_back(PolygonArea(leaves.Corners(part)));
  std::sort(areas.begin(), areas.end());
  // Above the lines are triangles with the apex (0, 1): shares of its two sides, of an area of 1.
  EXPECT_NEAR(areas[0], 0.75 * 0.5 - 0.72 * 0.47, 1e-6);
  EXPECT_NEAR(areas[1], 0.72 * 0.47, 1e-6);
  EXPECT_NEAR(areas[2], 1 - 0.75 * 0.5, 1e-6);
  ExpectSoundOutput(mesh, Output(mesh, &leaves));
  EXPECT_THROW(leaves.SplitAlong(whole, {first, second}), Error);
  const LeafLine foreign = {LeafBorderPlace{7, 2, 0.25}, LeafBorderPlace{2, 0, 0.5}};
  EXPECT_THROW(leaves.SplitAlong(parts[0], {foreign, foreign}), Error);
}

TEST(LeafMesh, LinesThatOnlyTouchLeaveHalves) {
  const TriangleMesh mesh = MakeMesh({{0, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  LeafMesh leaves(mesh);
  const LeafLine side = {LeafBorderPlace{0, 1, 0}, LeafBorderPlace{0, 1, 1}};
  const int32_t whole = leaves.FacePatch(0, kFront);
  EXPECT_EQ(leaves.SplitAlong(whole, {side, side}).size(), 2u);
  ExpectSoundOutput(mesh, Output(mesh, &leaves));
}

TEST(LeafMesh, RandomStripsKeepItWatertight) {
  for (uint32_t seed = 1; seed <= 6; ++seed) {
    const TriangleMesh mesh = Grid(3, seed % 2 == 0, seed);
    LeafMesh leaves(mesh);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<int32_t> open;
    for (int32_t face = 0; face < mesh.FaceCount(); face += 2) {
      const int32_t patch = leaves.FacePatch(face, random() % 2 ? kFront : kBack);
      const auto& p = mesh.triangles[size_t(face)];
      const size_t corner = random() % 3, next = (corner + 1) % 3, last = (corner + 2) % 3;
      const double a = unit(random), b = unit(random);
      const double c = a + 0.1 * unit(random) * (1 - a), d = b * (1 - 0.1 * unit(random));
      const LeafLine first = {LeafBorderPlace{p[corner], p[next], a},
                              LeafBorderPlace{p[next], p[last], b}};
      const LeafLine second = {LeafBorderPlace{p[corner], p[next], c},
                               LeafBorderPlace{p[next], p[last], d}};
      for (const int32_t part : leaves.SplitAlong(patch, {first, second})) open.push_back(part);
    }
    ExpectSoundOutput(mesh, Output(mesh, &leaves));
    // Halves and strips mixed.
    for (int i = 0; i < 20; ++i) {
      const size_t pick = random() % open.size();
      if (LongestEdge(leaves.Corners(open[pick])) < 0.1f) continue;
      const auto halves = leaves.Split(open[pick]);
      open[pick] = halves[0];
      open.push_back(halves[1]);
    }
    ExpectSoundOutput(mesh, Output(mesh, &leaves));
  }
}

LeafMeshOptions Regular() {
  LeafMeshOptions options;
  options.refinement = PatchRefinement::Quadtree;
  return options;
}

TEST(LeafMesh, RegularRefinementMakesFourOfTheSameShape) {
  const TriangleMesh mesh = MakeMesh({{0, 0, 0}, {4, 0, 0}, {1, 2, 0}}, {{0, 1, 2}});
  LeafMesh leaves(mesh, Regular());
  std::vector<int32_t> parts = leaves.Split(leaves.FacePatch(0, kFront));
  ASSERT_EQ(parts.size(), 4u);
  for (const int32_t part : leaves.Split(parts[0])) parts.push_back(part);
  EXPECT_EQ(leaves.Split(0), leaves.Parts(0));  // Of a split patch they are the same again.
  for (size_t i = 0; i < parts.size(); ++i) {
    const std::vector<Vec3f>& corners = leaves.Corners(parts[i]);
    ASSERT_EQ(corners.size(), 3u);
    EXPECT_FLOAT_EQ(float(PolygonArea(corners)), i < 4 ? 1.f : 0.25f);
    EXPECT_FLOAT_EQ(LongestEdge(corners), i < 4 ? 2.f : 1.f);
  }
  EXPECT_EQ(leaves.Vertices().size(), 6u);
  ExpectSoundOutput(mesh, Output(mesh, &leaves));
}

TEST(LeafMesh, RegularRefinementStaysWatertight) {
  for (uint32_t seed = 1; seed <= 4; ++seed) {
    for (const TriangleMesh& mesh : {Grid(4, true, seed), Fan(5), Slivers(5)}) {
      LeafMesh leaves(mesh, Regular());
      SplitAtRandom(mesh, 50, 0.05f, seed, &leaves);
      ExpectSoundOutput(mesh, Output(mesh, &leaves));
    }
  }
}

TEST(LeafMesh, RegularRefinementHalvesWhatALineHasLeft) {
  // A strip across two sides leaves a quadrilateral, which has no four parts of its shape.
  const TriangleMesh mesh = MakeMesh({{0, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  LeafMesh leaves(mesh, Regular());
  const LeafLine first = {LeafBorderPlace{1, 2, 0.25}, LeafBorderPlace{2, 0, 0.5}};
  const LeafLine second = {LeafBorderPlace{1, 2, 0.28}, LeafBorderPlace{2, 0, 0.47}};
  for (const int32_t part : leaves.SplitAlong(leaves.FacePatch(0, kFront), {first, second})) {
    const bool isTriangle = leaves.Corners(part).size() == 3;
    EXPECT_EQ(leaves.Split(part).size(), isTriangle ? 4u : 2u);
  }
  ExpectSoundOutput(mesh, Output(mesh, &leaves));
}

// Triangles that the edge of a shadow at 45 degrees to 50 slivers, 50 : 1, asks for, where patches
// are split until those it crosses have no more than `area` together; the floor is 2 x 1.
int64_t TrianglesAlongAShadow(const LeafMeshOptions& options, double area) {
  std::vector<Vec3f> positions;
  std::vector<std::array<int32_t, 3>> triangles;
  for (int i = 0; i <= 25; ++i) {
    for (const float x : {0.f, 2.f}) positions.push_back({x, 0.04f * float(i), 0});
  }
  for (int32_t i = 0; i < 50; i += 2) {
    triangles.push_back({i, i + 1, i + 3});
    triangles.push_back({i, i + 3, i + 2});
  }
  const TriangleMesh mesh = MakeMesh(positions, triangles);
  LeafMesh leaves(mesh, options);
  const auto isCrossed = [&](int32_t patch) {
    int before = 0, behind = 0;
    for (const Vec3f& p : leaves.Corners(patch)) ++(p.x - p.y < 0.5f ? before : behind);
    return before > 0 && behind > 0;
  };

  // The largest first.
  std::set<std::pair<double, int32_t>> crossed;
  double left = 0;
  const auto add = [&](int32_t patch) {
    if (!isCrossed(patch)) return;
    const double own = PolygonArea(leaves.Corners(patch));
    crossed.insert({own, patch});
    left += own;
  };
  for (int32_t face = 0; face < 50; ++face) add(leaves.FacePatch(face, kFront));
  while (left > area) {
    const auto [own, patch] = *crossed.rbegin();
    crossed.erase({own, patch});
    left -= own;
    for (const int32_t part : leaves.Split(patch)) add(part);
  }
  return int64_t(leaves.Triangulate(std::vector<uint8_t>(50, 1)).size());
}

TEST(LeafMesh, AShadowAcrossSliversTakesAThirdOfTheTriangles) {
  // A tenth, a fortieth of the floor.
  for (const double area : {0.2, 0.05}) {
    EXPECT_LT(3 * TrianglesAlongAShadow({}, area), TrianglesAlongAShadow(Regular(), area));
  }
}

TEST(LeafMesh, VerticesAreSharedWhereInputPointsAre) {
  // Faces 0 and 1 share points; face 2 lies on the same edge with points of its own.
  const TriangleMesh mesh =
      MakeMesh({{0, 0, 0}, {0, 2, 0}, {-1, 1, 0}, {1, 1, 0}, {0, 0, 0}, {0, 2, 0}, {0, 1, 1}},
               {{0, 1, 2}, {1, 0, 3}, {4, 5, 6}});
  LeafMesh leaves(mesh);
  leaves.Split(leaves.FacePatch(0, kFront));
  const Output output(mesh, &leaves);
  std::map<int32_t, std::set<int32_t>> added;
  for (const LeafTriangle& t : output.triangles) {
    for (const int32_t v : t.vertices) {
      if (v >= int32_t(mesh.PointCount())) added[t.face].insert(v);
    }
  }
  ASSERT_EQ(added[0].size(), 1u);
  EXPECT_EQ(added[0], added[1]);
  ASSERT_EQ(added[2].size(), 1u);
  EXPECT_NE(added[0], added[2]);
  EXPECT_EQ(output.Position(*added[0].begin()), output.Position(*added[2].begin()));
}

TEST(LeafMesh, VerticesInterpolateTheirPoints) {
  const TriangleMesh mesh = Grid(3, true, 4);
  LeafMesh leaves(mesh);
  SplitAtRandom(mesh, 80, 0.05f, 3, &leaves);
  const Output output(mesh, &leaves);
  ASSERT_FALSE(output.vertices.empty());
  for (const LeafVertex& vertex : output.vertices) {
    Vec3f sum;
    for (int i = 0; i < 3; ++i)
      sum += mesh.positions[size_t(vertex.points[size_t(i)])] * vertex.weights[i];
    // Float rounding of three weights and coordinates up to four.
    EXPECT_LT(Length(sum - vertex.position), 2e-6f);
    EXPECT_NEAR(vertex.weights.x + vertex.weights.y + vertex.weights.z, 1, 1e-6);
  }
}

TEST(LeafMesh, SplittingHalvesTheArea) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> coordinate(0, 1);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Vec3f> corners(3);
    for (Vec3f& p : corners) p = {coordinate(random), coordinate(random), coordinate(random)};
    const TriangleMesh mesh = MakeMesh(corners, {{0, 1, 2}});
    LeafMesh leaves(mesh);
    const auto halves = leaves.Split(leaves.FacePatch(0, kFront));
    const double first = PolygonArea(leaves.Corners(halves[0]));
    const double second = PolygonArea(leaves.Corners(halves[1]));
    // The cut stays between 0.35 and 0.65 of the length, where a wedge has at least an eighth of
    // its area.
    EXPECT_NEAR(first + second, mesh.Area(0), 1e-5 * mesh.Area(0) + 1e-7);
    EXPECT_GT(std::min(first, second), 0.12 * mesh.Area(0));
  }
}

TEST(LeafMesh, SliverEndsInWellShapedPatches) {
  // Right-angled, isosceles and obtuse, 1000 : 1.
  for (const float foot : {0.f, 0.0005f, 0.5f}) {
    const TriangleMesh mesh =
        MakeMesh({{0, 0, 0}, {1, 0, 0}, {foot == 0.0005f ? 0 : foot, 0.001f, 0}}, {{0, 1, 2}});
    LeafMesh leaves(mesh);
    std::vector<int32_t> open = {leaves.FacePatch(0, kFront)};
    double badArea = 0;
    while (!open.empty()) {
      const int32_t patch = open.back();
      open.pop_back();
      const std::vector<Vec3f> corners = leaves.Corners(patch);
      float low = 1, high = 0, bottom = 1, top = 0;
      for (const Vec3f& p : corners) {
        low = std::min(low, p.x), high = std::max(high, p.x);
        bottom = std::min(bottom, p.y), top = std::max(top, p.y);
      }
      if (high - low < 4 * (top - bottom)) continue;
      // What is left at a tip of the sliver is as sharp as the tip.
      if (high - low < 0.0001f) {
        badArea += PolygonArea(corners);
        continue;
      }
      const auto halves = leaves.Split(patch);
      open.insert(open.end(), halves.begin(), halves.end());
    }
    // A tip is sharper than 1 : 4 for pieces of 1e-4 over its first 0.025, 6e-4 of a wedge with one
    // tip them.
    EXPECT_LT(badArea, 1e-3 * mesh.Area(0));
  }
}

TEST(LeafMesh, DegenerateFacesAreSplitWithoutHarm) {
  const std::vector<std::vector<Vec3f>> degenerate = {
      {{0, 0, 0}, {1, 0, 0}, {0.5f, 0, 0}},
      {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}},
      {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}},
      {{0, 0, 0}, {1, 0, 0}, {0.3f, 1e-12f, 0}},
      {{100, 100, 100}, {100, 100.00001f, 100}, {-100, 100, 100}}};
  for (const auto& corners : degenerate) {
    const TriangleMesh mesh = MakeMesh(corners, {{0, 1, 2}});
    LeafMesh leaves(mesh);
    std::vector<int32_t> open = {leaves.FacePatch(0, kFront)};
    for (size_t i = 0; i < 60; ++i) {
      const auto halves = leaves.Split(open[i]);
      open.insert(open.end(), halves.begin(), halves.end());
    }
    for (const LeafTriangle& t : Output(mesh, &leaves).triangles) {
      for (const int32_t v : t.vertices) EXPECT_LT(v, 3 + int32_t(leaves.Vertices().size()));
    }
    for (const LeafVertex& vertex : leaves.Vertices()) {
      EXPECT_TRUE(IsFinite(vertex.position));
      EXPECT_TRUE(IsFinite(vertex.weights));
    }
  }
}

TEST(LeafMesh, SplittingEndsInAnErrorBelowTheRoundingOfDoubles) {
  for (uint32_t seed = 0; seed < 20; ++seed) {
    const TriangleMesh mesh = seed % 2 ? Slivers(1) : Grid(1, false, seed);
    LeafMesh leaves(mesh);
    std::mt19937 random(seed);
    int32_t patch = leaves.FacePatch(0, kFront);
    int splits = 0;
    const auto splitForever = [&] {
      for (; splits < 1000; ++splits) patch = leaves.Split(patch)[random() % 2];
    };
    EXPECT_THROW(splitForever(), Error);
    // Each dimension is halved some 33 times before 1e-10; a cut takes between 0.35 and 0.65.
    EXPECT_GT(splits, 30);
    EXPECT_LT(splits, 200);
    for (const LeafVertex& vertex : leaves.Vertices()) EXPECT_TRUE(IsFinite(vertex.position));
    EXPECT_FALSE(Output(mesh, &leaves).triangles.empty());
  }
}

TEST(LeafMesh, SameTrianglesForAnyNumberOfThreads) {
  const TriangleMesh mesh = Grid(8, true, 21);
  std::vector<std::vector<LeafTriangle>> results;
  for (const int threads : {1, 2, 7}) {
    SetThreadCount(threads);
    LeafMesh leaves(mesh);
    SplitAtRandom(mesh, 500, 0.01f, 8, &leaves);
    results.push_back(Output(mesh, &leaves).triangles);
  }
  SetThreadCount(0);
  for (const auto& result : results) {
    ASSERT_EQ(result.size(), results[0].size());
    for (size_t i = 0; i < result.size(); ++i)
      EXPECT_EQ(result[i].vertices, results[0][i].vertices);
  }
}

}  // namespace
}  // namespace lambert
