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
  std::vector<std::vector<Spectrum>> Radiosity(uint8_t side) const {
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
    EXPECT_FLOAT_EQ(pages[0][texel].g, isLamp ? 5.f : 1.8f);
    ++(isLamp ? lamp : white);
  }
  EXPECT_GT(white, 500);
  EXPECT_GT(lamp, 500);
}

// Bilinear lookups at borders mix nothing else in: every texel is one floor's or the other's.
TEST(RadiosityMap, BetweenChartsLiesTheNearestFace) {
  const auto pages = TwoFloors().Radiosity(kFront);
  for (const Spectrum& texel : pages[0]) {
    EXPECT_TRUE(std::abs(texel.r - 1.8f) < 1e-5f || texel.r == 5) << texel.r;
  }
}

TEST(RadiosityMap, ALampIsDarkFromBehind) {
  const auto pages = TwoFloors().Radiosity(kBack);
  for (const Spectrum& texel : pages[0]) {
    EXPECT_TRUE(std::abs(texel.r - 1.8f) < 1e-5f || texel.r == 0) << texel.r;
  }
}

TEST(RadiosityMap, TheMapOfAnotherAtlasIsRefused) {
  TwoFloors floors;
  floors.map.pageSize = 32;
  EXPECT_THROW(floors.Radiosity(kFront), Error);
}

}  // namespace
}  // namespace lambert
