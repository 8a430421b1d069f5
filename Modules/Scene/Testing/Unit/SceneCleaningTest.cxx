#include "Scene/Core/SceneCleaning.h"

#include <gtest/gtest.h>

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"
#include "Scene/Core/SceneLimits.h"
#include "Scene/Testing/Unit/SmallMeshes.h"

namespace lambert {
namespace {

using namespace testing;

CleaningOptions NoSteps() {
  CleaningOptions none;
  none.weld = none.removeZeroArea = none.removeRepeated = none.orient = none.fixEmitters = false;
  return none;
}

/// Power that leaves towards the upper (first) and the lower (second) half space, W.
std::pair<double, double> EmittedUpAndDown(const TriangleMesh& mesh) {
  std::pair<double, double> power;
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    const double m = double(mesh.emittance[size_t(face)].g) * mesh.Area(face);
    const bool up = mesh.FrontNormal(face).z > 0;
    if (mesh.Emits(face, kFront)) (up ? power.first : power.second) += m;
    if (mesh.Emits(face, kBack)) (up ? power.second : power.first) += m;
  }
  return power;
}

TEST(SceneCleaning, WeldJoinsPointsThatAgree) {
  // Two triangles with points of their own, and a point of no face.
  TriangleMesh soup =
      MakeMesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-0.f, 0, 0}, {1, 1, 0}, {0, 1, 0}, {9, 9, 9}},
               {{0, 1, 2}, {3, 4, 5}});
  CleaningReport report;
  Scene scene = AssembleScene(MakeAssembly(soup), {}, &report);
  EXPECT_EQ(report.pointsWelded, 2);
  EXPECT_EQ(report.pointsUnused, 1);
  EXPECT_EQ(scene.mesh.PointCount(), 4);

  scene = AssembleScene(MakeAssembly(soup), NoSteps(), &report);
  EXPECT_EQ(report.pointsWelded, 0);
  EXPECT_EQ(scene.mesh.PointCount(), 6);

  // Points that differ in their uv stay apart; connectivity looks through the seam.
  soup.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 0.5f}, {1, 1}, {0, 1}, {0, 0}};
  scene = AssembleScene(MakeAssembly(soup), {}, &report);
  EXPECT_EQ(report.pointsWelded, 1);
  EXPECT_EQ(report.openEdges, 4);
  EXPECT_EQ(report.pieces, 1);
}

TEST(SceneCleaning, DropsTrianglesWithoutArea) {
  TriangleMesh mesh = MakeSquare();
  TriangleMesh slivers =
      MakeMesh({{0, 0, 1}, {1, 0, 1}, {2, 0, 1}, {0, 0, 1}}, {{0, 1, 2}, {0, 3, 1}, {1, 1, 1}});
  Append(slivers, &mesh);
  CleaningReport report;
  Scene scene = AssembleScene(MakeAssembly(mesh), {}, &report);
  EXPECT_EQ(report.zeroAreaTriangles, 3);
  EXPECT_EQ(scene.mesh.FaceCount(), 2);

  scene = AssembleScene(MakeAssembly(mesh), NoSteps(), &report);
  EXPECT_EQ(report.zeroAreaTriangles, 0);
  EXPECT_EQ(scene.mesh.FaceCount(), 5);
  for (const Vec3f& normal : scene.mesh.normals) EXPECT_NEAR(Length(normal), 1, 1e-6);
}

TEST(SceneCleaning, KeepsThinTriangles) {
  // 1000:1 and 1e5:1 are thin, not without area.
  for (const float height : {1e-3f, 1e-5f}) {
    const TriangleMesh sliver = MakeMesh({{0, 0, 0}, {1, 0, 0}, {0.5f, height, 0}}, {{0, 1, 2}});
    EXPECT_EQ(AssembleScene(MakeAssembly(sliver)).mesh.FaceCount(), 1);
  }
}

