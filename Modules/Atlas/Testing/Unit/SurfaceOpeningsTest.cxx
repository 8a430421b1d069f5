#include "Atlas/Core/SurfaceOpenings.h"

#include <gtest/gtest.h>

#include "Atlas/Testing/Unit/AtlasMeshes.h"

namespace lambert {
namespace {

/// Adds another mesh, moved; its faces have the next surface number.
void Add(const TriangleMesh& other, const Vec3f& offset, TriangleMesh* mesh) {
  const int32_t surface = mesh->surfaceId.empty() ? 0 : mesh->surfaceId.back() + 1;
  Append(other, offset, mesh);
  mesh->surfaceId.resize(mesh->triangles.size(), surface);
}

std::vector<SurfaceOpening> OpeningsOf(TriangleMesh mesh) {
  mesh.Complete();
  return FindOpenings(mesh);
}

TEST(SurfaceOpenings, HolesAreWhatBorderLinesSpan) {
  TriangleMesh mesh;
  Add(Box({1, 1, 0.5f}, false), {}, &mesh);
  Add(Box({1, 1, 0.5f}, true), {2, 0, 0}, &mesh);
  Add(FlatGrid(4), {4, 0, 0}, &mesh);
  // A pipe: two holes that face opposite ways.
  Add(GridMesh(64, 4, [](double u, double v) { return OnTurn(u, 0.5, 2 * v); }), {8, 0, 0}, &mesh);
  const std::vector<SurfaceOpening> openings = OpeningsOf(mesh);
  ASSERT_EQ(openings.size(), 4u);
  EXPECT_NEAR(openings[0].holes, 1. / 3, 1e-5);
  EXPECT_EQ(openings[1].holes, 0);
  EXPECT_NEAR(openings[2].holes, 1, 1e-5);
  EXPECT_NEAR(openings[3].holes, 0.25, 1e-2);
}

TEST(SurfaceOpenings, SmallSolidsEncloseTheirInside) {
  TriangleMesh mesh;
  Add(Box({1, 1, 1}, true), {}, &mesh);
  Add(Box({1, 1, 1}, false), {2, 0, 0}, &mesh);
  Add(FlatGrid(4), {20, 20, 20}, &mesh);
  EXPECT_EQ(OpeningsOf(mesh)[0].enclosedSide, kBack);
  EXPECT_FALSE(OpeningsOf(mesh)[1].enclosedSide);
  // Seen from within; and as a room, which all lies in.
  TriangleMesh inverted = mesh;
  for (size_t face = 0; face < 12; ++face) {
    std::swap(inverted.triangles[face][0], inverted.triangles[face][1]);
  }
  EXPECT_EQ(OpeningsOf(inverted)[0].enclosedSide, kFront);
  TriangleMesh room;
  Add(Box({30, 30, 30}, true), {-1, -1, -1}, &room);
  Add(mesh, {}, &room);
  EXPECT_FALSE(OpeningsOf(room)[0].enclosedSide);
}

TEST(SurfaceOpenings, ALampWithinLightsTheInside) {
  TriangleMesh mesh;
  Add(Box({1, 1, 1}, true), {}, &mesh);
  Add(Box({0.1f, 0.1f, 0.1f}, true), {0.4f, 0.4f, 0.4f}, &mesh);
  Add(FlatGrid(4), {20, 20, 20}, &mesh);
  mesh.Complete();
  mesh.emittance[12] = Spectrum(1);
  mesh.faceFlags[12] = kEmitsFront;
  EXPECT_FALSE(OpeningsOf(mesh)[0].enclosedSide);
}

TEST(SurfaceOpenings, WhatHoldsMostIsARoom) {
  TriangleMesh mesh;
  Add(Box({10, 10, 3}, false), {}, &mesh);
  Add(Box({1, 1, 1}, false), {2, 2, 0.5f}, &mesh);
  Add(Box({1, 1, 1}, true), {5, 5, 0.5f}, &mesh);
  const std::vector<SurfaceOpening> openings = OpeningsOf(mesh);
  EXPECT_TRUE(openings[0].isRoom);
  EXPECT_FALSE(openings[1].isRoom);
}

}  // namespace
}  // namespace lambert
