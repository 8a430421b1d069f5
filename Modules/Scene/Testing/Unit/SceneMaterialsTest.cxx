// Other materials on the faces that a scene has.
#include "Scene/Core/SceneMaterials.h"

#include <gtest/gtest.h>

#include "Common/Testing/TestScenes.h"

namespace lambert {
namespace {

/// Two triangles, one a lamp.
Scene TwoFaces(float reflectance, float emittance) {
  Scene scene;
  testing::AddQuad(&scene.mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(reflectance));
  testing::CompleteTables(&scene);
  scene.mesh.emittance[1] = Spectrum(emittance);
  return scene;
}

/// The faces of a scene in the order of the numbers.
Scene Ordered(const Scene& scene, const std::vector<int64_t>& order) {
  Scene ordered = scene;
  for (size_t face = 0; face < order.size(); ++face) {
    const size_t from = size_t(order[face]);
    ordered.mesh.triangles[face] = scene.mesh.triangles[from];
    ordered.mesh.emittance[face] = scene.mesh.emittance[from];
  }
  return ordered;
}

TEST(SceneMaterials, GoToTheFacesThatTheyBelongTo) {
  const std::vector<int64_t> order{1, 0};
  Scene scene = Ordered(TwoFaces(0.5f, 1), order);
  EXPECT_TRUE(TakeMaterials(TwoFaces(0.25f, 3), order, &scene));
  EXPECT_EQ(scene.mesh.reflectance[0], Spectrum(0.25f));
  EXPECT_EQ(scene.mesh.emittance[0], Spectrum(3.f));
  EXPECT_EQ(scene.mesh.emittance[1], Spectrum(0.f));
}

TEST(SceneMaterials, OfTheSameSceneChangeNothing) {
  const std::vector<int64_t> order{1, 0};
  Scene scene = Ordered(TwoFaces(0.5f, 1), order);
  EXPECT_FALSE(TakeMaterials(TwoFaces(0.5f, 1), order, &scene));
}

TEST(SceneMaterials, OfOtherGeometryAreNotTaken) {
  const std::vector<int64_t> order{1, 0};
  Scene scene = Ordered(TwoFaces(0.5f, 1), order), moved = TwoFaces(0.25f, 1);
  moved.mesh.positions[0].x = 0.5f;
  EXPECT_FALSE(TakeMaterials(moved, order, &scene));
  EXPECT_EQ(scene.mesh.reflectance[0], Spectrum(0.5f));
}

}  // namespace
}  // namespace lambert