TEST(SceneCleaning, DropsRepeatedTriangles) {
  TriangleMesh mesh = MakeCube();
  const TriangleMesh copy = mesh;
  Append(copy, &mesh);
  TriangleMesh reversed = copy;
  for (size_t face = 0; face < 12; ++face) FlipWinding(&reversed, face);
  reversed.materialId.assign(12, 1);
  Append(reversed, &mesh);
  SceneAssembly assembly = MakeAssembly(mesh);
  assembly.materials.emplace_back();

  CleaningReport report;
  Scene scene = AssembleScene(assembly, {}, &report);
  EXPECT_EQ(report.repeatedTriangles, 24);
  EXPECT_EQ(report.repeatedOtherMaterial, 12);
  EXPECT_EQ(scene.mesh.FaceCount(), 12);
  EXPECT_EQ(scene.mesh.sourceCellId.back(), 11);
  EXPECT_EQ(scene.mesh.materialId, std::vector<int32_t>(12, 0));
  EXPECT_EQ(report.facesRewound, 0);
  EXPECT_EQ(report.openEdges, 0);

  scene = AssembleScene(assembly, NoSteps(), &report);
  EXPECT_EQ(report.repeatedTriangles, 0);
  EXPECT_EQ(scene.mesh.FaceCount(), 36);
  EXPECT_EQ(report.nonManifoldEdges, 18);
}

TEST(SceneCleaning, DropsRepeatedPolygonsCutAlongOtherDiagonals) {
  const std::vector<Vec3f> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.1f}, {0, 1, 0}};
  TriangleMesh mesh = MakeMesh(corners, {{0, 1, 2}, {0, 2, 3}});
  Append(MakeMesh(corners, {{1, 0, 3}, {1, 3, 2}}), &mesh);
  mesh.sourceCellId = {0, 0, 1, 1};
  CleaningReport report;
  Scene scene = AssembleScene(MakeAssembly(mesh), {}, &report);
  EXPECT_EQ(report.repeatedTriangles, 2);
  EXPECT_EQ(scene.mesh.sourceCellId, std::vector<int64_t>({0, 0}));

  // Four triangles that are no polygons close a flat tetrahedron: they stay.
  mesh.sourceCellId = {0, 1, 2, 3};
  scene = AssembleScene(MakeAssembly(mesh), {}, &report);
  EXPECT_EQ(report.repeatedTriangles, 0);
  EXPECT_EQ(report.openEdges, 0);
}

TEST(SceneCleaning, EmittersKeepTheirSide) {
  for (const bool down : {false, true}) {
    for (const bool darkCopyFirst : {false, true}) {
      for (const bool darkCopyReversed : {false, true}) {
        TriangleMesh lamp = MakeSquare(), dark = MakeSquare();
        MakeEmit(&lamp);
        for (size_t face = 0; face < 2; ++face) {
          if (down) FlipWinding(&lamp, face);
          if (darkCopyReversed) FlipWinding(&dark, face);
        }
        TriangleMesh mesh = darkCopyFirst ? dark : lamp;
        Append(darkCopyFirst ? lamp : dark, &mesh);
        const Scene scene = AssembleScene(MakeAssembly(mesh));
        EXPECT_EQ(scene.mesh.FaceCount(), 2);
        const auto [up, under] = EmittedUpAndDown(scene.mesh);
        EXPECT_FLOAT_EQ(float(up), down ? 0 : 1);
        EXPECT_FLOAT_EQ(float(under), down ? 1 : 0);
      }
    }
  }
}

TEST(SceneCleaning, OppositeEmittersBecomeOneThatEmitsFromBothSides) {
  TriangleMesh mesh = MakeSquare();
  MakeEmit(&mesh);
  TriangleMesh reversed = mesh;
  FlipWinding(&reversed, 0);
  FlipWinding(&reversed, 1);
  Append(reversed, &mesh);
  Scene scene = AssembleScene(MakeAssembly(mesh));
  EXPECT_EQ(scene.mesh.FaceCount(), 2);
  EXPECT_EQ(EmittedUpAndDown(scene.mesh), std::make_pair(1.0, 1.0));

  // Of two strengths, one face cannot tell: both stay.
  mesh.emittance[2] = mesh.emittance[3] = Spectrum(5.f);
  CleaningReport report;
  scene = AssembleScene(MakeAssembly(mesh), {}, &report);
  EXPECT_EQ(report.repeatedTriangles, 0);
  EXPECT_EQ(EmittedUpAndDown(scene.mesh), std::make_pair(1.0, 5.0));
}

