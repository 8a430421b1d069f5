#include "Display/Core/UpAxis.h"

#include <gtest/gtest.h>

namespace lambert {
namespace {

/// Floor and ceiling of 5 x 4, walls 3 high, standing on y.
TriangleMesh Room() {
  TriangleMesh room;
  const int walls[6][4] = {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4},
                           {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}};
  for (int i = 0; i < 8; ++i) {
    room.positions.push_back({i & 1 ? 5.f : 0.f, i & 2 ? 3.f : 0.f, i & 4 ? 4.f : 0.f});
  }
  for (const auto& wall : walls) {
    room.triangles.push_back({wall[0], wall[1], wall[2]});
    room.triangles.push_back({wall[0], wall[2], wall[3]});
  }
  room.Complete();
  return room;
}

TEST(UpAxis, IsGuessedInBothOrientationsOfARoom) {
  TriangleMesh room = Room();
  EXPECT_EQ(GuessUpAxis(room), UpAxis::Y);
  for (Vec3f& p : room.positions) p = Vec3f(FromYUp(Vec3d(p), UpAxis::Z));
  EXPECT_EQ(GuessUpAxis(room), UpAxis::Z);
}

TEST(UpAxis, IsYWhereNothingTells) {
  EXPECT_EQ(GuessUpAxis({}), UpAxis::Y);
  TriangleMesh cube = Room();
  for (Vec3f& p : cube.positions) p = Vec3f(p.x / 5, p.y / 3, p.z / 4);
  EXPECT_EQ(GuessUpAxis(cube), UpAxis::Y);
}

TEST(UpAxis, FramesAreTurnedIntoEachOther) {
  const Vec3d x(1, 0, 0), y(0, 1, 0), v(1, 2, 3);
  EXPECT_TRUE(FromYUp(y, UpAxis::X) == x);
  EXPECT_TRUE(FromYUp(y, UpAxis::Z) == Vec3d(0, 0, 1));
  for (const UpAxis up : {UpAxis::X, UpAxis::Y, UpAxis::Z}) {
    EXPECT_TRUE(ToYUp(FromYUp(v, up), up) == v);
    // No mirrors: right-handed stays right-handed.
    const Vec3d right = FromYUp(x, up), top = FromYUp(y, up), back = FromYUp({0, 0, 1}, up);
    EXPECT_TRUE(Cross(right, top) == back);
  }
}

}  // namespace
}  // namespace lambert
