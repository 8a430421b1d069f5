#include "Scene/Core/FacingEmitters.h"

#include <gtest/gtest.h>

#include "Scene/Core/SceneCleaning.h"
#include "Scene/Testing/Unit/SmallMeshes.h"

namespace lambert {
namespace {

using namespace testing;

/// A room 4 m wide, its ceiling at z = 2: 6.93 m across. A gap in it is no distance up to a
/// fortieth of a square lamp's side, but at least up to 0.069 mm and never over 6.9 mm.
class FacingEmitters : public ::testing::Test {
 protected:
  FacingEmitters() : assembly_(MakeAssembly(MakeCube(2))) { assembly_.materials[0].name = "wall"; }

  /// A part of its own, with a material of its own.
  void Add(TriangleMesh mesh, const std::string& material) {
    mesh.materialId.assign(mesh.triangles.size(), int32_t(assembly_.materials.size()));
    assembly_.materials.emplace_back();
    assembly_.materials.back().name = material;
    assembly_.parts.emplace_back();
    assembly_.parts.back().meshId = int32_t(assembly_.meshes.size());
    assembly_.meshes.push_back(std::move(mesh));
  }

  /// A square lamp of `side` metres at height z, seen to shine up or down.
  static TriangleMesh Square(bool up, float side, float z, uint8_t sides = kEmitsFront) {
    TriangleMesh square = MakeSquare();
    for (Vec3f& p : square.positions) p = Vec3f(p.x * side, p.y * side, z);
    for (size_t face = 0; face < 2 && !up; ++face) FlipWinding(&square, face);
    MakeEmit(&square, sides);
    return square;
  }

  Scene Clean(const CleaningOptions& options = {}) {
    return AssembleScene(assembly_, options, &report_);
  }
  /// Power that leaves a lamp hung by `gap` below the ceiling, upward and downward, W.
  std::pair<double, double> PowerOfSquare(bool up, float side, float gap,
                                          uint8_t sides = kEmitsFront) {
    assembly_.meshes.resize(1), assembly_.parts.resize(1), assembly_.materials.resize(1);
    Add(Square(up, side, 2 - gap, sides), "tube");
    return UpAndDown(Clean().mesh);
  }
  static std::pair<double, double> UpAndDown(const TriangleMesh& mesh) {
    std::pair<double, double> power;
    for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
      const double m = double(mesh.emittance[size_t(face)].g) * mesh.Area(face);
      const bool frontIsUp = mesh.FrontNormal(face).z > 0;
      if (mesh.Emits(face, kFront)) (frontIsUp ? power.first : power.second) += m;
      if (mesh.Emits(face, kBack)) (frontIsUp ? power.second : power.first) += m;
    }
    return power;
  }

