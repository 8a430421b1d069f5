// The solver on whole scenes, against the reference and closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "Reference/Core/PathTracedIrradiance.h"
#include "SolverScenes.h"
#include "Visibility/Core/SolutionLookup.h"

namespace lambert {
namespace {

using testing::AddLitRoom;
using testing::DataScene;
using testing::SolvedScene;
using testing::SolveScene;

/// Places on a grid over the wall z = 0 of Data/SphereByLamp, opposite the sphere.
struct WallPlace {
  int32_t face;
  Side side;
  Vec3f position;
};

std::vector<WallPlace> WallPlaces(const TriangleMesh& mesh, int n) {
  std::vector<WallPlace> places;
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    const Vec3f normal = mesh.FrontNormal(face);
    const Vec3f middle = (mesh.Corner(face, 0) + mesh.Corner(face, 1) + mesh.Corner(face, 2)) / 3;
    const bool isWall = std::fabs(middle.z) < 1e-4f && std::fabs(normal.z) > 0.99f;
    const bool isNear = std::fabs(middle.x) < 1 && std::fabs(middle.y - 1) < 0.8f;
    if (!isWall || !isNear || face % n != 0) continue;
    places.push_back({int32_t(face), normal.z > 0 ? kFront : kBack, middle});
  }
  return places;
}

TEST(SolverScenes, AClosedSphereBesideALampLightsAWall) {
  const SolvedScene solved = SolveScene(DataScene("SphereByLamp"), 0.05);
  const std::vector<WallPlace> places = WallPlaces(solved.scene.mesh, 1);
  ASSERT_GT(places.size(), 400u);
  const SolutionLookup lookup(solved.solution, solved.scene.mesh.FaceCount());
  std::vector<ReceiverPoint> points;
  Spectrum mean;
  for (const WallPlace& place : places) {
    mean += lookup.Irradiance(lookup.Find(place.face, place.side, place.position));
    points.push_back({place.position, {0, 0, 1}, {0, 0, 1}});
  }

  // The lamp shines away from the wall: without a bounce the wall is dark, so that all that arrives
  // comes from the sphere.
  const PathTracedIrradiance reference(solved.scene);
  PathTracedIrradianceOptions options;
  options.samples = 64;
  options.maximumDepth = 0;
  for (const IrradianceEstimate& direct : reference.Estimate(points, options)) {
    ASSERT_EQ(direct.irradiance, Spectrum(0.f));
  }

  // 1024 paths at each of some 600 places: noise of the mean under 1 %.
  options.samples = 1024;
  options.maximumDepth = 1024;
  Spectrum truth, variance;
  for (const IrradianceEstimate& e : reference.Estimate(points, options)) {
    truth += e.irradiance;
    variance += e.standardError * e.standardError;
  }
  for (int band = 0; band < 3; ++band) {
    EXPECT_LT(std::sqrt(variance[band]) / truth[band], 0.01);
    EXPECT_NEAR(mean[band] / truth[band], 1, 0.05) << "band " << band;
  }
}

TEST(SolverScenes, AWallKeepsTheNextRoomDark) {
  // It parts a room off its lamp; floor, ceiling and two walls pass under it, each in one piece.
  Scene scene;
  AddLitRoom(&scene.mesh, 2, 0.5f, 10);
  testing::AddQuad(&scene.mesh, {1.53f, 0, 0}, {0, 2, 0}, {0, 0, 2}, Spectrum(0.5f), Spectrum(0.f),
                   1, 7);
  testing::CompleteTables(&scene);
  const SolvedScene solved = SolveScene(std::move(scene), 0.05);
  double lit = 0, dark = 0;
  int litPoints = 0, darkPoints = 0;
  for (size_t i = 0; i < solved.solution.irradiance.size(); ++i) {
    const Vec3f& p = solved.solution.mesh.positions[i];
    const double irradiance = double(solved.solution.irradiance[i].Mean());
    if (p.x < 1.5f) lit += irradiance, ++litPoints;
    if (p.x > 1.56f) dark += irradiance, ++darkPoints;
  }
  ASSERT_GT(litPoints, 100);
  // Half as much again came through leaves that lie under the wall; what is left links brought,
  // less the half of it that every round of the gather at the leaves forgets.
  EXPECT_LT(dark / std::max(1, darkPoints), 2e-3 * lit / litPoints);
}

/// A smooth sphere of 4 stacks (stacks - 1) triangles in a small lit room.
Scene SphereInRoom(int stacks) {
  Scene scene;
  AddLitRoom(&scene.mesh, 2, 0.5f, 10);
  testing::AddSphere(&scene.mesh, {1, 1, 0.8f}, 0.5f, stacks, Spectrum(0.6f), Spectrum(0.f), false,
                     7);
  testing::CompleteTables(&scene);
  return scene;
}

TEST(SolverScenes, FinerTessellationTakesNoMoreLinks) {
  const SolvedScene coarse = SolveScene(SphereInRoom(71), 0.2);
  const SolvedScene fine = SolveScene(SphereInRoom(283), 0.2);
  ASSERT_NEAR(double(coarse.scene.mesh.FaceCount()), 20000, 500);
  ASSERT_NEAR(double(fine.scene.mesh.FaceCount()), 320000, 1500);
  const double ratio = double(fine.statistics.Links()) / double(coarse.statistics.Links());
  RecordProperty("coarse_links", std::to_string(coarse.statistics.Links()));
  RecordProperty("fine_links", std::to_string(fine.statistics.Links()));
  EXPECT_NEAR(ratio, 1, 0.2);  // the shape is the same, and so is the light
}

/// 300 boxes of many sizes in a lit room, some of them in one another.
Scene BoxesInRoom(uint64_t seed, int boxes) {
  Scene scene;
  AddLitRoom(&scene.mesh, 4, 0.6f, 20);
  Random random(seed);
  for (int box = 0; box < boxes; ++box) {
    const Vec3f low = testing::RandomVector(&random) * 3.4f + Vec3f(0.1f, 0.1f, 0.1f);
    const Vec3f size = testing::RandomVector(&random) * 0.25f + Vec3f(0.03f, 0.03f, 0.03f);
    testing::AddBox(&scene.mesh, low, low + size,
                    testing::BoxMaterials(0.2f + 0.6f * random.Uniform()), false, 2, 7 + 6 * box);
  }
  testing::CompleteTables(&scene);
  return scene;
}

TEST(SolverScenes, LightMovesBetweenElementsOfEveryKind) {
  const SolverStatistics s = SolveScene(BoxesInRoom(1, 300), 0.2).statistics;
  EXPECT_GT(s.volumeVolume, 0);
  EXPECT_GT(s.volumeFace, 0);
  EXPECT_GT(s.faceFace, 0);
  EXPECT_GT(s.facePatch, 0);
  EXPECT_GT(s.patchPatch, 0);
}

/// A spherical bowl of radius 1 and half-angle `angle`, open towards +z; its inside is the front,
/// emits 1 W/m2 and reflects half.
Scene Bowl(double angle, int rings, int sectors) {
  Scene scene;
  TriangleMesh& mesh = scene.mesh;
  const auto point = [&](int ring, int sector) {
    const double t = angle * ring / rings, p = 2 * kPi * sector / sectors;
    const Vec3f d(float(std::sin(t) * std::cos(p)), float(std::sin(t) * std::sin(p)),
                  float(-std::cos(t)));
    return testing::AddPoint(&mesh, d, -d);
  };
  std::vector<int32_t> inner(size_t(sectors), point(0, 0));
  for (int ring = 1; ring <= rings; ++ring) {
    std::vector<int32_t> outer;
    for (int sector = 0; sector < sectors; ++sector) outer.push_back(point(ring, sector));
    for (int sector = 0; sector < sectors; ++sector) {
      const size_t a = size_t(sector), b = size_t((sector + 1) % sectors);
      testing::AddFace(&mesh, {inner[a], outer[a], outer[b]}, Spectrum(0.5f), Spectrum(1.f));
      if (ring > 1) {
        testing::AddFace(&mesh, {inner[a], outer[b], inner[b]}, Spectrum(0.5f), Spectrum(1.f));
      }
    }
    inner = outer;
  }
  testing::CompleteTables(&scene);
  return scene;
}

struct BowlCase {
  double degrees, radiosity;
};
class BowlTest : public ::testing::TestWithParam<BowlCase> {};

// The inside of a bowl sees itself alike from everywhere: B = M / (1 - rho f), with f the part of
// the sphere that the bowl covers.
TEST_P(BowlTest, LightsItself) {
  const double angle = GetParam().degrees * kPi / 180;
  const Scene scene = Bowl(angle, 16, 64);
  const SolvedScene solved = SolveScene(scene, 0.2);
  double sum = 0, squares = 0, area = 0;
  for (int64_t t = 0; t < solved.solution.mesh.FaceCount(); ++t) {
    if (solved.solution.side[size_t(t)] != kFront) continue;
    const double share = double(solved.solution.mesh.Area(t)) / 3;
    for (const int32_t p : solved.solution.mesh.triangles[size_t(t)]) {
      const double b = double(solved.solution.radiosity[size_t(p)].g);
      sum += b * share, squares += b * b * share, area += share;
    }
  }
  const double mean = sum / area;

  // Of any hollow the self form factor is 1 - opening / surface: what the tessellation changes.
  const double opening = 64 / 2.0 * std::sin(2 * kPi / 64) * std::sin(angle) * std::sin(angle);
  const double tessellated = 1 / (1 - 0.5 * (1 - opening / area));
  EXPECT_NEAR(tessellated / GetParam().radiosity, 1, 1e-3);
  EXPECT_NEAR(mean / GetParam().radiosity, 1, 0.02);
  // Nor is it uneven: the rays of the gather at its points scatter by less than a third of the
  // wanted error of 0.2 (they may scatter by 0.08).
  EXPECT_LT(std::sqrt(std::max(0.0, squares / area - mean * mean)) / mean, 0.2 / 3);
}
INSTANTIATE_TEST_SUITE_P(HalfAngles, BowlTest,
                         ::testing::Values(BowlCase{40, 1.0621223569}, BowlCase{60, 1.1428571429},
                                           BowlCase{80, 1.2603791523}));

}  // namespace
}  // namespace lambert
