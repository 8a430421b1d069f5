#include "Atlas/Core/ChartMask.h"

#include <gtest/gtest.h>

namespace lambert {
namespace {

TEST(ChartMask, AMaskTurnsLeft) {
  ChartMask mask(3, 100);
  mask.Take(0, 10, 90);
  mask.Take(2, 99, 100);
  const ChartMask turned = mask.Turned();
  EXPECT_EQ(turned.Width(), 100);
  EXPECT_EQ(turned.Height(), 3);
  EXPECT_TRUE(turned.IsTaken(99 - 10, 0));
  EXPECT_TRUE(turned.IsTaken(99 - 89, 0));
  EXPECT_FALSE(turned.IsTaken(99 - 90, 0));
  EXPECT_TRUE(turned.IsTaken(0, 2));
  const ChartMask round = turned.Turned().Turned().Turned();
  for (int x = 0; x < 3; ++x) {
    for (int y = 0; y < 100; ++y) EXPECT_EQ(round.IsTaken(x, y), mask.IsTaken(x, y));
  }
}

TEST(ChartMask, TakesAnotherAtItsPlace) {
  ChartMask mask(3, 130);
  mask.Take(1, 5, 130);
  ChartMask page(8, 256);
  page.Take(mask, 4, 70);
  for (int x = 0; x < 8; ++x) {
    for (int y = 0; y < 256; ++y) {
      EXPECT_EQ(page.IsTaken(x, y), x == 5 && y >= 75 && y < 200) << x << ", " << y;
    }
  }
}

TEST(ChartMask, MeetsWhatIsTakenThere) {
  ChartMask bar(2, 100);
  bar.Take(1, 90, 100);
  ChartMask page(8, 256);
  page.Take(5, 150, 151);
  // Its only stretch has to cover that texel.
  for (int x = 0; x < 7; ++x) {
    for (int y = 0; y < 157; ++y) {
      EXPECT_EQ(page.Meets(bar, x, y), x == 4 && y > 50 && y <= 60) << x << ", " << y;
    }
  }
}

TEST(ChartMask, EveryOtherStretchBetweenCrossingsIsFilled) {
  ChartMask mask(2, 200);
  for (const int y : {3, 70, 100, 180}) mask.Cross(1, y);
  mask.FillBetweenCrossings();
  for (int y = 0; y < 200; ++y) {
    EXPECT_FALSE(mask.IsTaken(0, y));
    EXPECT_EQ(mask.IsTaken(1, y), (y >= 3 && y < 70) || (y >= 100 && y < 180)) << y;
  }
}

}  // namespace
}  // namespace lambert
