#include "Atlas/Core/LightMapSeams.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lambert {
namespace {

constexpr int kSize = 16;
constexpr double kMean = 0.5;

/// A page of rows of light; a seam along the upper border of what is drawn below row 4, and the
/// lower border of what is drawn from row 10 on, or `height` up instead of 4.
struct Seam {
  LightMap map;
  std::vector<std::vector<uint8_t>> isDrawn;
  std::vector<SeamPoint> points;

  explicit Seam(const std::vector<float>& rows, float height = 4) {
    map.pageSize = kSize;
    map.pages.emplace_back();
    isDrawn.emplace_back();
    for (int row = 0; row < kSize; ++row) {
      for (int column = 0; column < kSize; ++column) {
        map.pages[0].push_back(Spectrum(rows[size_t(row)]));
        isDrawn[0].push_back(row < 4 || row >= 10);
      }
    }
    ForEachPlaceAlong(12, [&](float part, bool isClosed) {
      const float x = (2 + 12 * part) / kSize;
      points.push_back(
          {{0, 0},
           {Footprint(kSize, {x, height / kSize}), Footprint(kSize, {x, 10.f / kSize})},
           {},
           isClosed});
    });
  }
  SeamDifference Closed() {
    CloseSeams(points, kMean, isDrawn, &map);
    return MeasureSeams(points, map, kMean);
  }
  float Row(int row) const { return map.pages[0][size_t(row * kSize + kSize / 2)].r; }
};

TEST(LightMapSeams, AreComparedTwiceAsFinelyAsTheyAreClosed) {
  for (const float length : {0.1f, 0.9f, 12.3f}) {
    std::vector<float> parts, closed;
    ForEachPlaceAlong(length, [&](float part, bool isClosed) {
      parts.push_back(part);
      if (isClosed) closed.push_back(part);
    });
    ASSERT_EQ(parts.size() + 1, 2 * closed.size());
    EXPECT_EQ(closed.front(), 0);
    EXPECT_EQ(closed.back(), 1);
    EXPECT_LE(closed[1] * length, 0.5f);
    EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end()));
  }
}

TEST(LightMapSeams, SmoothLightMeetsWithSmallMoves) {
  Seam seam({1, 1, 1, 1, 1, 1, 1, 1, 1, 1.2f, 1.2f, 1.2f, 1.2f, 1.2f, 1.2f, 1.2f});
  EXPECT_NEAR(MeasureSeams(seam.points, seam.map, kMean).rms, 0.2 / 1.1, 1e-5);
  EXPECT_LT(seam.Closed().largest, 1e-4);
  EXPECT_NEAR(seam.Row(0), 1, 1e-6);
  EXPECT_NEAR(seam.Row(12), 1.2f, 1e-6);
  // What lies around the charts moves, and not what their triangles drew.
  EXPECT_NEAR(seam.Row(3), 1, 0.01);
  EXPECT_NEAR(seam.Row(10), 1.2f, 0.01);
  EXPECT_GT(seam.Row(4), 1.05f);
  EXPECT_LT(seam.Row(9), 1.15f);
}

// Bright light ends at a place that is dark: no texel can be darker than 0, and others make up.
TEST(LightMapSeams, MeetWhereTexelsWouldHaveToBeDarkerThanDark) {
  Seam seam({0.02f, 0.02f, 0.02f, 0.02f, 0.02f, 0.02f, 0.02f, 0.02f, 0.3f, 0.3f, 5, 5, 5, 5, 5, 5});
  EXPECT_GT(MeasureSeams(seam.points, seam.map, kMean).rms, 1.9);
  EXPECT_LT(seam.Closed().largest, 0.02);
  for (const Spectrum& texel : seam.map.pages[0]) {
    EXPECT_GE(std::min({texel.r, texel.g, texel.b}), 0);
    EXPECT_TRUE(texel.IsFinite());
  }
}

// A texel around a chart counts for a tenth here: it alone would have to be nine times as bright.
TEST(LightMapSeams, NoTexelOutshinesWhatIsAround) {
  Seam seam(std::vector<float>(kSize, 1), 3.6f);
  for (SeamPoint& point : seam.points) {
    point.pages[1] = -1;
    point.fixed = Spectrum(1.8f);
  }
  EXPECT_LT(seam.Closed().largest, 0.01);
  for (const Spectrum& texel : seam.map.pages[0]) EXPECT_LE(texel.MaxBand(), 1.25f * 1.8f + 1e-6f);
  EXPECT_GT(seam.Row(3), 1.5f);
}

TEST(LightMapSeams, BringWhatIsFixedBeyondABorder) {
  Seam seam(std::vector<float>(kSize, 2));
  for (SeamPoint& point : seam.points) {
    point.pages[1] = -1;
    point.fixed = Spectrum(1, 2, 3);
  }
  EXPECT_LT(seam.Closed().largest, 1e-3);
  const Spectrum found = seam.points[5].footprints[0].Lookup(seam.map.pages[0]);
  EXPECT_NEAR(found.r, 1, 1e-3);
  EXPECT_NEAR(found.b, 3, 3e-3);
}

}  // namespace
}  // namespace lambert
