#include "Scene/Core/SceneLimits.h"

#include <gtest/gtest.h>

#include "SmallMeshes.h"

namespace lambert::testing {

/// Ten cubes side by side, 2 m each.
static TriangleMesh RowOfCubes() {
  TriangleMesh row;
  for (int i = 0; i < 10; ++i) {
    const TriangleMesh cube = MakeCube(1, {2 * float(i), 0, 0});
    const int32_t first = int32_t(row.positions.size());
    row.positions.insert(row.positions.end(), cube.positions.begin(), cube.positions.end());
    for (const auto& t : cube.triangles) {
      row.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
  }
  return row;
}

// Nothing strays of a row of cubes: what is left out at its ends is a face or two.
TEST(SceneLimits, MostOfARowIsTheRow) {
  const TriangleMesh row = RowOfCubes();
  EXPECT_NEAR(DiagonalOfMost(row), double(row.Bounds().Diagonal()), 2);
}

// One corner far away makes the bounds large and leaves the place of most faces as it is.
TEST(SceneLimits, WhatStraysIsNotOfMost) {
  TriangleMesh row = RowOfCubes();
  const double before = DiagonalOfMost(row);
  row.positions.push_back({0, 1e6f, 0});
  row.triangles.push_back({0, 1, int32_t(row.positions.size()) - 1});
  EXPECT_NEAR(DiagonalOfMost(row), before, 1e-3 * before);
  EXPECT_GT(row.Bounds().Diagonal(), 1e5f);
}

TEST(SceneLimits, AMeshOfNoFaceHasNoExtent) { EXPECT_EQ(DiagonalOfMost(TriangleMesh()), 0); }

TEST(SceneLimits, LightIsSolvableFromNoneToItsBrightest) {
  EXPECT_TRUE(IsSolvable(Spectrum(0)));
  EXPECT_TRUE(IsSolvable(Spectrum(kBrightest)));
  EXPECT_FALSE(IsSolvable({1, -1, 1}));
  EXPECT_FALSE(IsSolvable({1, 1, 2 * kBrightest}));
  EXPECT_FALSE(IsSolvable({std::nanf(""), 1, 1}));
}

}  // namespace lambert::testing
