#include "Atlas/Core/ChartRoom.h"

#include <gtest/gtest.h>

namespace lambert {
namespace {

TEST(ChartRoom, TwoPartsSaveRoomUpToAMargin) {
  const Room whole{9, 12};
  const std::array<Room, 2> parts{Room{3, 8}, Room{2, 6}};
  const double margin = MostMargin(whole, parts, 0.9);
  const auto roomOf = [&](const Room& room) {
    return room.area + margin * room.perimeter + 4 * margin * margin;
  };
  EXPECT_NEAR(roomOf(parts[0]) + roomOf(parts[1]), 0.9 * roomOf(whole), 1e-12);
  EXPECT_GT(margin, 0);
  EXPECT_LT(MostMargin(whole, parts, 0.5), 0);
}

}  // namespace
}  // namespace lambert
