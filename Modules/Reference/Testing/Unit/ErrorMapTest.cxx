// Where the error of solutions sits whose error is known.
#include "Reference/Core/ErrorMap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Common/Core/Error.h"
#include "Common/Testing/SolutionFixtures.h"
#include "Common/Testing/TestScenes.h"

namespace lambert {
namespace {

using namespace testing;

constexpr float kPi = 3.14159265f;

/// A black box in the open under a sky of radiance 1 / pi: its outside receives 1 W/m2 everywhere,
/// by every path, and its inside nothing.
Scene BoxUnderSky() {
  Scene scene;
  AddBox(&scene.mesh, {0, 0, 0}, {1, 1, 1}, BoxMaterials(0), false, 2);
  Light sky;
  sky.type = LightType::Sky;
  sky.intensity = Spectrum(1 / kPi);
  scene.lights.push_back(sky);
  CompleteTables(&scene);
  return scene;
}

TEST(ErrorMap, TakesTheFacesNormalsWhereASolutionHasNone) {
  const Scene scene = BoxUnderSky();
  RadiositySolution solution = FlatSolution(scene, 1, 2, false);
  solution.mesh.normals.clear();
  const ErrorMap map = MapError(scene, solution, {64, 1});
  for (const float error : map.relativeError) EXPECT_NEAR(error, 0, 1e-5);
}

TEST(ErrorMap, ShowsWhatWasAddedWhereItWasAdded) {
  // Right but for one half of the box, too bright by a tenth, and one triangle, too dark by three.
  const Scene scene = BoxUnderSky();
  RadiositySolution solution = FlatSolution(scene, 1, 2, false);
  const TriangleMesh& mesh = solution.mesh;
  for (size_t point = 0; point < mesh.positions.size(); ++point) {
    if (mesh.positions[point].x > 0.5f) solution.irradiance[point] = Spectrum(1.1f);
  }
  const int64_t dark = 1;
  for (const int32_t corner : mesh.triangles[dark]) {
    solution.irradiance[size_t(corner)] = Spectrum(0.7f);
  }

  const ErrorMap map = MapError(scene, solution, {256, 1});
  ASSERT_EQ(map.relativeError.size(), mesh.triangles.size());
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    double delivered = 0;
    for (const int32_t corner : mesh.triangles[size_t(face)]) {
      delivered += double(solution.irradiance[size_t(corner)].Mean()) / 3;
    }
    EXPECT_NEAR(map.reference[size_t(face)].irradiance.Mean(), 1, 1e-4);  // Floats.
    EXPECT_NEAR(map.relativeError[size_t(face)], delivered - 1, 1e-4);
  }
  EXPECT_NEAR(map.relativeError[dark], -0.3, 1e-4);
}

TEST(ErrorMap, CountsTheDarkAgainstTheMeanLight) {
  const Scene scene = BoxUnderSky();
  const RadiositySolution solution = FlatSolution(scene, 0.5f, 1, true);
  const ErrorMap map = MapError(scene, solution, {64, 1});
  for (size_t face = 0; face < solution.side.size(); ++face) {
    // Outside half of the light is missing; inside is half as much too much as there is outside,
    // against a mean of 1/2 W/m2 over both.
    EXPECT_NEAR(map.relativeError[face], solution.side[face] == kFront ? -0.5 : 1, 1e-4);
  }
}

TEST(ErrorMap, LeavesLampsOut) {
  Scene scene = BoxUnderSky();
  for (size_t face = 0; face < 8; ++face) {
    scene.mesh.emittance[face] = Spectrum(1);
    scene.mesh.faceFlags[face] |= kEmitsFront;
  }
  const RadiositySolution solution = FlatSolution(scene, 0, 1, false);
  const ErrorMap map = MapError(scene, solution, {64, 1});
  // Nothing is delivered: all is missing, but on the lamps.
  for (size_t face = 0; face < map.relativeError.size(); ++face) {
    EXPECT_NEAR(map.relativeError[face], solution.inputFaceId[face] < 8 ? 0 : -1, 1e-4);
  }
}

TEST(ErrorMap, NoneWithoutLight) {
  Scene scene = BoxUnderSky();
  scene.lights.clear();
  for (const float error : MapError(scene, FlatSolution(scene, 0, 1), {16, 1}).relativeError) {
    EXPECT_EQ(error, 0);
  }
}

TEST(ErrorMap, RefusesAnotherScenesSolution) {
  const Scene scene = BoxUnderSky();
  RadiositySolution elsewhere = FlatSolution(scene, 1, 1);
  for (Vec3f& position : elsewhere.mesh.positions) position.x += 0.1f;
  EXPECT_THROW(MapError(scene, elsewhere, {16, 1}), Error);
  RadiositySolution other = FlatSolution(scene, 1, 1);
  other.inputFaceId.front() = scene.mesh.FaceCount();
  EXPECT_THROW(MapError(scene, other, {16, 1}), Error);
  EXPECT_THROW(MapError(scene, FlatSolution(scene, 1, 1), {1, 1}), Error);
  EXPECT_THROW(MapError(scene, FlatSolution(scene, 1, 1), {16, 1},
                        [](double, const char*) { return false; }),
               Cancelled);
}

}  // namespace
}  // namespace lambert
