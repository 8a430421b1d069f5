#include "Display/Core/DefaultCamera.h"

#include <gtest/gtest.h>

namespace lambert {
namespace {

/// A box of six walls, some left out; bits of `open`: -x +x -y +y -z +z.
TriangleMesh Box(const Vec3f& low, const Vec3f& high, int open) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.push_back(
        {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  }
  const int walls[6][4] = {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4},
                           {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}};
  for (int wall = 0; wall < 6; ++wall) {
    if (open & (1 << wall)) continue;
    const int* w = walls[wall];
    mesh.triangles.push_back({w[0], w[1], w[2]});
    mesh.triangles.push_back({w[0], w[2], w[3]});
  }
  mesh.Complete();
  return mesh;
}

bool Inside(const Box3f& box, const Vec3d& p) {
  return p.x > box.low.x && p.x < box.high.x && p.y > box.low.y && p.y < box.high.y &&
         p.z > box.low.z && p.z < box.high.z;
}

TEST(DefaultCamera, StandsWithinAClosedRoomAndLooksAlongIt) {
  const TriangleMesh room = Box({0, 0, 0}, {10, 3, 4}, 0);
  const Camera camera = DefaultCamera(room, std::vector<Spectrum>(8, Spectrum(1)));
  EXPECT_TRUE(Inside(room.Bounds(), camera.position));
  const Vec3d forward = Normalize(camera.focalPoint - camera.position);
  EXPECT_GT(std::abs(forward.x), std::abs(forward.z));
}

TEST(DefaultCamera, LooksThroughTheOpenSide) {
  const TriangleMesh room =
      Box({0, 0, 0}, {5, 5, 5}, 1 << 5);  // +z left out, as in the Cornell box
  const Camera camera = DefaultCamera(room, std::vector<Spectrum>(8, Spectrum(1)));
  EXPECT_GT(camera.position.z, 5);
  EXPECT_NEAR(camera.position.x, 2.5, 1e-4);  // straight on: the middle of the side, in float
  EXPECT_NEAR(camera.focalPoint.z, 2.5, 1e-4);
}

TEST(DefaultCamera, StandsUnderAnUpperStoreyWithoutRoof) {
  TriangleMesh house = Box({0, 0, 0}, {10, 6, 8}, 1 << 3);  // +y left out
  const std::vector<Spectrum> light(16, Spectrum(1));
  EXPECT_GT(DefaultCamera(house, light).position.y, 6);  // A tray, seen from above.
  const TriangleMesh ceiling = Box({0, 2.6f, 0}, {10, 2.6f, 8}, 0x3b);
  for (const auto& t : ceiling.triangles) house.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  house.positions.insert(house.positions.end(), ceiling.positions.begin(), ceiling.positions.end());
  EXPECT_TRUE(Inside({{0, 0, 0}, {10, 2.6f, 8}}, DefaultCamera(house, light).position));
}

TEST(DefaultCamera, FramesAnObjectFromOutside) {
  const TriangleMesh plate = Box({0, 0, 0}, {2, 2, 2}, 0x3b);  // the floor alone
  const Camera camera = DefaultCamera(plate, std::vector<Spectrum>(8, Spectrum(1)));
  EXPECT_GT(camera.position.y, plate.Bounds().high.y);
  EXPECT_GT(camera.position.z, camera.focalPoint.z);
}

TEST(DefaultCamera, TurnsWithTheRoom) {
  for (const int open : {0, 1 << 5, 0x3b}) {
    const TriangleMesh room = Box({0, 0, 0}, {10, 3, 4}, open);
    const std::vector<Spectrum> light(8, Spectrum(1));
    const Camera camera = DefaultCamera(room, light);
    for (const UpAxis up : {UpAxis::X, UpAxis::Z}) {
      TriangleMesh turned = room;
      for (Vec3f& p : turned.positions) p = Vec3f(FromYUp(Vec3d(p), up));
      const Camera view = DefaultCamera(turned, light, 4. / 3, up);
      EXPECT_LT(Length(view.position - FromYUp(camera.position, up)), 1e-3);
      EXPECT_LT(Length(view.focalPoint - FromYUp(camera.focalPoint, up)), 1e-3);
      EXPECT_TRUE(view.viewUp == FromYUp(camera.viewUp, up));
    }
  }
}

TEST(DefaultCamera, AnEmptyMeshGivesTheDefault) {
  EXPECT_EQ(DefaultCamera({}, {}).position.z, Camera().position.z);
}

}  // namespace
}  // namespace lambert
