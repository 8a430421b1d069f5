// Scenes are told apart by all that light depends on, and by nothing else.
#include "Scene/Core/SceneKey.h"

#include <gtest/gtest.h>

#include <functional>

#include "Common/Testing/TestScenes.h"
#include "Scene/Core/EnvironmentImage.h"

namespace lambert {
namespace {

/// Which numbers of the key a change to a lit cube changes: G, M, L.
std::string ChangedBy(const std::function<void(Scene*)>& change) {
  Scene scene = testing::FurnaceCube(0.5f);
  scene.lights.emplace_back().intensity = Spectrum(1.f);
  const SceneKey before = KeyOf(scene);
  change(&scene);
  const SceneKey after = KeyOf(scene);
  return std::string(before.geometry != after.geometry ? "G" : "") +
         (before.materials != after.materials ? "M" : "") +
         (before.lights != after.lights ? "L" : "");
}

TEST(SceneKeyTest, TellsGeometryFromMaterialsAndLights) {
  EXPECT_EQ(ChangedBy([](Scene* s) { s->mesh.positions[3].x += 1e-6f; }), "G");
  EXPECT_EQ(ChangedBy([](Scene* s) { std::swap(s->mesh.triangles[0], s->mesh.triangles[1]); }),
            "G");
  EXPECT_EQ(ChangedBy([](Scene* s) { s->mesh.reflectance[1].b = 0.4f; }), "M");
  EXPECT_EQ(ChangedBy([](Scene* s) { s->mesh.emittance[1].b += 1; }), "M");
  EXPECT_EQ(ChangedBy([](Scene* s) { s->mesh.faceFlags[1] ^= kEmitsBack; }), "M");
  EXPECT_EQ(ChangedBy([](Scene* s) { s->lights[0].size = 0.1f; }), "L");
  EXPECT_EQ(ChangedBy([](Scene* s) { s->lights[0].ground = Spectrum(0.1f); }), "L");
  EXPECT_EQ(ChangedBy([](Scene* s) { s->lights[0].rotation = 0.1f; }), "L");
  EXPECT_EQ(ChangedBy([](Scene* s) { s->lights[0].type = LightType::Sky; }), "L");
  EXPECT_EQ(ChangedBy([](Scene* s) { s->lights.push_back(s->lights[0]); }), "L");
}

TEST(SceneKeyTest, TellsEnvironmentsApart) {
  const auto keyOf = [](int width, int height, float last) {
    std::vector<Spectrum> texels(8, Spectrum(1.f));
    texels.back() = Spectrum(last);
    Scene scene;
    scene.lights.emplace_back().image =
        std::make_shared<EnvironmentImage>(width, height, std::move(texels));
    return KeyOf(scene).lights;
  };
  EXPECT_EQ(keyOf(4, 2, 3), keyOf(4, 2, 3));
  EXPECT_NE(keyOf(4, 2, 3), keyOf(4, 2, 2));
  EXPECT_NE(keyOf(4, 2, 3), keyOf(2, 4, 3));
}

TEST(SceneKeyTest, LeavesOutWhatLightDoesNotDependOn) {
  EXPECT_EQ(ChangedBy([](Scene*) {}), "");
  EXPECT_EQ(ChangedBy([](Scene* s) { s->camera = Camera(); }), "");
  EXPECT_EQ(ChangedBy([](Scene* s) { s->lights[0].name = "lamp"; }), "");
  EXPECT_EQ(ChangedBy([](Scene* s) { s->materials[0].name = "plaster"; }), "");
}

}  // namespace
}  // namespace lambert