  SceneAssembly assembly_;
  CleaningReport report_;
};

constexpr float kMillimetre = 1e-3f;
const std::pair<double, double> kUp(1, 0), kDown(0, 1), kBoth(1, 1);

TEST_F(FacingEmitters, AreTurnedUnderTheCeiling) {
  EXPECT_EQ(PowerOfSquare(true, 1, kMillimetre), kDown);
  EXPECT_EQ(report_.invertedEmitters, 1);
  ASSERT_EQ(report_.warnings.size(), 1u);
  EXPECT_NE(report_.warnings[0].find("'tube'"), std::string::npos) << report_.warnings[0];
  EXPECT_EQ(PowerOfSquare(false, 1, kMillimetre), kDown);
  EXPECT_EQ(report_.invertedEmitters, 0);

  CleaningOptions off;
  off.fixEmitters = false;
  PowerOfSquare(true, 1, kMillimetre);
  EXPECT_EQ(UpAndDown(Clean(off).mesh), kUp);
  EXPECT_EQ(report_.invertedEmitters, 0);
}

TEST_F(FacingEmitters, AreTurnedWhereRaysWouldPassTheCeiling) {
  // Nearer than 1e-5 of the diagonal.
  EXPECT_EQ(PowerOfSquare(true, 1, 5e-5f), kDown);
  EXPECT_EQ(PowerOfSquare(true, 1e-3f, 5e-5f).first, 0);
}

TEST_F(FacingEmitters, StayInTheCeilingsPlane) {
  EXPECT_EQ(PowerOfSquare(false, 1, 0), kDown);
  EXPECT_EQ(PowerOfSquare(true, 1, 0), kUp);
  // By rounding above it: a step of a float there is 1.2e-7 m.
  EXPECT_EQ(PowerOfSquare(false, 1, -1e-6f), kDown);
  EXPECT_EQ(report_.invertedEmitters, 0);
}

TEST_F(FacingEmitters, LightTheCeilingFromAfar) {
  EXPECT_EQ(PowerOfSquare(true, 1, 8 * kMillimetre), kUp);
  // The gap is measured by the lamp: 2 mm is far for one of 5 cm, 1 mm is not.
  EXPECT_GT(PowerOfSquare(true, 0.05f, 2 * kMillimetre).first, 0);
  EXPECT_EQ(PowerOfSquare(true, 0.05f, kMillimetre).first, 0);

  // By its width, not its length: 0.1 area / perimeter of 1 m x 5 cm is 2.4 mm.
  for (const float gap : {4 * kMillimetre, 2 * kMillimetre}) {
    PowerOfSquare(true, 1, gap);
    for (Vec3f& p : assembly_.meshes.back().positions) p.y *= 0.05f;
    EXPECT_EQ(UpAndDown(Clean().mesh).first > 0, gap > 2.4f * kMillimetre);
  }
}

TEST_F(FacingEmitters, EmittingFromBothSidesStay) {
  EXPECT_EQ(PowerOfSquare(true, 1, kMillimetre, kEmitsFront | kEmitsBack), kBoth);
  EXPECT_EQ(report_.invertedEmitters, 0);
}

TEST_F(FacingEmitters, PartlyInTheOpenStay) {
  // Under a plate that covers nine tenths of the lamp.
  TriangleMesh plate = MakeSquare();
  for (Vec3f& p : plate.positions) p = Vec3f(1.8f * p.x - 0.9f, 2 * p.y - 0.5f, 0);
  Add(std::move(plate), "plate");
  Add(Square(true, 1, -kMillimetre), "tube");
  EXPECT_EQ(UpAndDown(Clean().mesh), kUp);
  EXPECT_EQ(report_.invertedEmitters, 0);
}

TEST_F(FacingEmitters, BoxOnATableStays) {
  for (const float gap : {0.f, 2e-6f, 5e-5f, kMillimetre}) {
    SCOPED_TRACE(gap);
    assembly_.meshes.resize(1), assembly_.parts.resize(1), assembly_.materials.resize(1);
    TriangleMesh box = MakeCube(0.5f, {0, 0, -1.5f + gap});
    MakeEmit(&box);
    Add(box, "lamp");
    const Scene scene = Clean();
    EXPECT_EQ(report_.invertedEmitters, 0);
    for (int64_t face = 12; face < 24; ++face) {
      EXPECT_EQ(scene.mesh.faceFlags[size_t(face)], kEmitsFront);
    }
  }
}

TEST_F(FacingEmitters, ScreenOnACabinet) {
  // The cabinet's top is the plane z = 0; the screen lies on it.
  for (const float gap : {0.f, 1e-6f, 5e-5f, kMillimetre}) {
    SCOPED_TRACE(gap);
    assembly_.meshes.resize(1), assembly_.parts.resize(1), assembly_.materials.resize(1);
    Add(MakeCube(0.75f, {0, 0, -0.75f}), "cabinet");
    Add(Square(true, 0.5f, gap), "screen");
    EXPECT_EQ(UpAndDown(Clean().mesh), std::make_pair(0.25, 0.0));
    EXPECT_EQ(report_.invertedEmitters, 0);
  }
  FlipWinding(&assembly_.meshes.back(), 0);
  FlipWinding(&assembly_.meshes.back(), 1);
  EXPECT_EQ(UpAndDown(Clean().mesh), std::make_pair(0.25, 0.0));
  EXPECT_EQ(report_.invertedEmitters, 1);
}

TEST_F(FacingEmitters, DoubledLampsKeepTheirPower) {
  TriangleMesh lamp = Square(true, 1, 2 - kMillimetre);
  Append(Square(false, 1, 2 - kMillimetre), &lamp);
  Add(lamp, "tube");
  EXPECT_EQ(UpAndDown(Clean().mesh), kBoth);
  EXPECT_EQ(report_.invertedEmitters, 0);
  CleaningOptions options;
  options.removeRepeated = false;
  EXPECT_EQ(UpAndDown(Clean(options).mesh), kBoth);
  EXPECT_EQ(report_.invertedEmitters, 0);

  // As two parts, none of which is dropped.
  assembly_.meshes.back() = Square(true, 1, 2 - kMillimetre);
  assembly_.meshes.back().materialId.assign(2, 1);
  Add(Square(false, 1, 2 - kMillimetre), "other tube");
  EXPECT_EQ(UpAndDown(Clean().mesh), kBoth);
  EXPECT_EQ(report_.invertedEmitters, 0);
  assembly_.meshes.pop_back(), assembly_.parts.pop_back();

  // Twice alike: one of them is dropped, the other turned.
  assembly_.meshes.back() = Square(true, 1, 2 - kMillimetre);
  assembly_.meshes.back().materialId.assign(2, 1);
  TriangleMesh again = assembly_.meshes.back();
  Append(again, &assembly_.meshes.back());
  EXPECT_EQ(UpAndDown(Clean().mesh), kDown);
  EXPECT_EQ(report_.invertedEmitters, 1);
}

TEST_F(FacingEmitters, OfMixedWindingShineAlike) {
  // A strip of four triangles, the last one wound down, whether or not faces are rewound.
  TriangleMesh strip = MakeMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}, {1, 2, 0}},
                                {{0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 4, 5}});
  for (Vec3f& p : strip.positions) p = Vec3f(p.x, p.y - 1, 2 - kMillimetre);
  MakeEmit(&strip);
  Add(strip, "tube");
  for (const bool orient : {true, false}) {
    CleaningOptions options;
    options.orient = orient;
    EXPECT_EQ(UpAndDown(Clean(options).mesh), std::make_pair(0.0, 2.0));
    EXPECT_EQ(report_.invertedEmitters, 1);
  }
}

