#include "Atlas/Core/ChartSegmentation.h"

#include <gtest/gtest.h>

#include "Atlas/Testing/Unit/AtlasMeshes.h"
#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"

namespace lambert {
namespace {

double Cross2(const Vec2f& a, const Vec2f& b, const Vec2f& c) {
  const Vec2d u(b - a), v(c - a);
  return u.x * v.y - u.y * v.x;
}

bool Holds(const std::array<Vec2f, 3>& t, const Vec2f& p) {
  return Cross2(t[0], t[1], p) > 0 && Cross2(t[1], t[2], p) > 0 && Cross2(t[2], t[0], p) > 0;
}

/// Every face lies in one chart; no place of a chart is taken twice, by random places in its faces.
void ExpectValid(const TriangleMesh& mesh, const ChartSet& set) {
  int32_t next = 0;
  Random random(3);
  for (const Chart& chart : set.charts) {
    ASSERT_EQ(chart.first, next);
    next += chart.faceCount;
    for (int sample = 0; sample < 20; ++sample) {
      const int32_t face =
          set.faces[size_t(chart.first) + size_t(random.UniformDouble() * chart.faceCount)];
      const auto& t = set.places[size_t(face)];
      float u = random.Uniform(), v = random.Uniform();
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Vec2f p = t[0] + (t[1] - t[0]) * u + (t[2] - t[0]) * v;
      int taken = 0;
      for (const int32_t f : set.FacesOf(chart)) taken += Holds(set.places[size_t(f)], p);
      EXPECT_LE(taken, 1);
    }
    for (const int32_t f : set.FacesOf(chart)) {
      for (size_t c = 0; c < 3; ++c) {
        EXPECT_GE(set.corners[size_t(f)][c], 0);
        EXPECT_LT(set.corners[size_t(f)][c], chart.cornerCount);
        EXPECT_TRUE(std::isfinite(set.places[size_t(f)][c].x));
      }
    }
  }
  EXPECT_EQ(next, mesh.FaceCount());
  std::vector<int32_t> faces = set.faces;
  std::sort(faces.begin(), faces.end());
  EXPECT_EQ(faces, FacesFrom(0, int32_t(mesh.FaceCount())));
}

TEST(ChartSegmentation, WhatIsFlatIsOneChart) {
  const Clustered grid(FlatGrid(12));
  const ChartSet set = CutIntoCharts(grid.mesh, grid.tree);
  ASSERT_EQ(set.charts.size(), 1u);
  EXPECT_TRUE(set.charts[0].isProjected);
  ExpectValid(grid.mesh, set);
}

TEST(ChartSegmentation, ClosedAndHighGenusSurfacesFallIntoFewCharts) {
  for (const TriangleMesh& mesh : {Sphere(20), Torus(40, 20)}) {
    const Clustered closed(mesh);
    const ChartSet set = CutIntoCharts(closed.mesh, closed.tree);
    EXPECT_GE(set.charts.size(), 2u);
    EXPECT_LE(set.charts.size(), 24u);
    ExpectValid(closed.mesh, set);
  }
}

TEST(ChartSegmentation, LengthsKeepWithinTheStretch) {
  const Clustered sphere(Sphere(24));
  size_t charts = 0;
  for (const double stretch : {2., 1.3, 1.1}) {
    ChartOptions options;
    options.stretch = stretch;
    const ChartSet set = CutIntoCharts(sphere.mesh, sphere.tree, options);
    EXPECT_GE(set.charts.size(), charts);
    charts = set.charts.size();
    for (int64_t face = 0; face < sphere.mesh.FaceCount(); ++face) {
      for (int c = 0; c < 3; ++c) {
        const Vec2f d =
            set.places[size_t(face)][size_t((c + 1) % 3)] - set.places[size_t(face)][size_t(c)];
        const double length =
            double(Length(sphere.mesh.Corner(face, (c + 1) % 3) - sphere.mesh.Corner(face, c)));
        EXPECT_LT(std::hypot(double(d.x), double(d.y)), 1.001 * stretch * length);
        EXPECT_GT(std::hypot(double(d.x), double(d.y)), 0.999 / stretch * length);
      }
    }
  }
}

TEST(ChartSegmentation, HeapsOfTrianglesAreNoHarm) {
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(seed);
    const Clustered soup(Soup(seed, 30, 150));
    ExpectValid(soup.mesh, CutIntoCharts(soup.mesh, soup.tree));
  }
  const Clustered fan(NonManifoldFan(7)), band(MoebiusBand(40, 4)), needles(SliverGrid(20));
  for (const Clustered* c : {&fan, &band, &needles}) {
    ExpectValid(c->mesh, CutIntoCharts(c->mesh, c->tree));
  }
}

TEST(ChartSegmentation, ACrumpledSheetIsValid) {
  const Clustered sheet(GridMesh(40, 40, [](double u, double v) {
    const double bump = 0.04 * std::sin(31 * u) * std::cos(27 * v + 3 * u);
    return Vec3f(float(u), float(v), float(bump));
  }));
  ExpectValid(sheet.mesh, CutIntoCharts(sheet.mesh, sheet.tree));
}

TEST(ChartSegmentation, LongAndEmptyChartsAreCut) {
  const Clustered grid(FlatGrid(12));
  ChartOptions options;
  options.longest = 0.5;
  const ChartSet set = CutIntoCharts(grid.mesh, grid.tree, options);
  EXPECT_GE(set.charts.size(), 4u);
  ExpectValid(grid.mesh, set);
  options.longest = 0.01;  // An edge is longer: no cut helps.
  EXPECT_EQ(CutIntoCharts(grid.mesh, grid.tree, options).charts.size(), 1u);

  const Clustered frame(
      GridMesh(24, 1, [](double u, double v) { return OnTurn(u, 2 - 0.1 * v, 0); }));
  EXPECT_EQ(CutIntoCharts(frame.mesh, frame.tree).charts.size(), 1u);
  ChartOptions full;
  full.mostEmpty = 3;
  EXPECT_GE(CutIntoCharts(frame.mesh, frame.tree, full).charts.size(), 2u);
}

TEST(ChartSegmentation, EmptyChartsAreCutApartWhereThatSavesRoom) {
  // An L whose arms are 1 m wide, 3 m long outside.
  const Clustered bent(GridMesh(24, 4, [](double u, double v) {
    const double t = 2 * u - 1;
    if (t < 0) return Vec3f(float((3 - v) * (1 + t)), float(v), 0);
    return Vec3f(float(3 - v), float(v + (3 - v) * t), 0);
  }));
  EXPECT_EQ(CutIntoCharts(bent.mesh, bent.tree).charts.size(), 1u);
  ChartOptions options;
  options.margin = 0.01;
  const ChartSet set = CutIntoCharts(bent.mesh, bent.tree, options);
  EXPECT_EQ(set.charts.size(), 2u);
  ExpectValid(bent.mesh, set);
  // With so much around them two need more.
  options.margin = 1;
  EXPECT_EQ(CutIntoCharts(bent.mesh, bent.tree, options).charts.size(), 1u);
  options.margin = -1;
  EXPECT_THROW(CutIntoCharts(bent.mesh, bent.tree, options), Error);
}

// What IsOf takes for the same is the same, and it takes some: charts are kept by it.
TEST(ChartSegmentation, KnowsOfOtherOptionsThatCutAlike) {
  const Clustered torus(Torus(60, 30));
  ChartOptions options;
  options.longest = 1;
  const ChartSet set = CutIntoCharts(torus.mesh, torus.tree, options);
  EXPECT_TRUE(set.IsOf(options));
  int alike = 0, others = 0;
  for (const double longest : {0.2, 0.5, 0.9, 0.99, 0.999, 1.001, 1.01, 1.1, 2., 0.}) {
    options.longest = longest;
    const ChartSet again = CutIntoCharts(torus.mesh, torus.tree, options);
    const bool isAlike = set.IsOf(options);
    EXPECT_TRUE(!isAlike || again.places == set.places) << longest;
    ++(isAlike ? alike : others);
  }
  EXPECT_GT(alike, 0);
  EXPECT_GT(others, 0);
  options.longest = 1;
  options.margin = 0.01;
  const ChartSet apart = CutIntoCharts(torus.mesh, torus.tree, options);
  EXPECT_TRUE(apart.IsOf(options));
  EXPECT_FALSE(apart.IsOf(set.options));
  EXPECT_FALSE(set.IsOf(apart.options));
  for (const double margin : {0., 0.0099, 0.0101, 0.02, 0.05, 0.1, 0.2, 0.5, 1.}) {
    options.margin = margin;
    const ChartSet again = CutIntoCharts(torus.mesh, torus.tree, options);
    const bool isAlike = apart.IsOf(options);
    EXPECT_TRUE(!isAlike || again.places == apart.places) << margin;
    ++(isAlike ? alike : others);
  }
  EXPECT_GT(alike, 1);
  options = set.options;
  options.stretch = 3;
  EXPECT_FALSE(set.IsOf(options));
  EXPECT_FALSE(ChartSet().IsOf({}));
}

TEST(ChartSegmentation, TwoThreadsCutAsOne) {
  const Clustered torus(Torus(60, 30));
  SetThreadCount(1);
  const ChartSet one = CutIntoCharts(torus.mesh, torus.tree);
  SetThreadCount(2);
  const ChartSet two = CutIntoCharts(torus.mesh, torus.tree);
  SetThreadCount(0);
  EXPECT_EQ(one.charts.size(), two.charts.size());
  EXPECT_EQ(one.places, two.places);
}

TEST(ChartSegmentation, OptionsOutOfRangeAndCancelling) {
  const Clustered grid(FlatGrid(2));
  ChartOptions options;
  options.stretch = 0.5;
  EXPECT_THROW(CutIntoCharts(grid.mesh, grid.tree, options), Error);
  options = {};
  options.longest = -1;
  EXPECT_THROW(CutIntoCharts(grid.mesh, grid.tree, options), Error);
  const auto cancel = [](double, const char*) { return false; };
  EXPECT_THROW(CutIntoCharts(grid.mesh, grid.tree, {}, cancel), Cancelled);
}

}  // namespace
}  // namespace lambert