TEST(SceneCleaning, WindsPiecesConsistently) {
  // A third of a cylinder's faces reversed: the majority of the file stands.
  const TriangleMesh upright = MakeCylinder(24);
  TriangleMesh mixed = upright;
  Random random(7);
  int64_t flipped = 0;
  for (size_t face = 0; face < mixed.triangles.size(); ++face) {
    if (random.Uniform() > 0.33f) continue;
    FlipWinding(&mixed, face);
    ++flipped;
  }
  CleaningReport report;
  const Scene expected = AssembleScene(MakeAssembly(upright), {}, &report);
  EXPECT_EQ(report.facesRewound, 0);
  const Scene scene = AssembleScene(MakeAssembly(mixed), {}, &report);
  EXPECT_EQ(report.facesRewound, flipped);
  EXPECT_EQ(report.nonOrientablePieces, 0);
  ASSERT_EQ(scene.mesh.FaceCount(), expected.mesh.FaceCount());
  for (int64_t face = 0; face < scene.mesh.FaceCount(); ++face) {
    const bool wasFlipped = mixed.triangles[size_t(face)] != upright.triangles[size_t(face)];
    EXPECT_EQ(scene.mesh.VectorArea(face), expected.mesh.VectorArea(face)) << face;
    EXPECT_EQ((scene.mesh.faceFlags[size_t(face)] & kRewound) != 0, wasFlipped) << face;
  }

  AssembleScene(MakeAssembly(mixed), NoSteps(), &report);
  EXPECT_EQ(report.facesRewound, 0);
}

TEST(SceneCleaning, RewoundEmittersEmitToTheSameSide) {
  // A flat strip of four triangles, front up, the last one wound down: its light goes on going
  // down.
  TriangleMesh strip = MakeMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}, {1, 2, 0}},
                                {{0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 4, 5}});
  MakeEmit(&strip);
  CleaningReport report;
  const Scene scene = AssembleScene(MakeAssembly(strip), {}, &report);
  EXPECT_EQ(report.facesRewound, 1);
  EXPECT_GT(scene.mesh.FrontNormal(3).z, 0);
  EXPECT_EQ(scene.mesh.faceFlags[3], kEmitsBack | kRewound);
  EXPECT_EQ(EmittedUpAndDown(scene.mesh), std::make_pair(1.5, 0.5));
}

TEST(SceneCleaning, CutsMoebiusStrip) {
  CleaningReport report;
  const Scene scene = AssembleScene(MakeAssembly(MakeMoebiusStrip(32)), {}, &report);
  EXPECT_EQ(report.nonOrientablePieces, 1);
  EXPECT_EQ(report.pieces, 1);
  EXPECT_EQ(scene.mesh.FaceCount(), 64);
}