TEST_F(FacingEmitters, InsideATightCoverStay) {
  TriangleMesh bulb = MakeCube(0.5f);
  MakeEmit(&bulb);
  Add(bulb, "bulb");
  Add(MakeCube(0.5f + kMillimetre), "cover");
  const Scene scene = Clean();
  EXPECT_EQ(report_.invertedEmitters, 0);
  EXPECT_EQ(scene.mesh.faceFlags[12], kEmitsFront);
}

TEST_F(FacingEmitters, OfAnySizeAreSurvived) {
  // Areas that are no numbers in single precision, too small and too large.
  for (const float side : {1e-25f, 1e15f, 1e25f}) {
    assembly_ = MakeAssembly(MakeCube(side));
    Add(Square(true, side, 0), "tube");
    Clean();
    EXPECT_EQ(report_.invertedEmitters, 0);
  }
}

TEST_F(FacingEmitters, WrappedAboutACoreAreTurnedOutward) {
  TriangleMesh tube = MakeCube(0.5f);
  for (size_t face = 0; face < 12; ++face) FlipWinding(&tube, face);
  MakeEmit(&tube);
  Add(tube, "tube");
  Add(MakeCube(0.5f - kMillimetre), "core");
  const Scene scene = Clean();
  EXPECT_EQ(report_.invertedEmitters, 1);
  for (int64_t face = 12; face < 24; ++face) {
    EXPECT_EQ(scene.mesh.faceFlags[size_t(face)], kEmitsBack) << face;
  }
}

TEST_F(FacingEmitters, SheetsThatFaceEachOther) {
  // Inverted: the lower shines up at the upper, which shines down. Outward: they stay.
  for (const bool inverted : {true, false}) {
    assembly_.meshes.resize(1), assembly_.parts.resize(1), assembly_.materials.resize(1);
    Add(Square(inverted, 1, 0), "lower");
    Add(Square(!inverted, 1, kMillimetre), "upper");
    const TriangleMesh mesh = Clean().mesh;
    EXPECT_EQ(report_.invertedEmitters, inverted ? 2 : 0);
    EXPECT_EQ(UpAndDown(mesh), kBoth);
    for (int64_t face = 12; face < 16; ++face) {
      EXPECT_EQ(mesh.Emits(face, mesh.FrontNormal(face).z > 0 ? kFront : kBack), face >= 14);
    }
  }
}

TEST_F(FacingEmitters, AreJudgedByInstance) {
  // One mesh shown under the ceiling, mirrored onto the floor, and in between.
  Add(Square(true, 1, 2 - kMillimetre), "tube");
  Part mirrored = assembly_.parts.back(), between = mirrored;
  mirrored.objectToWorld[10] = -1;
  between.objectToWorld[11] = -1;
  assembly_.parts.push_back(mirrored);
  assembly_.parts.push_back(between);
  const TriangleMesh mesh = Clean().mesh;
  EXPECT_EQ(report_.invertedEmitters, 2);
  const uint8_t turned = kEmitsBack, stays = kEmitsFront;
  EXPECT_EQ(std::vector<uint8_t>(mesh.faceFlags.begin() + 12, mesh.faceFlags.end()),
            std::vector<uint8_t>({turned, turned, turned, turned, stays, stays}));
}

TEST_F(FacingEmitters, PanelOfAThinHousingIsTurnedOutOfIt) {
  // A closed flat box, its lower face the lamp, wound inward.
  TriangleMesh housing = MakeCube(0.5f);
  for (Vec3f& p : housing.positions) p.z *= 4 * kMillimetre;
  for (size_t face = 0; face < 12; ++face) FlipWinding(&housing, face);
  MakeEmit(&housing);
  for (size_t face = 2; face < 12; ++face) housing.faceFlags[face] = 0;
  for (size_t face = 2; face < 12; ++face) housing.emittance[face] = Spectrum(0.f);
  ASSERT_LT(housing.positions[size_t(housing.triangles[0][0])].z, 0);
  Add(housing, "panel");
  EXPECT_EQ(UpAndDown(Clean().mesh), kDown);
  EXPECT_EQ(report_.invertedEmitters, 1);
}

}  // namespace
}  // namespace lambert
