#include "Atlas/Core/RadiosityMap.h"

#include <gtest/gtest.h>

#include "AtlasMeshes.h"
#include "Common/Core/Error.h"

namespace lambert {
namespace {

/// Two floors a metre apart under irradiance 2 in an atlas: one white, one black that emits 5
/// upwards.
struct TwoFloors {
  Clustered clustered;
  RadiosityAtlas atlas;
  LightMap map;

  TwoFloors() : clustered(Mesh()) {
    AtlasOptions options;
    options.pageSize = 64;
    atlas = MakeRadiosityAtlas(clustered.mesh, clustered.tree, options);
    map.pageSize = 64;
    map.pages.assign(size_t(atlas.pages), std::vector<Spectrum>(64 * 64, Spectrum(2)));
  }
  std::vector<RadiosityPage> Radiosity(uint8_t side) const {
    return MakeRadiosityMap(clustered.mesh, atlas, map, std::vector<uint8_t>(2, side));
  }

 private:
  static TriangleMesh Mesh() {
    TriangleMesh mesh;
    for (const float x : {0.f, 2.f}) {
      const int32_t first = int32_t(mesh.positions.size());
      mesh.positions.insert(mesh.positions.end(),
                            {{x, 0, 0}, {x, 0, 1}, {x + 1, 0, 1}, {x + 1, 0, 0}});
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
    mesh.reflectance = {Spectrum(0.9f), Spectrum(0.9f), Spectrum(0), Spectrum(0)};
    mesh.emittance = {Spectrum(0), Spectrum(0), Spectrum(5), Spectrum(5)};
    mesh.faceFlags = {0, 0, kEmitsFront, kEmitsFront};
    mesh.Complete();
    return mesh;
  }
};

TEST(RadiosityMap, TexelsHoldReflectanceTimesIrradianceAndEmittance) {
  const TwoFloors floors;
  const auto pages = floors.Radiosity(kFront);
  ASSERT_EQ(pages.size(), 1u);
  const std::vector<int32_t> faces = FacesOfTexels(floors.atlas, 0);
  int64_t white = 0, lamp = 0;
  for (size_t texel = 0; texel < faces.size(); ++texel) {
    if (faces[texel] < 0) continue;
    const bool isLamp = !floors.clustered.mesh.emittance[size_t(faces[texel])].IsBlack();
    EXPECT_FLOAT_EQ(pages[0].texels[texel].g, isLamp ? 5.f : 1.8f);
    ++(isLamp ? lamp : white);
  }
  EXPECT_GT(white, 500);
  EXPECT_GT(lamp, 500);
}

// Bilinear lookups at borders mix nothing else in: every texel is one floor's or the other's.
TEST(RadiosityMap, BetweenChartsLiesTheNearestFace) {
  const auto pages = TwoFloors().Radiosity(kFront);
  for (const Spectrum& texel : pages[0].texels) {
    EXPECT_TRUE(std::abs(texel.r - 1.8f) < 1e-5f || texel.r == 5) << texel.r;
  }
}

TEST(RadiosityMap, ALampIsDarkFromBehind) {
  const auto pages = TwoFloors().Radiosity(kBack);
  for (const Spectrum& texel : pages[0].texels) {
    EXPECT_TRUE(std::abs(texel.r - 1.8f) < 1e-5f || texel.r == 0) << texel.r;
  }
}

// The floor beside the lamp under a texture of two texels, white and black, factor 0.5.
TEST(RadiosityMap, TexturesAreBakedAtTheirOwnSize) {
  TwoFloors floors;
  TriangleMesh& mesh = floors.clustered.mesh;
  mesh.uvs.resize(mesh.positions.size());
  for (size_t p = 0; p < mesh.positions.size(); ++p) {
    mesh.uvs[p] = {mesh.positions[p].x, mesh.positions[p].z};
  }
  auto source = std::make_shared<TextureSource>();
  source->bytes = std::string("P6\n2 1\n255\n") + std::string(3, char(255)) + std::string(3, '\0');
  Scene scene;
  scene.mesh = mesh;
  scene.materials.resize(1);
  scene.materials[0].baseTexture =
      std::make_shared<BaseTexture>(BaseTexture{source, {}, Spectrum(0.5f)});
  const BaseTextures textures(scene);
  const auto pages = MakeRadiosityMap(mesh, floors.atlas, floors.map,
                                      std::vector<uint8_t>(2, kFront), &textures, 300);
  ASSERT_EQ(pages.size(), 1u);
  EXPECT_EQ(pages[0].size, 256);  // The largest multiple of 64
  EXPECT_TRUE(pages[0].isTextured);

  // Irradiance 2 shows up to 1 where the image is white; the lamp shows its light.
  int64_t covered = 0, lamp = 0, white = 0, black = 0;
  for (size_t texel = 0; texel < pages[0].texels.size(); ++texel) {
    if (!pages[0].isInChart[texel]) continue;
    ++covered;
    const float light = pages[0].texels[texel].r;
    lamp += light == 5;
    white += std::abs(light - 1) < 0.01f;
    black += light < 0.01f;
    EXPECT_TRUE(light == 5 || light <= 1.0001f) << light;
  }
  // A row of the page is 1 % of the floor and more.
  EXPECT_NEAR(double(lamp), 0.5 * double(covered), 0.02 * double(covered));
  EXPECT_GT(white, 0);
  EXPECT_GT(black, 0);

  // Apart from the light, their product is the same.
  EXPECT_TRUE(pages[0].contrast.empty());
  const auto apart = MakeRadiosityMap(mesh, floors.atlas, floors.map,
                                      std::vector<uint8_t>(2, kFront), &textures, 300, true);
  ASSERT_EQ(apart[0].contrast.size(), apart[0].texels.size());
  for (size_t texel = 0; texel < apart[0].texels.size(); ++texel) {
    const float light = apart[0].texels[texel].r;
    EXPECT_TRUE(light == 5 || std::abs(light - 0.5f) < 1e-5f) << light;  // 2 on a mean of 0.25
    EXPECT_NEAR(light * apart[0].contrast[texel].r, pages[0].texels[texel].r, 1e-5f);
  }
}

TEST(RadiosityMap, TheMapOfAnotherAtlasIsRefused) {
  TwoFloors floors;
  floors.map.pageSize = 32;
  EXPECT_THROW(floors.Radiosity(kFront), Error);
}

}  // namespace
}  // namespace lambert