TEST(SceneCleaning, CutsEdgesOfThreeFaces) {
  // Three leaves of a book on one spine.
  const TriangleMesh book = MakeMesh({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}},
                                     {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
  CleaningReport report;
  AssembleScene(MakeAssembly(book), {}, &report);
  EXPECT_EQ(report.nonManifoldEdges, 1);
  EXPECT_EQ(report.openEdges, 6);
  EXPECT_EQ(report.pieces, 3);
  EXPECT_EQ(report.facesRewound, 0);
}

class InvertedLamp : public ::testing::Test {
 protected:
  void SetUp() override {
    lamp_ = MakeCube();
    for (size_t face = 0; face < 12; ++face) FlipWinding(&lamp_, face);
    MakeEmit(&lamp_);
    alone_ = lamp_;
    Append(MakeCube(0.5f, {3, 0, 0}), &lamp_);
  }
  /// Faces whose light leaves the unit cube about the origin.
  static int64_t FacesEmittingOutward(const Scene& scene) {
    int64_t count = 0;
    for (int64_t face = 0; face < 12; ++face) {
      const bool frontIsOutward = Dot(scene.mesh.FrontNormal(face), scene.mesh.Corner(face, 0)) > 0;
      count += scene.mesh.Emits(face, frontIsOutward ? kFront : kBack);
    }
    return count;
  }
  TriangleMesh lamp_;  ///< and a dark cube beside it, faces 12 to 23
  TriangleMesh alone_;
  CleaningReport report_;
};

TEST_F(InvertedLamp, IsTurned) {
  const Scene scene = AssembleScene(MakeAssembly(lamp_), {}, &report_);
  EXPECT_EQ(FacesEmittingOutward(scene), 12);
  EXPECT_EQ(report_.invertedEmitters, 1);
  ASSERT_EQ(report_.warnings.size(), 1u);
  EXPECT_NE(report_.warnings[0].find("'paint'"), std::string::npos);

  CleaningOptions off;
  off.fixEmitters = false;
  EXPECT_EQ(FacesEmittingOutward(AssembleScene(MakeAssembly(lamp_), off, &report_)), 0);
  EXPECT_EQ(report_.invertedEmitters, 0);
}

TEST_F(InvertedLamp, IsTurnedWhereFacesAreNotRewound) {
  CleaningOptions options;
  options.orient = false;
  for (size_t face = 0; face < 6; ++face) FlipWinding(&lamp_, face);
  EXPECT_EQ(FacesEmittingOutward(AssembleScene(MakeAssembly(lamp_), options, &report_)), 12);
}

TEST_F(InvertedLamp, IsAFurnaceWhereThereIsNothingElse) {
  const Scene scene = AssembleScene(MakeAssembly(alone_), {}, &report_);
  EXPECT_EQ(FacesEmittingOutward(scene), 0);
  EXPECT_EQ(report_.invertedEmitters, 0);
}

TEST_F(InvertedLamp, WoundOutwardStays) {
  for (size_t face = 0; face < 12; ++face) FlipWinding(&lamp_, face);
  EXPECT_EQ(FacesEmittingOutward(AssembleScene(MakeAssembly(lamp_), {}, &report_)), 12);
  EXPECT_EQ(report_.invertedEmitters, 0);
}

TEST_F(InvertedLamp, IsARoomWithSomethingInside) {
  SceneAssembly room = MakeAssembly(lamp_);
  room.meshes.push_back(MakeCube(0.1f));
  room.parts.emplace_back();
  room.parts.back().meshId = 1;
  EXPECT_EQ(FacesEmittingOutward(AssembleScene(room, {}, &report_)), 0);

  // Beside it: nothing is inside.
  room.parts.back().objectToWorld[3] = 2;
  EXPECT_EQ(FacesEmittingOutward(AssembleScene(room, {}, &report_)), 12);

  // So is a light or a camera.
  SceneAssembly lit = MakeAssembly(lamp_);
  lit.lights.emplace_back();
  EXPECT_EQ(FacesEmittingOutward(AssembleScene(lit, {}, &report_)), 0);
  SceneAssembly seen = MakeAssembly(lamp_);
  seen.camera.emplace().position = {0.1, 0, 0};
  EXPECT_EQ(FacesEmittingOutward(AssembleScene(seen, {}, &report_)), 0);
}

TEST_F(InvertedLamp, IsARoomWhereOneWallEmits) {
  for (size_t face = 2; face < 12; ++face) {
    lamp_.emittance[face] = Spectrum(0.f);
    lamp_.faceFlags[face] = 0;
  }
  EXPECT_EQ(FacesEmittingOutward(AssembleScene(MakeAssembly(lamp_), {}, &report_)), 0);
}

TEST(SceneCleaning, CleansAMeshOnceForAllItsInstances) {
  TriangleMesh soup = MakeCube();
  Append(MakeCube(), &soup);
  SceneAssembly assembly = MakeAssembly(soup);
  assembly.parts.resize(1000);
  for (size_t i = 0; i < 1000; ++i) assembly.parts[i].objectToWorld[3] = 3.0 * double(i);
  CleaningReport report;
  const Scene scene = AssembleScene(assembly, {}, &report);
  EXPECT_EQ(report.pointsWelded, 8);
  EXPECT_EQ(report.repeatedTriangles, 12);
  EXPECT_EQ(report.normalsMade, 24);
  EXPECT_EQ(report.pieces, 1000);
  ASSERT_EQ(scene.mesh.FaceCount(), 12000);
  EXPECT_EQ(scene.mesh.PointCount(), 24000);
  for (int64_t face = 0; face < 12000; ++face) {
    EXPECT_EQ(scene.mesh.partId[size_t(face)], face / 12);
    EXPECT_EQ(scene.mesh.sourceCellId[size_t(face)], face % 12);
    EXPECT_NEAR(scene.mesh.Corner(face, 0).x, 3.f * float(face / 12), 0.51f);
  }
}

TEST(SceneCleaning, PlacesNormalsAndFrontsByTheMatrix) {
  // Mirrored in x, squashed in z: a front stays the front, a normal stays at right angles to its
  // face.
  TriangleMesh cylinder = MakeCylinder(64);
  MakeEmit(&cylinder);
  SceneAssembly assembly = MakeAssembly(cylinder);
  assembly.parts[0].objectToWorld = {-2, 0, 0, 5, 0, 2, 0, 0, 0, 0, 0.25, 0, 0, 0, 0, 1};
  CleaningReport report;
  const Scene scene = AssembleScene(assembly, {}, &report);
  EXPECT_EQ(report.invertedEmitters, 0);
  const Vec3f center(5, 0, 0.125f);
  for (int64_t face = 0; face < scene.mesh.FaceCount(); ++face) {
    const Vec3f normal = scene.mesh.FrontNormal(face);
    EXPECT_GT(Dot(normal, scene.mesh.Corner(face, 0) - center), 0) << face;
    EXPECT_EQ(scene.mesh.faceFlags[size_t(face)], kEmitsFront);
    for (const int32_t point : scene.mesh.triangles[size_t(face)]) {
      // Half of one of 64 sides is 2.8 degrees.
      EXPECT_GT(Dot(normal, scene.mesh.normals[size_t(point)]), std::cos(2.9 * kPi / 180)) << face;
    }
  }

  // A shear: the top of a cube keeps its normal, the sides lean.
  SceneAssembly sheared = MakeAssembly(MakeCube());
  sheared.parts[0].objectToWorld[2] = 1;
  const Scene leaning = AssembleScene(sheared);
  for (int64_t face = 0; face < 12; ++face) {
    for (const int32_t point : leaning.mesh.triangles[size_t(face)]) {
      EXPECT_GT(Dot(leaning.mesh.FrontNormal(face), leaning.mesh.normals[size_t(point)]), 0.99999f);
    }
  }
}

TEST(SceneCleaning, RefusesScenesWithoutArea) {
  const TriangleMesh flat = MakeMesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}});
  EXPECT_THROW(AssembleScene(MakeAssembly(flat)), Error);
  EXPECT_THROW(AssembleScene(MakeAssembly(flat), NoSteps()), Error);
  EXPECT_THROW(AssembleScene(SceneAssembly()), Error);
  SceneAssembly squashed = MakeAssembly(MakeSquare());
  squashed.parts[0].objectToWorld[0] = 0;
  EXPECT_THROW(AssembleScene(squashed), Error);
}

