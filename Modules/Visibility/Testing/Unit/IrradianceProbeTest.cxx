// Probes in scenes whose light is known.
#include "Visibility/Core/IrradianceProbe.h"

#include <gtest/gtest.h>

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Common/Testing/SolutionFixtures.h"
#include "Common/Testing/TestScenes.h"

namespace lambert {
namespace {

using namespace testing;

ProbeReading ReadAt(const Scene& scene, const RadiositySolution& solution, const Vec3f& position,
                    const Vec3f& normal, const IrradianceProbeOptions& options = {}) {
  const RayScene rays(scene.mesh);
  return ReadIrradianceProbes(scene, rays, solution, {{position, normal}}, options)[0];
}

TEST(IrradianceProbe, FurnaceInMidAirAndOnTheWall) {
  // Exitance 1, reflectance 0.5: radiosity and irradiance are 2 everywhere, for any facet.
  const Scene scene = FurnaceCube(0.5f);
  const RadiositySolution solution = FlatSolution(scene, 2, 3, false);
  IrradianceProbeOptions many;
  many.rays = many.emitterRays = 4096;
  for (const Vec3f& normal : {Vec3f(0, 0, 1), Vec3f(0, 0, -3), Vec3f(1, 2, -0.5f)}) {
    const ProbeReading reading = ReadAt(scene, solution, {0.3f, 0.6f, 0.4f}, normal, many);
    EXPECT_EQ(reading.kind, ProbeKind::Space);
    // The reflected half is exact, ray by ray; the emitted half is sampled twice 4096 times, to
    // better than 1 %.
    EXPECT_NEAR(reading.irradiance.g, 2, 0.01);
  }
  const ProbeReading wall = ReadAt(scene, solution, {0.3f, 0.6f, 0}, {0, 0, 1});
  EXPECT_EQ(wall.kind, ProbeKind::Surface);
  EXPECT_NEAR(wall.irradiance.g, 2, 1e-6);
  many.forceGather = true;
  const ProbeReading gathered = ReadAt(scene, solution, {0.3f, 0.6f, 0}, {0, 0, 1}, many);
  EXPECT_EQ(gathered.kind, ProbeKind::Space);
  EXPECT_NEAR(gathered.irradiance.g, 2, 0.01);
}

TEST(IrradianceProbe, SmallLampSeenByEmitterRays) {
  // A lamp of 2 cm, 1 m above: as a point of intensity exitance x area / pi; its view factor
  // differs by (size/distance)^2.
  Scene scene;
  AddQuad(&scene.mesh, {-0.01f, -0.01f, 1}, {0, 0.02f, 0}, {0.02f, 0, 0}, Spectrum(0.f),
          Spectrum(1e4f));
  AddQuad(&scene.mesh, {-2, -2, -1}, {4, 0, 0}, {0, 4, 0}, Spectrum(0.f));
  CompleteTables(&scene);
  const double expected = 1e4 * 4e-4 / kPi;
  const ProbeReading reading = ReadAt(scene, FlatSolution(scene, 0, 1), {0, 0, 0}, {0, 0, 1});
  EXPECT_NEAR(reading.irradiance.r, expected, 2e-3 * expected);
}

TEST(IrradianceProbe, LampBesideProbe) {
  // 1 mm under a square lamp of 1 m: the view factor is 1 within 4e-6. The weights of both kinds of
  // rays meet here.
  Scene scene;
  AddQuad(&scene.mesh, {0, 0, 1}, {0, 1, 0}, {1, 0, 0}, Spectrum(0.f), Spectrum(1.f));
  CompleteTables(&scene);
  IrradianceProbeOptions many;
  many.rays = many.emitterRays = 16384;
  const ProbeReading reading =
      ReadAt(scene, FlatSolution(scene, 0, 1), {0.5f, 0.5f, 0.999f}, {0, 0, 1}, many);
  EXPECT_NEAR(reading.irradiance.g, 1,
              0.02);  // area samples reach the spot beside the probe 16384 x 1e-6 times
}

TEST(IrradianceProbe, PointLightOverPlane) {
  Scene scene;
  AddQuad(&scene.mesh, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, Spectrum(0.f));
  CompleteTables(&scene);
  Light light;
  light.position = {0, 0, 3};
  light.intensity = Spectrum(10, 20, 30);
  scene.lights = {light};
  const RadiositySolution solution = FlatSolution(scene, 0, 1);
  const ProbeReading above = ReadAt(scene, solution, {0, 0, 1}, {0, 0, 1});
  EXPECT_EQ(above.kind, ProbeKind::Space);
  EXPECT_NEAR(above.irradiance.g, 20 / 4.0, 1e-5);
  EXPECT_EQ(ReadAt(scene, solution, {0, 0, 1}, {0, 0, -1}).irradiance, Spectrum(0.f));
  EXPECT_EQ(ReadAt(scene, solution, {0, 0, -1}, {0, 0, 1}).irradiance, Spectrum(0.f)) << "blocked";
}

TEST(IrradianceProbe, SkyAndSun) {
  Scene scene;
  AddQuad(&scene.mesh, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, Spectrum(0.f));
  CompleteTables(&scene);
  Light sky, sun;
  sky.type = LightType::Sky;
  sky.intensity = Spectrum(1.f);
  sun.type = LightType::Directional;
  sun.direction = Normalize(Vec3f(1, 0, -1));
  sun.intensity = Spectrum(2.f);
  scene.lights = {sky, sun};
  const ProbeReading reading = ReadAt(scene, FlatSolution(scene, 0, 1), {0, 0, 1}, {0, 0, 1});
  EXPECT_NEAR(reading.irradiance.g, kPi + std::sqrt(2.0), 1e-4);
}

TEST(IrradianceProbe, PenumbraOfASun) {
  const float size = 0.04f;
  const Scene scene = ScreenUnderSun(size);
  const RadiositySolution dark = FlatSolution(scene, 0, 0);
  for (const float x : {-0.03f, -0.01f, 0.005f, 0.03f}) {
    // 16 rays, spread over the disc.
    EXPECT_NEAR(ReadAt(scene, dark, {x, 0, 0}, {0, 0, 1}).irradiance.g,
                Penumbra(double(x), double(size)), 0.15);
  }
}

TEST(IrradianceProbe, ReadsTheSideThatItFaces) {
  const Scene scene = BoxRoom(1, 0.5f, 1);
  RadiositySolution solution = FlatSolution(scene, 0, 4, false);
  for (size_t i = 0; i < solution.irradiance.size(); ++i) {
    solution.irradiance[i] = Spectrum(solution.mesh.positions[i].x);
  }
  const float tilt50 = float(50 * kPi / 180), tilt70 = float(70 * kPi / 180);
  const Vec3f near(std::sin(tilt50), 0, std::cos(tilt50)),
      far(std::sin(tilt70), 0, std::cos(tilt70));
  // 0.5e-5 of the diagonal off the floor, either way, still is the floor; so is a corner point.
  for (const float z : {0.f, 8e-6f, -8e-6f}) {
    const ProbeReading reading = ReadAt(scene, solution, {0.37f, 0.81f, z}, near);
    EXPECT_EQ(reading.kind, ProbeKind::Surface);
    EXPECT_NEAR(reading.irradiance.g, 0.37, 1e-5);
  }
  EXPECT_EQ(ReadAt(scene, solution, {1, 1, 0}, {0, 0, 1}).kind, ProbeKind::Surface);
  EXPECT_EQ(ReadAt(scene, solution, {0.37f, 0.81f, 0}, far).kind, ProbeKind::Space);
  EXPECT_EQ(ReadAt(scene, solution, {0.37f, 0.81f, 3e-5f}, near).kind, ProbeKind::Space);
  EXPECT_NE(ReadAt(scene, solution, {0.37f, 0.81f, 0}, {0, 0, -1}).kind, ProbeKind::Surface)
      << "the outside is not modelled";
}

TEST(IrradianceProbe, InsideOfAThingInALitRoom) {
  Scene scene = BoxRoom(1, 0.5f, 1);
  const int64_t roomFaces = scene.mesh.FaceCount();
  AddBox(&scene.mesh, {0.3f, 0.3f, 0}, {0.6f, 0.6f, 0.3f}, BoxMaterials(0.5f), false);
  CompleteTables(&scene);
  ASSERT_EQ(scene.mesh.FaceCount(), roomFaces + 12);
  const RadiositySolution solution = FlatSolution(scene, 0.3f, 2, false);
  for (const Vec3f& normal : {Vec3f(0, 0, 1), Vec3f(1, 0, 0), Vec3f(0, 0.6f, -0.8f)}) {
    const ProbeReading reading = ReadAt(scene, solution, {0.45f, 0.45f, 0.15f}, normal);
    EXPECT_EQ(reading.kind, ProbeKind::Inside);
    EXPECT_EQ(reading.irradiance, Spectrum(0.f));
  }
  EXPECT_EQ(ReadAt(scene, solution, {0.45f, 0.45f, 0.35f}, {0, 0, -1}).kind, ProbeKind::Space);
}

TEST(IrradianceProbe, SameBitsForAnyThreadCountAndOrder) {
  const Scene scene = BoxRoom(1, 0.5f, 1);
  const RadiositySolution solution = FlatSolution(scene, 0.3f, 2, false);
  const RayScene rays(scene.mesh);
  std::vector<ProbePoint> points;
  for (int i = 0; i < 50; ++i) {
    points.push_back({{0.01f + 0.019f * float(i), 0.5f, 0.4f}, {0, 0.6f, 0.8f}});
  }
  SetThreadCount(1);
  const auto one = ReadIrradianceProbes(scene, rays, solution, points);
  SetThreadCount(2);
  std::reverse(points.begin(), points.end());
  const auto two = ReadIrradianceProbes(scene, rays, solution, points);
  SetThreadCount(0);
  for (size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(one[i].irradiance, two[points.size() - 1 - i].irradiance);
  }
}

TEST(IrradianceProbe, NamesTheRowOfABadProbe) {
  const Scene scene = BoxRoom(1, 0.5f, 1);
  const RadiositySolution solution = FlatSolution(scene, 0.3f, 1, false);
  const RayScene rays(scene.mesh);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const Vec3f& bad : {Vec3f(0, 0, 0), Vec3f(nan, 0, 1)}) {
    try {
      ReadIrradianceProbes(scene, rays, solution, {{{0, 0, 0}, {0, 0, 1}}, {{0, 0, 0}, bad}});
      FAIL() << "a normal without direction was taken";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("row 2"), std::string::npos) << error.what();
    }
  }
  for (const float bad : {nan, 1e16f, -1e30f}) {  // Embree aborts beyond 1e18.
    EXPECT_THROW(ReadIrradianceProbes(scene, rays, solution, {{{bad, 0, 0}, {0, 0, 1}}}), Error);
  }
  EXPECT_EQ(ReadAt(scene, solution, {1e15f, 0, 0}, {0, 0, 1}).kind, ProbeKind::Space);
  // Tiny and huge normals have a direction.
  EXPECT_EQ(ReadAt(scene, solution, {0.5f, 0.5f, 0}, {0, 0, 1e-30f}).kind, ProbeKind::Surface);
  EXPECT_EQ(ReadAt(scene, solution, {0.5f, 0.5f, 0}, {0, 0, 1e30f}).kind, ProbeKind::Surface);
}

}  // namespace
}  // namespace lambert
