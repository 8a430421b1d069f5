// Sheets whose sides differ in light and in material.
#include <gtest/gtest.h>

#include "Radiosity/Testing/Unit/SolverScenes.h"
#include "Reference/Core/SolutionError.h"

namespace lambert {
namespace {

using testing::AddQuad;
using testing::SolvedScene;

constexpr float kWhite = 0.8f, kGrey = 0.2f, kWalls = 0.5f;

/// A closed room of 2 m x 1 m x 1 m, parted at x = 1 by a sheet: one face with two sides that
/// reflect alike, or doubled, white toward x < 1 and grey beyond; the parts are lit from below by
/// floors of exitance `left` and `right`.
Scene PartedRoom(bool isDoubled, float left, float right) {
  Scene scene;
  TriangleMesh& mesh = scene.mesh;
  const Vec3f x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const Spectrum walls(kWalls), dark(0.f);
  for (const float begin : {0.f, 1.f}) {
    const Vec3f low = x * begin;
    const int32_t id = begin > 0 ? 8 : 0;
    AddQuad(&mesh, low, x, y, dark, Spectrum(begin > 0 ? right : left), 1, id);
    AddQuad(&mesh, low + z, y, x, walls, dark, 1, id + 1);
    AddQuad(&mesh, low, z, x, walls, dark, 1, id + 2);
    AddQuad(&mesh, low + y, x, z, walls, dark, 1, id + 3);
  }
  AddQuad(&mesh, {}, y, z, walls, dark, 1, 4);
  AddQuad(&mesh, x * 2, z, y, walls, dark, 1, 12);
  AddQuad(&mesh, x, z, y, Spectrum(kWhite), dark, 1, 16, 1);
  if (isDoubled) AddQuad(&mesh, x, y, z, Spectrum(kGrey), dark, 1, 17, 2);
  testing::CompleteTables(&scene);
  return scene;
}

/// Means over the side of the sheet at x = 1 that looks along `n`.
struct SideLight {
  double irradiance = 0, radiosity = 0, area = 0;
};
SideLight OnSheet(const SolvedScene& solved, const Vec3f& n) {
  const TriangleMesh& mesh = solved.solution.mesh;
  SideLight side;
  for (int64_t t = 0; t < mesh.FaceCount(); ++t) {
    const Vec3f middle = (mesh.Corner(t, 0) + mesh.Corner(t, 1) + mesh.Corner(t, 2)) / 3;
    if (std::abs(middle.x - 1) > 1e-4f || Dot(mesh.FrontNormal(t), n) < 0.99f) continue;
    const double third = double(mesh.Area(t)) / 3;
    for (const int32_t p : mesh.triangles[size_t(t)]) {
      side.irradiance += third * double(solved.solution.irradiance[size_t(p)].g);
      side.radiosity += third * double(solved.solution.radiosity[size_t(p)].g);
    }
    side.area += 3 * third;
  }
  side.irradiance /= side.area;
  side.radiosity /= side.area;
  return side;
}

constexpr double kWanted = 0.05;

class SheetSidesTest : public ::testing::TestWithParam<bool> {
 protected:
  /// What the sheet reflects toward x > 1.
  static double Behind() { return double(GetParam() ? kGrey : kWhite); }
};

// Each part is a room of its own: the same light as in one without the other part, four times as
// much to the right. The mean over a side is nearer to the truth than the points that are asked to
// be within the wanted error.
TEST_P(SheetSidesTest, EachSideHasItsOwnLightAndMaterial) {
  const SolvedScene solved = testing::SolveScene(PartedRoom(GetParam(), 1, 4), kWanted);
  EXPECT_LE(MeasureSolutionError(solved.scene, solved.solution).Counting(), 1.1 * kWanted);
  const SideLight left = OnSheet(solved, {-1, 0, 0}), right = OnSheet(solved, {1, 0, 0});
  EXPECT_NEAR(left.area, 1, 1e-4);  // Once each, not once for either face.
  EXPECT_NEAR(right.area, 1, 1e-4);
  EXPECT_NEAR(left.radiosity / left.irradiance, kWhite, 1e-3);
  EXPECT_NEAR(right.radiosity / right.irradiance, Behind(), 1e-3);

  // Of two equal rooms under equal floors a white sheet lights its own more than a grey one.
  const double ratio = right.irradiance / left.irradiance / 4;
  if (GetParam()) {
    EXPECT_LT(ratio, 1);
    EXPECT_GT(ratio, 0.7);
  } else {
    EXPECT_NEAR(ratio, 1, kWanted);
  }

  // What is emitted is absorbed, in either part by its own surfaces; escape and cover are found by
  // 32768 rays each: 1 % of noise.
  const SolverStatistics& s = solved.statistics;
  for (int band = 0; band < 3; ++band) {
    EXPECT_NEAR(s.emitted[band], 5, 1e-4);
    EXPECT_NEAR(s.absorbed[band] / s.emitted[band], 1, 0.02);
    EXPECT_NEAR(s.covered[band], 0, 0.01 * s.emitted[band]);
  }
}

TEST_P(SheetSidesTest, TheDarkSideStaysDark) {
  const SolvedScene solved = testing::SolveScene(PartedRoom(GetParam(), 1, 0), kWanted);
  for (int64_t t = 0; t < solved.solution.mesh.FaceCount(); ++t) {
    for (const int32_t p : solved.solution.mesh.triangles[size_t(t)]) {
      if (solved.solution.mesh.Corner(t, 0).x <= 1 && solved.solution.mesh.Corner(t, 1).x <= 1 &&
          solved.solution.mesh.Corner(t, 2).x <= 1) {
        continue;
      }
      // A few rays pass within 1e-5 of the scene under the sheet's border.
      ASSERT_LE(double(solved.solution.irradiance[size_t(p)].g), 0.005);
    }
  }
  EXPECT_GT(OnSheet(solved, {-1, 0, 0}).irradiance, 0.2);
  EXPECT_LE(MeasureSolutionError(solved.scene, solved.solution).Counting(), 1.1 * kWanted);
}
INSTANTIATE_TEST_SUITE_P(Sheets, SheetSidesTest, ::testing::Bool(),
                         [](const auto& sheet) { return sheet.param ? "Doubled" : "OneFace"; });

}  // namespace
}  // namespace lambert
