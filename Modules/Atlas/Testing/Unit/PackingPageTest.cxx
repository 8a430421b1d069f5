#include "Atlas/Core/PackingPage.h"

#include <gtest/gtest.h>

namespace lambert {
namespace {

TurnedChart Filled(int width, int height) {
  ChartMask mask(width, height);
  for (int x = 0; x < width; ++x) mask.Take(x, 0, height);
  return TurnFourWays(mask);
}

/// 20 x 40 texels: a foot of 4 x 20 to the left, and a block on it.
TurnedChart Overhang() {
  ChartMask mask(20, 40);
  for (int x = 0; x < 20; ++x) mask.Take(x, x < 4 ? 0 : 20, 40);
  return TurnFourWays(mask);
}

TEST(PackingBin, ChartsFallWhereLeastStaysEmpty) {
  PackingBin bin(0, 0, 64, 64, 1);
  const TurnedChart step = Filled(16, 10);
  EXPECT_EQ(bin.Put(step[0], {0, 0}), 0);
  // In a corner as well as anywhere to the right of the step, and lower than on it.
  const TurnedChart bar = Filled(40, 8);
  const PackingSpot spot = bin.Find(bar, 1000);
  EXPECT_EQ(spot.x, 16);
  EXPECT_EQ(spot.y, 0);
  EXPECT_EQ(spot.turns, 0);
  EXPECT_EQ(spot.cost, 8);
  EXPECT_LT(bin.Find(bar, 8).x, 0);
  // Of what takes the first column, on the step: half of it overhangs.
  const PackingSpot high = bin.Find(Filled(32, 32), 1000, 0, 1);
  EXPECT_EQ(high.x, 0);
  EXPECT_EQ(high.y, 10);
  EXPECT_EQ(high.cost, 10 + 32 + 5);
  EXPECT_LT(bin.Find(Filled(60, 55), 1000).x, 0);
}

TEST(PackingPage, ChartsSlideBelowWhatOverhangs) {
  PackingPage page(64, 1);
  ChartPlace place;
  page.PutOnTop(Overhang(), {0, 0}, &place);
  const PackingSpot spot = page.PutOnTop(Filled(30, 12), {30, 0}, &place);
  EXPECT_EQ(spot.x, 4);
  EXPECT_EQ(place.x, 4);
  EXPECT_EQ(place.y, 0);
  // What overhangs stays the top.
  EXPECT_EQ(page.Top().Top(10), 40);
  EXPECT_EQ(page.Top().Top(33), 12);
}

}  // namespace
}  // namespace lambert
