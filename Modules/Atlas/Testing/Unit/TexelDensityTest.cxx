#include "Atlas/Core/TexelDensity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "AtlasMeshes.h"

namespace lambert {
namespace {

/// Two planes of 800 triangles, one above the other: even light above, waves below.
struct EvenAndWaves : Clustered {
  RadiositySolution solution;

  EvenAndWaves() : Clustered(TwoFlatGrids(20)) {
    solution.mesh = mesh;
    for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
      solution.inputFaceId.push_back(face);
      solution.side.push_back(kFront);
    }
    for (const Vec3f& p : mesh.positions) {
      solution.irradiance.push_back(Spectrum(p.z > 1 ? 5 : 5 + 4 * std::sin(30 * p.x)));
    }
  }

  RadiosityAtlas Atlas(TexelDensity density) const {
    AtlasOptions options;
    options.pageSize = 128;
    options.density = density;
    return WithTexelDensity(mesh, MakeRadiosityAtlas(mesh, tree, options), solution, options);
  }
  double Error(const RadiosityAtlas& atlas) const {
    return RelativeError(
        ErrorsOfCharts(mesh, atlas, MakeLightMap(mesh, atlas, solution), solution));
  }
};

TEST(TexelDensity, FollowsTheErrorWithAsManyTexels) {
  const std::vector<double> densities =
      DensitiesByError({{1, 64, 100}, {1, 1, 1}, {2, 4, 9}, {0, 0, 0}});
  EXPECT_NEAR(densities[0] / densities[1], 2, 1e-6);
  EXPECT_NEAR(densities[2] / densities[1], std::pow(2, 1. / 6), 1e-6);
  EXPECT_NEAR(
      densities[0] * densities[0] + densities[1] * densities[1] + 2 * densities[2] * densities[2],
      4, 1e-6);
  // Never more than four times as many, nor less than a quarter.
  const std::vector<double> apart = DensitiesByError({{1, 1e9, 1}, {99, 0, 1}});
  EXPECT_NEAR(apart[0], 4, 1e-6);
  EXPECT_GE(apart[1], 0.25);
}

TEST(TexelDensity, LightThatVariesGetsFinerTexels) {
  const EvenAndWaves planes;
  const RadiosityAtlas even = planes.Atlas(TexelDensity::Uniform);
  const RadiosityAtlas followed = planes.Atlas(TexelDensity::Illumination);
  EXPECT_EQ(followed.pages, 1);
  EXPECT_LT(followed.utilisation, 1);
  EXPECT_LT(planes.Error(followed), 0.8 * planes.Error(even));

  // Charts and their places in the plane are as they were.
  ASSERT_EQ(followed.set.places.size(), even.set.places.size());
  EXPECT_EQ(followed.set.places[7][1].x, even.set.places[7][1].x);
}

TEST(TexelDensity, EvenLightLeavesEvenTexels) {
  EvenAndWaves planes;
  for (Spectrum& light : planes.solution.irradiance) light = Spectrum(0.f);
  const RadiosityAtlas even = planes.Atlas(TexelDensity::Uniform);
  const RadiosityAtlas followed = planes.Atlas(TexelDensity::Illumination);
  EXPECT_EQ(followed.textureCoords[3][0].x, even.textureCoords[3][0].x);
}

}  // namespace
}  // namespace lambert
