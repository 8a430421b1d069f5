// Which sides of surfaces light reaches.
#include "Radiosity/Core/LitSides.h"

#include <gtest/gtest.h>

#include "Common/Testing/TestScenes.h"

namespace lambert {
namespace {

constexpr uint8_t kFrontOnly = 1;

/// Lit sides in the order of material ids.
std::vector<uint8_t> LitSidesOfMaterials(Scene scene, int64_t* rays) {
  scene.mesh.Complete();
  const ClusterTree tree = ClusterFaces(&scene.mesh, scene.parts);
  const RayScene rayScene(scene.mesh);
  const std::vector<uint8_t> lit = FindLitSides(scene, tree, rayScene, rays);
  std::vector<uint8_t> ofMaterials(lit.size());
  for (size_t face = 0; face < scene.mesh.triangles.size(); ++face) {
    ofMaterials[size_t(scene.mesh.materialId[face])] = lit[size_t(scene.mesh.surfaceId[face])];
  }
  return ofMaterials;
}

/// A black floor of 1 m, material 0, and `height` above it a lamp of `side` m that shines down,
/// material 1.
Scene FloorUnderLamp(float height, float side) {
  Scene scene;
  testing::AddQuad(&scene.mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.f), Spectrum(0.f), 1,
                   0);
  testing::AddQuad(&scene.mesh, {0, 0, height}, {0, side, 0}, {side, 0, 0}, Spectrum(0.f),
                   Spectrum(1.f), 1, 1);
  testing::CompleteTables(&scene);
  return scene;
}

TEST(LitSides, AFloorSeesALoneLampHoweverSmall) {
  // 0.3 % of what the floor sees, and 1e-7 of it: 64 rays all around would miss them.
  for (const auto& [height, side] : {std::pair(10.f, 1.f), std::pair(30.f, 0.01f)}) {
    int64_t rays = 0;
    const std::vector<uint8_t> lit = LitSidesOfMaterials(FloorUnderLamp(height, side), &rays);
    ASSERT_EQ(lit.size(), 2u);
    EXPECT_EQ(lit[0], kFrontOnly);
    EXPECT_EQ(lit[1], kFrontOnly);
    // No more than two rays a place.
    EXPECT_LE(rays, 2 * 4 * 64);
  }
}

TEST(LitSides, AScreenKeepsTheFloorDark) {
  Scene scene = FloorUnderLamp(10, 1);
  testing::AddQuad(&scene.mesh, {-9, -9, 5}, {20, 0, 0}, {0, 20, 0}, Spectrum(0.5f), Spectrum(0.f),
                   1, 2);
  testing::CompleteTables(&scene);
  int64_t rays = 0;
  const std::vector<uint8_t> lit = LitSidesOfMaterials(scene, &rays);
  ASSERT_EQ(lit.size(), 3u);
  EXPECT_EQ(lit[0], 0);
  EXPECT_EQ(lit[1], kFrontOnly);
  EXPECT_EQ(lit[2], kFrontOnly);
}

TEST(LitSides, FinelyCurvedThingsAreDarkInside) {
  // Beads whose facets turn by 6 degrees, some lengths wide that rays skip: flat rays from within
  // would skip the next facet, or rounding would bring them to the other side.
  constexpr int kBeads = 40;
  Scene scene = FloorUnderLamp(4, 1);
  for (int bead = 0; bead < kBeads; ++bead) {
    const Vec3f center(0.02f * float(bead), 0.5f, 1);
    testing::AddSphere(&scene.mesh, center, 0.003f, 30, Spectrum(0.5f), Spectrum(0.f), false,
                       2 + bead);
  }
  testing::CompleteTables(&scene);
  int64_t rays = 0;
  const std::vector<uint8_t> lit = LitSidesOfMaterials(scene, &rays);
  ASSERT_EQ(lit.size(), size_t(2 + kBeads));
  for (const uint8_t sides : lit) EXPECT_EQ(sides, kFrontOnly);
}

}  // namespace
}  // namespace lambert