TEST(SceneCleaning, RefusesWhatIsNotAScene) {
  SceneAssembly assembly = MakeAssembly(MakeSquare());
  assembly.parts[0].meshId = 3;
  EXPECT_THROW(AssembleScene(assembly), Error);
  assembly = MakeAssembly(MakeSquare());
  assembly.parts[0].objectToWorld[5] = std::nan("");
  EXPECT_THROW(AssembleScene(assembly), Error);
  assembly = MakeAssembly(MakeSquare());
  assembly.meshes[0].materialId[0] = 4;
  EXPECT_THROW(AssembleScene(assembly), Error);
  CleaningOptions options;
  options.featureAngle = 200;
  EXPECT_THROW(AssembleScene(MakeAssembly(MakeSquare()), options), Error);
}

TEST(SceneCleaning, RefusesLightThatIsNone) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float wrong : {-1.f, nan, std::numeric_limits<float>::infinity()}) {
    SceneAssembly assembly = MakeAssembly(MakeSquare());
    assembly.meshes[0].emittance.assign(assembly.meshes[0].triangles.size(), {1, wrong, 1});
    EXPECT_THROW(AssembleScene(assembly), Error);
    assembly = MakeAssembly(MakeSquare());
    assembly.lights.emplace_back().intensity = {1, wrong, 1};
    EXPECT_THROW(AssembleScene(assembly), Error);
  }
  // Beyond what rays may reach, or without direction.
  SceneAssembly assembly = MakeAssembly(MakeSquare());
  assembly.lights.emplace_back().position = {0, 1e30f, 0};
  EXPECT_THROW(AssembleScene(assembly), Error);
  assembly.lights.back() = {};
  assembly.lights.back().direction = {};
  EXPECT_NO_THROW(AssembleScene(assembly));  // A point light needs none.
  assembly.lights.back().type = LightType::Spot;
  EXPECT_THROW(AssembleScene(assembly), Error);
}

