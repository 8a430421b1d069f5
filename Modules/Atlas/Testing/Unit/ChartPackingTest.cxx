#include "Atlas/Core/ChartPacking.h"

#include <gtest/gtest.h>

#include "Common/Core/Error.h"
#include "Common/Core/Random.h"

namespace lambert {
namespace {

ChartMask Filled(int width, int height) {
  ChartMask mask(width, height);
  for (int x = 0; x < width; ++x) mask.Take(x, 0, height);
  return mask;
}

ChartMask Frame(int width, int height, int border) {
  ChartMask mask(width, height);
  for (int x = 0; x < width; ++x) {
    if (x < border || x >= width - border) mask.Take(x, 0, height);
    mask.Take(x, 0, border);
    mask.Take(x, height - border, height);
  }
  return mask;
}

Packing Pack(const std::vector<ChartMask>& masks, int pageSize, const PackingWay& way = {}) {
  std::vector<TurnedChart> charts;
  for (const ChartMask& mask : masks) charts.push_back(TurnFourWays(mask));
  return PackCharts(charts, pageSize, way);
}

/// Texels that are taken, none of them twice, all on their page.
int64_t Taken(const std::vector<ChartMask>& charts, const Packing& packing, int size) {
  std::vector<int> count(size_t(packing.pages) * size_t(size) * size_t(size), 0);
  int64_t total = 0;
  for (size_t i = 0; i < charts.size(); ++i) {
    const ChartPlace& place = packing.places[i];
    ChartMask mask = charts[i];
    for (int turn = 0; turn < place.turns; ++turn) mask = mask.Turned();
    for (int x = 0; x < mask.Width(); ++x) {
      for (int y = 0; y < mask.Height(); ++y) {
        if (!mask.IsTaken(x, y)) continue;
        EXPECT_TRUE(place.x + x < size && place.y + y < size && place.x >= 0 && place.y >= 0);
        EXPECT_TRUE(place.page >= 0 && place.page < packing.pages);
        const size_t texel =
            (size_t(place.page) * size_t(size) + size_t(place.x + x)) * size_t(size) +
            size_t(place.y + y);
        EXPECT_EQ(count[texel]++, 0);
        ++total;
      }
    }
  }
  return total;
}

TEST(ChartPacking, NoTexelIsTakenTwice) {
  Random random(5);
  std::vector<ChartMask> charts;
  int64_t area = 0;
  for (int i = 0; i < 300; ++i) {
    const int width = 2 + int(random.UniformDouble() * 40),
              height = 2 + int(random.UniformDouble() * 40);
    ChartMask mask(width, height);
    for (int x = 0; x < width; ++x) {
      const int low = int(random.UniformDouble() * height),
                high = low + 1 + int(random.UniformDouble() * (height - low - 1));
      mask.Take(x, low, high);
      area += high - low;
    }
    charts.push_back(mask);
  }
  for (const int window : {1, 7, 1000}) {
    const Packing packing = Pack(charts, 256, {PackingOrder::Longest, window});
    EXPECT_EQ(Taken(charts, packing, 256), area);
    EXPECT_LE(packing.lastHeight, 256);
  }
}

// Whichever come first, nothing lies on anything else; each order has charts that it suits.
TEST(ChartPacking, OrdersDiffer) {
  const std::vector<ChartMask> charts = {Filled(60, 4), Filled(31, 31), Filled(26, 38),
                                         Filled(22, 42)};
  for (const PackingOrder order : {PackingOrder::Longest, PackingOrder::Widest,
                                   PackingOrder::LargestPerimeter, PackingOrder::LargestArea}) {
    const Packing packing = Pack(charts, 64, {order, 1});
    EXPECT_EQ(Taken(charts, packing, 64), packing.takenTexels);
  }
  // The first of each lies in the corner.
  const PackingOrder orders[] = {PackingOrder::Longest, PackingOrder::Widest,
                                 PackingOrder::LargestArea};
  for (size_t first = 0; first < 3; ++first) {
    const ChartPlace place = Pack(charts, 64, {orders[first], 1}).places[first];
    EXPECT_EQ(place.x, 0);
    EXPECT_EQ(place.y, 0);
  }
}

// One after the other, the third lies on the second; chosen, beside it.
TEST(ChartPacking, TheChartThatLiesCheapestComesNext) {
  const std::vector<ChartMask> charts = {Filled(48, 48), Filled(32, 32), Filled(16, 30),
                                         Filled(32, 16)};
  const Packing inOrder = Pack(charts, 64), chosen = Pack(charts, 64, {PackingOrder::Longest, 4});
  EXPECT_LE(chosen.pages, inOrder.pages);
  EXPECT_EQ(Taken(charts, chosen, 64), chosen.takenTexels);
  EXPECT_EQ(chosen.places[2].page, 0);
  EXPECT_EQ(chosen.places[2].x, 48);
}

TEST(ChartPacking, EqualSquaresFillAPage) {
  const std::vector<ChartMask> charts(16, Filled(16, 16));
  const Packing packing = Pack(charts, 64);
  EXPECT_EQ(packing.pages, 1);
  EXPECT_EQ(Taken(charts, packing, 64), 64 * 64);
}

TEST(ChartPacking, SmallChartsLieWithinFrames) {
  std::vector<ChartMask> charts = {Frame(128, 128, 4)};
  for (int i = 0; i < 9; ++i) charts.push_back(Filled(36, 36));
  const Packing packing = Pack(charts, 128);
  EXPECT_EQ(packing.pages, 1);
  EXPECT_EQ(Taken(charts, packing, 128), 128 * 128 - 120 * 120 + 9 * 36 * 36);
}

TEST(ChartPacking, HolesOfAFewTexelsAreFilled) {
  std::vector<ChartMask> charts = {Filled(1024, 832)};
  for (int i = 0; i < 42 * 8; ++i) charts.push_back(Frame(24, 24, 4));
  for (int i = 0; i < 250; ++i) charts.push_back(Filled(14, 14));
  const Packing packing = Pack(charts, 1024);
  EXPECT_EQ(packing.pages, 1);
  EXPECT_EQ(Taken(charts, packing, 1024), packing.takenTexels);
}

TEST(ChartPacking, WhatDoesNotFitGoesOnTheNextPage) {
  const std::vector<ChartMask> charts(5, Filled(32, 32));
  const Packing packing = Pack(charts, 64);
  EXPECT_EQ(packing.pages, 2);
  EXPECT_EQ(packing.lastHeight, 32);
  EXPECT_EQ(Taken(charts, packing, 64), 5 * 32 * 32);
}

TEST(ChartPacking, NoneAndTooLarge) {
  EXPECT_EQ(Pack({}, 64).pages, 0);
  EXPECT_THROW(Pack({Filled(65, 2)}, 64), Error);
}

}  // namespace
}  // namespace lambert
