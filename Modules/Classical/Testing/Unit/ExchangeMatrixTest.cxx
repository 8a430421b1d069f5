// Form factors of whole scenes, with what stands in the way.
#include "Classical/Core/ExchangeMatrix.h"

#include <gtest/gtest.h>

#include "Classical/Core/LitFaces.h"
#include "Classical/Core/MatrixRadiosity.h"
#include "Common/Core/Error.h"
#include "Common/Testing/TestScenes.h"

namespace lambert {
namespace {

/// All element sides of a scene, lit or not, and their matrix.
struct Assembled {
  Assembled(const Scene& scene, double elementSize, const ExchangeMatrixOptions& options = {})
      : mesh(MakeUniformMesh(scene, elementSize)),
        sides(CollectElementSides(scene, mesh,
                                  std::vector<uint8_t>(scene.mesh.triangles.size(), uint8_t(1)))),
        rays(scene.mesh),
        shafts(scene.mesh, rays.Epsilon(), sides.GroupPoints(mesh)),
        matrix(sides, shafts, rays, options) {}

  /// From the faces [from, from + 2) of the scene to [to, to + 2).
  double FormFactor(int32_t from, int32_t to) const {
    double sum = 0, area = 0;
    for (int32_t i = 0; i < int32_t(sides.Count()); ++i) {
      if (mesh.face[size_t(sides.key[size_t(i)] / 2)] / 2 != from / 2) continue;
      area += double(sides.triangles[size_t(i)].area);
      for (int32_t j = 0; j < int32_t(sides.Count()); ++j) {
        if (mesh.face[size_t(sides.key[size_t(j)] / 2)] / 2 != to / 2 || i == j) continue;
        sum += double(matrix.FormFactor(i, j)) * double(sides.triangles[size_t(i)].area);
      }
    }
    return sum / area;
  }

  UniformMesh mesh;
  ElementSides sides;
  RayScene rays;
  ShaftBlockers shafts;
  ExchangeMatrix matrix;
};

// A small square between two unit squares; both of its sides block. Every pair of elements takes
// four rays, 128 x 128 pairs: a hundredth of the part that is in half shadow.
TEST(ExchangeMatrix, SquaresWithABlockerBetween) {
  const auto blocked = [](float x, float y) {
    Scene scene;
    testing::AddQuad(&scene.mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.5f));
    testing::AddQuad(&scene.mesh, {0, 0, 1}, {0, 1, 0}, {1, 0, 0}, Spectrum(0.5f));
    testing::AddQuad(&scene.mesh, {x, y, 0.5f}, {0, 0.5f, 0}, {0.5f, 0, 0}, Spectrum(0.5f));
    return Assembled(scene, 0.18);
  };
  const Assembled corner = blocked(0, 0), centre = blocked(0.25f, 0.25f);
  EXPECT_NEAR(corner.FormFactor(0, 2), 0.1498686718, 0.002);
  EXPECT_NEAR(centre.FormFactor(0, 2), 0.0995062946, 0.002);
  // Nothing stands between the bottom and the blocker's lower side.
  EXPECT_NEAR(corner.FormFactor(0, 4), 0.1038133209, 1e-4);
}

// Rows of a closed cube sum to 1, to 1e-3, never more; reciprocity by construction; and with one
// value a face, the equations of the six faces have the known solution.
TEST(ExchangeMatrix, CubeOfSixFaces) {
  const Assembled cube(testing::FurnaceCube(0.5f), 0.3);
  for (const float sum : cube.matrix.RowSums()) {
    EXPECT_LE(sum, 1 + 1e-6f);
    EXPECT_GE(sum, 1 - 1e-3f);
  }
  for (int32_t i = 0; i < int32_t(cube.sides.Count()); i += 7) {
    for (int32_t j = 0; j < int32_t(cube.sides.Count()); j += 5) {
      if (i == j) continue;
      const double forth =
          double(cube.sides.triangles[size_t(i)].area) * double(cube.matrix.FormFactor(i, j));
      const double back =
          double(cube.sides.triangles[size_t(j)].area) * double(cube.matrix.FormFactor(j, i));
      EXPECT_NEAR(forth, back, 1e-6 * forth);
    }
  }
  for (const auto& [rho, lamp, opposite, side] :
       {std::array<double, 4>{0.5, 1.0909090981, 0.1817458261, 0.1818362689},
        std::array<double, 4>{0.8, 1.5517241536, 0.6895510707, 0.6896811939}}) {
    std::array<double, 6> radiosity{};
    for (int sweep = 0; sweep < 100; ++sweep) {
      for (int32_t i = 0; i < 6; ++i) {
        double irradiance = 0;
        for (int32_t j = 0; j < 6; ++j) {
          if (i != j) irradiance += cube.FormFactor(2 * i, 2 * j) * radiosity[size_t(j)];
        }
        radiosity[size_t(i)] = (i == testing::kFloor ? 1 : 0) + rho * irradiance;
      }
      if (sweep == 30 && rho < 0.6) break;
    }
    // Rows that miss 1 by 5e-4 lose that part of the light, 1 / (1 - rho) times.
    const double tolerance = 5e-4 / (1 - rho);
    EXPECT_NEAR(radiosity[testing::kFloor], lamp, tolerance * lamp);
    EXPECT_NEAR(radiosity[testing::kCeiling], opposite, tolerance * lamp);
    EXPECT_NEAR(radiosity[testing::kMinusX], side, tolerance * lamp);
  }
}

// Two rows of four hundred elements would take 4e5 entries of 8 bytes.
TEST(ExchangeMatrix, RefusesWhatDoesNotFit) {
  MatrixRadiosityOptions options;
  options.elementSize = 0.05;
  options.memoryLimit = 1 << 20;
  try {
    SolveMatrixRadiosity(testing::FurnaceCube(0.5f), options);
    FAIL();
  } catch (const Error& error) {
    const std::string sentence = error.what();
    EXPECT_NE(sentence.find("12288 element sides"), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("bytes where the limit is 1048576"), std::string::npos) << sentence;
  }
  options.memoryLimit = int64_t(4) << 30;
  options.elementSize = 0.5;
  for (const int rays : {0, 17}) {
    options.visibilityRays = rays;
    EXPECT_THROW(SolveMatrixRadiosity(testing::FurnaceCube(0.5f), options), Error);
  }
  options.visibilityRays = 4;
  options.tolerance = 0;
  EXPECT_THROW(SolveMatrixRadiosity(testing::FurnaceCube(0.5f), options), Error);
  options.tolerance = 1e-4;
  EXPECT_THROW(SolveMatrixRadiosity(testing::FurnaceCube(0.5f), options, nullptr,
                                    [](double, const char*) { return false; }),
               Cancelled);
}

}  // namespace
}  // namespace lambert