TEST(SceneCleaning, RefusesSizesWhoseAreasFloatsCannotHold) {
  // The unit square's diagonal is 1.41: both sides of either limit.
  for (const auto& [scale, solvable] : {std::pair(1e-15, false),
                                        {5e-7, false},
                                        {1e-6, true},
                                        {5e8, true},
                                        {1e9, false},
                                        {1e20, false}}) {
    SceneAssembly assembly = MakeAssembly(MakeSquare());
    for (const size_t i : {0, 5, 10}) assembly.parts[0].objectToWorld[i] = scale;
    const Scene scene = AssembleScene(assembly);
    if (solvable) {
      EXPECT_NO_THROW(RequireSolvableMesh(scene.mesh)) << scale;
    } else {
      EXPECT_THROW(RequireSolvableMesh(scene.mesh), Error) << scale;
    }
  }
}

TEST(SceneCleaning, WarnsOfSizesThatLookLikeAWrongUnit) {
  for (const double scale : {0.001, 1.0, 10000.0}) {
    SceneAssembly assembly = MakeAssembly(MakeSquare());
    assembly.lights.emplace_back();
    for (const size_t i : {0, 5, 10}) assembly.parts[0].objectToWorld[i] = scale;
    CleaningReport report;
    AssembleScene(assembly, {}, &report);
    EXPECT_EQ(report.warnings.empty(), scale == 1.0);
  }
}

TEST(SceneCleaning, CanBeCancelled) {
  EXPECT_THROW(AssembleScene(MakeAssembly(MakeSquare()), {}, nullptr,
                             [](double fraction, const char*) { return fraction < 0.5; }),
               Cancelled);
}

TEST(SceneCleaning, DoesNotDependOnThreads) {
  SceneAssembly assembly = MakeAssembly(MakeCylinder(500));
  assembly.meshes.push_back(MakeMoebiusStrip(100));
  assembly.parts.emplace_back();
  assembly.parts.back().meshId = 1;
  SetThreadCount(1);
  const Scene one = AssembleScene(assembly);
  SetThreadCount(0);
  const Scene all = AssembleScene(assembly);
  EXPECT_EQ(one.mesh.triangles, all.mesh.triangles);
  EXPECT_EQ(one.mesh.positions, all.mesh.positions);
  EXPECT_EQ(one.mesh.normals, all.mesh.normals);
  EXPECT_EQ(one.mesh.faceFlags, all.mesh.faceFlags);
}

}  // namespace
}  // namespace lambert
