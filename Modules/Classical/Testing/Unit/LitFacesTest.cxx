// Which sides light reaches, where it is dim.
#include "Classical/Core/LitFaces.h"

#include <gtest/gtest.h>

#include "Classical/Core/MatrixRadiosity.h"
#include "Common/Testing/TestScenes.h"

namespace lambert {
namespace {

/// A black wall in n x n x 2 triangles behind a lamp that faces away from it, toward a reflector:
/// all of the wall's light is reflected. The wall's faces come first.
Scene WallBehindALamp(int n) {
  Scene scene;
  testing::AddQuad(&scene.mesh, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, Spectrum(0.f), Spectrum(0.f), n);
  testing::AddQuad(&scene.mesh, {-0.1f, -0.1f, 0.3f}, {0.2f, 0, 0}, {0, 0.2f, 0}, Spectrum(0.f),
                   Spectrum(10.f));
  testing::AddQuad(&scene.mesh, {-0.5f, -0.5f, 1.5f}, {0, 1, 0}, {1, 0, 0}, Spectrum(0.5f));
  testing::CompleteTables(&scene);
  return scene;
}

std::vector<uint8_t> LitFaces(const Scene& scene, double elementSize) {
  const RayScene rays(scene.mesh);
  int64_t cast = 0;
  return FindLitFaces(scene, MakeUniformMesh(scene, elementSize), rays, SourceLight(scene, rays),
                      &cast);
}

// In the corners the reflector is 4 % of what a triangle sees, so that 16 paths miss it every
// second time, and 128 once in 200: but for a few of the corners' triangles all are found.
TEST(LitFaces, SmallFacesInDimLightAreFound) {
  const Scene scene = WallBehindALamp(20);
  const std::vector<uint8_t> lit = LitFaces(scene, 1);
  int dark = 0;
  for (size_t face = 0; face < 800; ++face) dark += lit[face] == 0 ? 1 : 0;
  EXPECT_LE(dark, 4);
  // The lamp's front, the reflector's; nothing reaches the backs of the wall and of the reflector.
  for (size_t face = 0; face < lit.size(); ++face) EXPECT_EQ(lit[face] & 2, 0) << face;
  for (size_t face = 800; face < lit.size(); ++face) EXPECT_EQ(lit[face] & 1, 1) << face;
}

// A lone pair of triangles that sees light at 2 % of its paths only is told of it by rays from
// there: its own 16 paths miss it three times in four.
TEST(LitFaces, RaysFromLitSidesFindFacesApart) {
  for (int offset = 0; offset < 8; ++offset) {
    Scene scene = WallBehindALamp(1);
    const float x = 1.2f + 0.05f * float(offset);
    testing::AddQuad(&scene.mesh, {x, 0, 0}, {0.4f, 0, 0}, {0, 0.4f, 0}, Spectrum(0.5f));
    testing::CompleteTables(&scene);
    const std::vector<uint8_t> lit = LitFaces(scene, 1);
    EXPECT_EQ(lit[lit.size() - 1], 1) << offset;
    EXPECT_EQ(lit[lit.size() - 2], 1) << offset;
  }
}

// A fine wall receives what a coarse one does. Elements of a quarter of the wall's least distance
// from the reflector, cut otherwise: 1 %.
TEST(LitFaces, AWallInManyPiecesIsAsBright) {
  const auto meanIrradiance = [](int n) {
    const Scene scene = WallBehindALamp(n);
    MatrixRadiosityOptions options;
    options.elementSize = 0.15;
    const RadiositySolution solution = SolveMatrixRadiosity(scene, options);
    double sum = 0, area = 0;
    for (size_t face = 0; face < solution.mesh.triangles.size(); ++face) {
      if (solution.inputFaceId[face] >= 2 * n * n || solution.side[face] != kFront) continue;
      const double faceArea = double(solution.mesh.Area(int64_t(face)));
      for (const int32_t p : solution.mesh.triangles[face]) {
        sum += faceArea * double(solution.irradiance[size_t(p)].g) / 3;
      }
      area += faceArea;
    }
    EXPECT_NEAR(area, 4, 1e-3);
    return sum / area;
  };
  const double coarse = meanIrradiance(1);
  EXPECT_GT(coarse, 0);
  EXPECT_NEAR(meanIrradiance(20), coarse, 0.01 * coarse);
}

}  // namespace
}  // namespace lambert
