// Pairs of faces that are the two sides of one sheet.
#include "Scene/Core/DoubledFaces.h"

#include <gtest/gtest.h>

#include "Common/Testing/TestScenes.h"

namespace lambert {
namespace {

const Vec3f kA(0, 0, 0), kB(2, 0, 0), kC(0, 3, 0);

/// Two faces with the same corners, the second wound the other way and begun at another corner.
TriangleMesh Sheet(const Spectrum& above = Spectrum(0.f), const Spectrum& below = Spectrum(0.f)) {
  TriangleMesh mesh;
  testing::AddTriangle(&mesh, kA, kB, kC, Spectrum(0.8f), above);
  testing::AddTriangle(&mesh, kC, kB, kA, Spectrum(0.2f), below);
  return mesh;
}

TEST(DoubledFaces, EachHidesTheBackOfTheOther) {
  const DoubledFaces doubled(Sheet());
  for (const int32_t face : {0, 1}) {
    EXPECT_FALSE(doubled.IsHidden(face, kFront));
    EXPECT_TRUE(doubled.IsHidden(face, kBack));
  }
}

TEST(DoubledFaces, APlaceIsTheSameOnBoth) {
  const TriangleMesh mesh = Sheet();
  const DoubledFaces doubled(mesh);
  const auto position = [&](const DoubledFaces::Place& at) {
    const Vec2f& b = at.barycentric;
    return mesh.Corner(at.face, 0) * (1 - b.x - b.y) + mesh.Corner(at.face, 1) * b.x +
           mesh.Corner(at.face, 2) * b.y;
  };
  const DoubledFaces::Place at{0, {0.25f, 0.125f}}, twin = doubled.OnTwin(at);
  EXPECT_EQ(twin.face, 1);
  EXPECT_EQ(position(twin), position(at));
  EXPECT_TRUE(doubled.IsReversed(0));
}

TEST(DoubledFaces, TheFrontIsThatOfTheFile) {
  // Cleaning has rewound the second: both are stored alike.
  TriangleMesh mesh = Sheet();
  std::swap(mesh.triangles[1][0], mesh.triangles[1][2]);
  mesh.faceFlags[1] = kRewound;
  const DoubledFaces doubled(mesh);
  EXPECT_TRUE(doubled.IsHidden(0, kBack));
  EXPECT_TRUE(doubled.IsHidden(1, kFront));
  EXPECT_FALSE(doubled.IsHidden(1, kBack));
  EXPECT_FALSE(doubled.IsReversed(1));
}

TEST(DoubledFaces, NoLightIsHidden) {
  // Each emits to its own side; but what shines from both sides cannot be one side of a sheet.
  const Spectrum light(1.f);
  EXPECT_FALSE(DoubledFaces(Sheet(light, light)).IsEmpty());
  TriangleMesh both = Sheet(light);
  both.faceFlags[0] = kEmitsFront | kEmitsBack;
  EXPECT_TRUE(DoubledFaces(both).IsEmpty());
}

TEST(DoubledFaces, OthersStayAsTheyAre) {
  // Wound alike, or a corner apart by a rounding.
  TriangleMesh alike = Sheet();
  std::swap(alike.triangles[1][0], alike.triangles[1][2]);
  EXPECT_TRUE(DoubledFaces(alike).IsEmpty());
  TriangleMesh apart = Sheet();
  apart.positions[0].z = 1e-7f;
  EXPECT_TRUE(DoubledFaces(apart).IsEmpty());
  EXPECT_TRUE(DoubledFaces(TriangleMesh()).IsEmpty());
}

}  // namespace
}  // namespace lambert
