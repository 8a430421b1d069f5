#include "Atlas/Core/ChartJoining.h"

#include <gtest/gtest.h>

#include "Atlas/Core/LightMap.h"
#include "Atlas/Core/RadiosityAtlas.h"
#include "Atlas/Testing/Unit/AtlasMeshes.h"

namespace lambert {
namespace {

using Pairs = std::vector<std::array<int32_t, 2>>;

/// A thin tube without ends, which the tree halves, above a floor many times as large.
TriangleMesh TubeAboveFloor(int around, int along) {
  TriangleMesh mesh = FlatGrid(4);
  for (Vec3f& p : mesh.positions) p = p * 20.f;
  const int32_t first = int32_t(mesh.positions.size());
  for (int i = 0; i <= along; ++i) {
    for (int j = 0; j < around; ++j) {
      mesh.positions.push_back(OnTurn(double(j) / around, 0.05, double(i) / along) +
                               Vec3f(0, 0, 1));
    }
  }
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < around; ++j) {
      const int32_t a = first + i * around + j, b = first + i * around + (j + 1) % around;
      mesh.triangles.push_back({a, b, b + around});
      mesh.triangles.push_back({a, b + around, a + around});
    }
  }
  TriangleMesh all;
  all.positions = mesh.positions;
  all.triangles = mesh.triangles;
  all.Complete();
  return all;
}

TEST(ChartJoining, TheLongestBordersComeFirst) {
  std::vector<Pairs> offered;
  JoinAlongBorders({{2, 3, 4}, {0, 1, 3}, {1, 2, 5}, {4, 5, 1}, {1, 2, 0.5}},
                   [&](const Pairs& pairs) {
                     offered.push_back(pairs);
                     return std::vector<uint8_t>(pairs.size(), pairs[0][0] == 1);
                   });
  // Where 1 and 2 are one, what met 2 meets 1; what was refused is not offered again.
  const std::vector<Pairs> expected = {{{1, 2}, {4, 5}}, {{1, 3}}, {{0, 1}}};
  EXPECT_EQ(offered, expected);
}

TEST(ChartJoining, CreasesAreNoBorders) {
  TriangleMesh tent;
  tent.positions = {{0, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 0, 1}, {2, 0, 0}, {1, 1, 1}};
  tent.triangles = {{0, 1, 2}, {3, 4, 5}};
  tent.surfaceId = {0, 0};
  EXPECT_TRUE(SmoothBorders(tent, FindNeighbours(tent), {0, 1}).empty());
  tent.triangles[1] = {1, 4, 2};
  const std::vector<ChartBorder> borders = SmoothBorders(tent, FindNeighbours(tent), {1, 0});
  ASSERT_EQ(borders.size(), 1u);
  EXPECT_EQ(borders[0].a, 0);
  EXPECT_EQ(borders[0].b, 1);
  EXPECT_DOUBLE_EQ(borders[0].length, 1);
}

TEST(ChartJoining, TheHalvesOfATubeUnroll) {
  const Clustered scene(TubeAboveFloor(16, 20));
  const ChartSet set = CutIntoCharts(scene.mesh, scene.tree);
  ASSERT_EQ(set.charts.size(), 2u);
  for (const Chart& chart : set.charts) {
    if (chart.faceCount != 16 * 20 * 2) continue;
    EXPECT_EQ(chart.cornerCount, 17 * 21);  // Cut open along one line.
    EXPECT_LT(chart.stretch, 1.01f);
  }
}

TEST(ChartJoining, WhereATubeIsCutOpenIsASeam) {
  const Clustered scene(TubeAboveFloor(16, 20));
  AtlasOptions options;
  options.texelSize = 0.05;
  const RadiosityAtlas atlas = MakeRadiosityAtlas(scene.mesh, scene.tree, options);
  RadiositySolution solution;
  solution.mesh = scene.mesh;
  for (int64_t face = 0; face < scene.mesh.FaceCount(); ++face) {
    solution.inputFaceId.push_back(face);
    solution.side.push_back(kFront);
  }
  for (const Vec3f& p : scene.mesh.positions) solution.irradiance.push_back(Spectrum(2 + p.x));
  const LightMap map = MakeLightMap(scene.mesh, atlas, solution);
  EXPECT_GE(map.seamPoints, 20);
  EXPECT_LE(map.after.rms, map.before.rms);
}

}  // namespace
}  // namespace lambert
