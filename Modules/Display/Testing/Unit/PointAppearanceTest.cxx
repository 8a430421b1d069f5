#include "Display/Core/PointAppearance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "Common/Core/Error.h"

namespace lambert {
namespace {

/// Two triangles apart from each other, of reflectance 0.2 and 0.8; the second emits 3 W/m2.
TriangleMesh TwoTriangles() {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 5}, {1, 0, 5}, {0, 1, 5}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  mesh.reflectance = {Spectrum(0.2f), Spectrum(0.8f)};
  mesh.emittance = {Spectrum(), Spectrum(3)};
  mesh.Complete();
  return mesh;
}

/// The first lit by its points, irradiance 10; the second on page 1 of 2, where irradiance is 20.
PointLight OneOfEachKind() {
  PointLight light;
  light.irradiance.assign(6, Spectrum(10));
  light.lightMapCoords = {{-1, -1}, {-1, -1}, {-1, -1}, {0.5f, 0.5f}, {1, 0}, {0, 1}};
  light.page = {0, 1};
  light.pages = 2;
  return light;
}

TEST(PointAppearance, BothKindsAreSeenByTheirArea) {
  TriangleMesh mesh = TwoTriangles();
  mesh.emittance[1] = Spectrum();
  const PointAppearance appearance = MakePointAppearance(mesh, OneOfEachKind(), false);
  const LightImage map{1, 2, {Spectrum(1000), Spectrum(20)}};
  double points = 0, texels = 0;
  for (const LuminanceSample& s : ShownSamples(mesh, appearance, map)) {
    const bool byPoint = std::abs(s.luminance - 0.2f * 10) < 1e-4f;
    EXPECT_TRUE(byPoint || std::abs(s.luminance - 0.8f * 20) < 1e-4f) << s.luminance;
    (byPoint ? points : texels) += s.weight;
  }
  EXPECT_NEAR(points, 0.5, 1e-6);
  EXPECT_NEAR(texels, 0.5, 1e-6);
}

TEST(PointAppearance, AFaceOfTheMapIsSeenAcrossItsTexels) {
  // Black corners, light between them: what a vertex sees does not expose.
  TriangleMesh mesh = TwoTriangles();
  mesh.emittance[1] = Spectrum();
  PointLight light = OneOfEachKind();
  light.lightMapCoords = {{0, 0}, {1, 0}, {0, 1}, {0, 0}, {1, 0}, {0, 1}};
  light.page = {0, 0};
  light.pages = 1;
  LightImage map{64, 64, std::vector<Spectrum>(64 * 64, Spectrum(5))};
  for (const size_t corner : {0, 63, 63 * 64}) map.pixels[corner] = Spectrum();
  const Adaptation seen =
      MeasureAdaptation(ShownSamples(mesh, MakePointAppearance(mesh, light, false), map));
  EXPECT_NEAR(seen.average, 5 * std::sqrt(0.2 * 0.8), 1e-4);
}

TEST(PointAppearance, LampsAreNotSeen) {
  const PointAppearance appearance = MakePointAppearance(TwoTriangles(), OneOfEachKind(), false);
  EXPECT_EQ(ShownSamples(TwoTriangles(), appearance, {1, 2, {Spectrum(1), Spectrum(1)}}).size(),
            4u);
  EXPECT_EQ(appearance.vertexRadiosity[3].g, 3);
}

TEST(PointAppearance, TheOtherKindIsNeutral) {
  const PointAppearance appearance = MakePointAppearance(TwoTriangles(), OneOfEachKind(), false);
  EXPECT_EQ(appearance.lightMapCoords[0].x, -1);  // Outside of the map, where it is black.
  EXPECT_TRUE(appearance.vertexIrradiance[3].IsBlack());
  EXPECT_FLOAT_EQ(appearance.lightMapCoords[3].y, 0.75f);  // The middle of the upper page.
}

TEST(PointAppearance, RadiosityIsTakenAsItStandsButUnderATexture) {
  PointLight light;
  light.irradiance.assign(6, Spectrum(10));
  light.radiosity.assign(6, Spectrum(7));
  const PointAppearance plain = MakePointAppearance(TwoTriangles(), light, false);
  EXPECT_EQ(plain.vertexRadiosity[0].g, 7);
  EXPECT_TRUE(plain.vertexIrradiance[0].IsBlack());
  const PointAppearance textured = MakePointAppearance(TwoTriangles(), light, true);
  EXPECT_EQ(textured.vertexIrradiance[0].g, 10);
  EXPECT_EQ(textured.vertexRadiosity[5].g, 3);  // What it emits goes past the texture.
}

TEST(PointAppearance, ReflectanceIsTheMeanByArea) {
  TriangleMesh shared;  // The second triangle has three times the area of the first.
  shared.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-3, 0, 0}};
  shared.triangles = {{0, 1, 2}, {0, 2, 3}};
  shared.reflectance = {Spectrum(0.2f), Spectrum(0.6f)};
  shared.Complete();
  PointLight light;
  light.irradiance.assign(4, Spectrum(1));
  EXPECT_NEAR(MakePointAppearance(shared, light, false).reflectance[0].r, 0.5, 1e-6);
  EXPECT_NEAR(MakePointAppearance(shared, light, false).reflectance[3].r, 0.6, 1e-6);
}

TEST(PointAppearance, RefusesPointsWithoutLight) {
  EXPECT_THROW(MakePointAppearance(TwoTriangles(), {}, false), Error);
  PointLight light = OneOfEachKind();
  light.pages = 0;  // Places on a map that is not there, and no other light.
  light.irradiance.clear();
  EXPECT_THROW(MakePointAppearance(TwoTriangles(), light, false), Error);
  light.irradiance.resize(5);
  EXPECT_THROW(MakePointAppearance(TwoTriangles(), light, false), Error);
}

TEST(LightImage, MipMapsGoAsFarAsChartsLieApart) {
  const std::vector<std::pair<int, int>> lastOfPadding = {{0, 0}, {1, 0}, {2, 1},  {4, 1},
                                                          {5, 2}, {6, 2}, {11, 3}, {64, 5}};
  for (const auto& [padding, last] : lastOfPadding) EXPECT_EQ(SafeMipLevel(padding), last);
}

}  // namespace
}  // namespace lambert
