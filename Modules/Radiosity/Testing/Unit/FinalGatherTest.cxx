// The light that leaves have in balance, whatever links made of it before.
#include "Radiosity/Core/FinalGather.h"

#include <gtest/gtest.h>

#include <optional>
#include <utility>

#include "SolverScenes.h"

namespace lambert {
namespace {

/// A scene whose leaves are in balance, and one bounce at places in it.
class BouncedLight {
 public:
  explicit BouncedLight(Scene scene, float leftByLinks = 0) {
    modelled_.scene = std::move(scene);
    modelled_.Model();
    light_.Grow(*modelled_.hierarchy);
    for (VectorIrradiance& irradiance : light_.irradiance) {
      irradiance.isotropic = Spectrum(leftByLinks);
    }
    gather_.emplace(*modelled_.hierarchy, *modelled_.rayScene, &light_);
    gather_->GatherAtLeaves(1024, 1, 1, &rays_);
    EXPECT_GT(rays_, 0);
  }
  /// W/m2, the green band.
  float At(const Vec3f& place, const Vec3f& normal, int rays) {
    BounceRays bounce;
    bounce.count = rays;
    return gather_->Bounces({{place, normal, normal, 0}}, bounce, &rays_)[0].Mean().g;
  }

 private:
  testing::ModelledScene modelled_;
  ElementLight light_;
  std::optional<FinalGather> gather_;
  int64_t rays_ = 0;
};

/// One bounce at a place in the middle of the floor of a cube of 1 m, W/m2, once its leaves are in
/// balance; links had left `before` all around them.
float BounceInCube(float reflectance, float emittance, float before) {
  Scene scene;
  testing::AddBox(&scene.mesh, {0, 0, 0}, {1, 1, 1}, testing::BoxMaterials(reflectance, emittance),
                  true);
  return BouncedLight(std::move(scene), before).At({0.5f, 0.5f, 0}, {0, 0, 1}, 4096);
}

TEST(FinalGather, NoLightStaysInAClosedThing) {
  // In eight bounces it would lose a seventh.
  EXPECT_EQ(BounceInCube(0.98f, 0, 10), 0);
}

TEST(FinalGather, LightIsFollowedToTheLastBounce) {
  // A furnace receives 1 / (1 - 0.9) W/m2 and reflects 9 of them, 4 in the first six bounces. What
  // is near sends one ray to the emitters, which scatters by half of what it brings.
  EXPECT_NEAR(BounceInCube(0.9f, 1, 0), 9, 0.05);
  EXPECT_EQ(BounceInCube(0.9f, 1, 50), BounceInCube(0.9f, 1, 0));
}

TEST(FinalGather, NoLightComesThroughAWallThatStandsOnALeaf) {
  // A closed box lies over two thirds of a floor that a lamp lights and that is one leaf, with
  // samples on both sides of the wall.
  Scene scene;
  TriangleMesh& mesh = scene.mesh;
  testing::AddQuad(&mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.8f));
  testing::AddBox(&mesh, {-0.1f, -0.1f, -0.1f}, {0.67f, 1.1f, 0.5f}, testing::BoxMaterials(0.8f, 0),
                  true);
  testing::AddQuad(&mesh, {0, 0, 3}, {0, 1, 0}, {1, 0, 0}, Spectrum(0.f), Spectrum(100.f), 1, 1, 1);
  BouncedLight bounced(std::move(scene));
  EXPECT_LT(bounced.At({0.67f, 0.5f, 0.25f}, {-1, 0, 0}, 1024), 1e-4f) << "inside";
  EXPECT_GT(bounced.At({0.67f, 0.5f, 0.25f}, {1, 0, 0}, 1024), 0.1f) << "outside";
}

TEST(FinalGather, AGapIsDarkBehindItsOpening) {
  // A plate 1 mm over a lit floor whose samples lie around it. At its edge light enters.
  Scene scene;
  TriangleMesh& mesh = scene.mesh;
  testing::AddQuad(&mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.8f));
  testing::AddQuad(&mesh, {0.45f, 0.45f, 0.001f}, {0, 0.1f, 0}, {0.1f, 0, 0}, Spectrum(0.8f),
                   Spectrum(0.f), 1, 1);
  testing::AddQuad(&mesh, {0, 0, 3}, {0, 1, 0}, {1, 0, 0}, Spectrum(0.f), Spectrum(100.f), 2, 1, 2);
  BouncedLight bounced(std::move(scene));
  EXPECT_GT(bounced.At({0.4501f, 0.5f, 0.001f}, {0, 0, -1}, 4096), 1.f);
  // 1.7 where a third bounce reads the floor.
  EXPECT_LT(bounced.At({0.5f, 0.5f, 0.001f}, {0, 0, -1}, 4096), 0.1f);
}

TEST(FinalGather, FacetsThatTurnWithinALeafAddNoLight) {
  // A furnace in one leaf that faces all ways, of which links knew that its light comes from above,
  // and a lamp outside: what is there is brighter than the furnace could ever be.
  testing::ModelledScene modelled;
  TriangleMesh& mesh = modelled.scene.mesh;
  testing::AddSphere(&mesh, {0, 0, 0}, 1, 8, Spectrum(0.9f), Spectrum(0.01f), true);
  testing::AddQuad(&mesh, {0, 0, 3}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.f), Spectrum(100.f), 1, 1, 1);
  modelled.Model();
  ElementLight light;
  light.Grow(*modelled.hierarchy);
  for (VectorIrradiance& irradiance : light.irradiance) {
    irradiance.isotropic = Spectrum(0.1f);
    irradiance.vector.fill({0, 0, 10});
  }
  FinalGather gather(*modelled.hierarchy, *modelled.rayScene, &light);
  int64_t rays = 0;
  gather.GatherAtLeaves(1024, 1, 1, &rays);
  double inside = 0;
  for (int32_t leaf = 0; leaf < modelled.hierarchy->Size(); ++leaf) {
    const Element& element = (*modelled.hierarchy)[leaf];
    if (!element.IsLeaf() || element.side == kBack || !(element.area > 2)) continue;
    EXPECT_FALSE(element.IsPolygon());
    inside = double(light.radiosity[size_t(leaf)].g);
  }
  EXPECT_NEAR(inside, 0.1, 0.025);  // Twelve rays to its facets from each of four samples.
}

}  // namespace
}  // namespace lambert
