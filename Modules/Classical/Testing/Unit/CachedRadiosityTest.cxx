// The path-traced element cache against closed forms and known answers.
#include "Classical/Core/CachedRadiosity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Classical/Core/ElementCache.h"
#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Common/Core/PolygonIrradiance.h"
#include "Common/Testing/DoubledSheet.h"
#include "Common/Testing/TestScenes.h"
#include "Visibility/Core/SolutionLookup.h"

namespace lambert {
namespace {

RadiositySolution Solve(const Scene& scene, double elementSize, int gatherRays = 64,
                        int emitterRays = 16, SolverStatistics* statistics = nullptr) {
  CachedRadiosityOptions options;
  options.elementSize = elementSize;
  options.gatherRays = gatherRays;
  options.emitterRays = emitterRays;
  return SolveCachedRadiosity(scene, options, statistics);
}

/// Mean over the refined triangles of one input quad (two faces, the first given), by area.
Spectrum MeanOverQuad(const RadiositySolution& solution, const std::vector<Spectrum>& light,
                      int64_t firstFace) {
  Spectrum sum;
  float area = 0;
  for (int64_t t = 0; t < solution.mesh.FaceCount(); ++t) {
    const int64_t face = solution.inputFaceId[size_t(t)];
    if (face != firstFace && face != firstFace + 1) continue;
    const auto& corners = solution.mesh.triangles[size_t(t)];
    const float a = solution.mesh.Area(t);
    for (const int32_t corner : corners) sum += light[size_t(corner)] * (a / 3);
    area += a;
  }
  return sum / area;
}

// A closed room that shines and reflects alike everywhere: B = 1 / (1 -
// rho) at every point. All rays read the same light and the closed form of what surrounds a point
// is 1, so that nothing is left to chance: the sweeps end within 0.1 %, the sum of them in float
// adds less.
TEST(CachedRadiosity, FurnaceIsExact) {
  Scene scene;
  testing::BoxMaterials materials(0, 1);
  materials.reflectance.fill({0.5f, 0.8f, 0.95f});
  testing::AddBox(&scene.mesh, {0, 0, 0}, {2, 2, 2}, materials, true);
  testing::CompleteTables(&scene);
  SolverStatistics statistics;
  const RadiositySolution solution = Solve(scene, 0.5, 64, 16, &statistics);
  for (const Spectrum& b : solution.radiosity) {
    EXPECT_NEAR(b.r, 2, 2 * 0.002);
    EXPECT_NEAR(b.g, 5, 5 * 0.002);
    EXPECT_NEAR(b.b, 20, 20 * 0.002);
  }
  for (const uint8_t side : solution.side) EXPECT_EQ(side, kFront);  // The outside is dark.
  for (int band = 0; band < 3; ++band) {
    EXPECT_NEAR(statistics.absorbed[band] / statistics.emitted[band], 1, 0.002);
    EXPECT_NEAR(statistics.escaped[band] / statistics.emitted[band], 0, 1e-4);
  }
}

// A unit cube under a black ceiling of exitance 1 (case 16), with bands of other reflectances
// beside the one that is known. 256 rays find the indirect third of the light within 1 %.
TEST(CachedRadiosity, LitCube) {
  Scene scene = testing::BoxRoom(1, 0.5f, 1);
  for (size_t face = 0; face < scene.mesh.triangles.size(); ++face) {
    if (scene.mesh.emittance[face].IsBlack()) scene.mesh.reflectance[face] = {0.2f, 0.5f, 0.8f};
    scene.mesh.emittance[face] = scene.mesh.emittance[face] * Spectrum(2, 1, 1);
  }
  const RadiositySolution solution = Solve(scene, 0.1, 256);
  const SolutionLookup lookup(solution, scene.mesh.FaceCount());
  const auto at = [&](testing::BoxSide side, const Vec3f& position) {
    const int64_t first = 2 * int64_t(side);
    // The quad's two triangles: the nearer one holds the position.
    const auto place = [&](int64_t face) { return lookup.Find(face, kFront, position); };
    const auto distance = [&](const SolutionLookup::Place& p) {
      const auto& c = solution.mesh.triangles[size_t(p.triangle)];
      const auto& x = solution.mesh.positions;
      return Length(x[size_t(c[0])] * p.weights.x + x[size_t(c[1])] * p.weights.y +
                    x[size_t(c[2])] * p.weights.z - position);
    };
    const auto one = place(first), two = place(first + 1);
    return lookup.Irradiance(distance(one) <= distance(two) ? one : two);
  };
  constexpr double kTolerance = 0.015;
  EXPECT_NEAR(at(testing::kFloor, {0.5f, 0.5f, 0}).g / 0.35828, 1, kTolerance);
  EXPECT_NEAR(at(testing::kFloor, {0.25f, 0.25f, 0}).g / 0.32181, 1, kTolerance);
  EXPECT_NEAR(at(testing::kFloor, {0.05f, 0.05f, 0}).g / 0.2463, 1, kTolerance);
  EXPECT_NEAR(at(testing::kMinusX, {0, 0.5f, 0.5f}).g / 0.32242, 1, kTolerance);
  EXPECT_NEAR(at(testing::kMinusX, {0, 0.5f, 0.75f}).g / 0.4387, 1, kTolerance);

  // Means have next to no noise; elements of a tenth flatten the walls' bright upper edge.
  EXPECT_NEAR(MeanOverQuad(solution, solution.radiosity, 2 * testing::kFloor).g / 0.15517, 1,
              0.005);
  EXPECT_NEAR(MeanOverQuad(solution, solution.radiosity, 2 * testing::kMinusX).g / 0.16400, 1,
              0.01);

  // More reflectance gives more; twice the exitance at the least twice the direct light.
  const Spectrum middle = at(testing::kFloor, {0.5f, 0.5f, 0});
  EXPECT_GT(middle.b, 1.2f * middle.g);
  EXPECT_GT(middle.r, 2 * 0.2394565f);
}

// One value a face (case 15): the cache alone, with cells as large as the faces. 32,768 stratified
// rays a face find form factors of 0.2 within 1 %.
TEST(CachedRadiosity, CubeOfSixCells) {
  for (const float rho : {0.5f, 0.8f}) {
    Scene scene;
    testing::BoxMaterials materials(rho);
    materials.emittance[testing::kCeiling] = Spectrum(1.f);
    testing::AddBox(&scene.mesh, {0.1f, 0.1f, 0.1f}, {1.1f, 1.1f, 1.1f}, materials, true);
    testing::CompleteTables(&scene);
    const RayScene rays(scene.mesh);
    const SourceLight sources(scene, rays);
    const ElementCells cells(scene.mesh, 2);
    ASSERT_EQ(cells.Size(), 6);
    ElementCache cache(scene, rays, sources, cells, 32768, 1);
    cache.Fill();
    const auto reflected = [&](testing::BoxSide side) {
      return double(cache.Reflected(2 * side, kFront, {0.3f, 0.3f}).g);
    };
    const bool dim = rho < 0.6f;
    EXPECT_NEAR(reflected(testing::kCeiling) / (dim ? 0.0909090981 : 0.5517241536), 1, 0.01);
    EXPECT_NEAR(reflected(testing::kFloor) / (dim ? 0.1817458261 : 0.6895510707), 1, 0.01);
    EXPECT_NEAR(reflected(testing::kPlusY) / (dim ? 0.1818362689 : 0.6896811939), 1, 0.01);
  }
}

// Exchange past a blocker (case 11): unit squares a unit apart, the lower one black and lit by the
// upper, a square of half a side in one corner half way up. Elements of 1/40 follow the shadow's
// edge to some tenths of a percent.
TEST(CachedRadiosity, ShadowOfABlocker) {
  Scene scene;
  TriangleMesh& mesh = scene.mesh;
  const Spectrum black(0.f);
  testing::AddQuad(&mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, black);
  testing::AddQuad(&mesh, {0, 0, 1}, {0, 1, 0}, {1, 0, 0}, black, Spectrum(1.f));
  testing::AddQuad(&mesh, {0, 0, 0.5f}, {0.5f, 0, 0}, {0, 0.5f, 0}, black);
  testing::CompleteTables(&scene);
  const RadiositySolution solution = Solve(scene, 0.025, 1, 64);
  EXPECT_NEAR(MeanOverQuad(solution, solution.irradiance, 0).g / 0.1498686718, 1, 0.01);
}

// Lights without geometry, each alone over a square that sees nothing else. All exact but for the
// interpolation, which the points do not see.
TEST(CachedRadiosity, LightsWithoutGeometry) {
  for (const Side lit : {kFront, kBack}) {
    const float up = lit == kFront ? 1.f : -1.f;
    Light point, spot, sun, sky;
    point.position = spot.position = {0.5f, 0.5f, 2 * up};
    point.intensity = spot.intensity = Spectrum(8, 4, 2);
    spot.type = LightType::Spot;
    spot.direction = {0, 0, -up};
    spot.innerConeAngle = 0.1f, spot.outerConeAngle = 0.2f;
    sun.type = LightType::Directional;
    sun.direction = Normalize(Vec3f(1, 0, -up));
    sun.intensity = Spectrum(3.f);
    sky.type = LightType::Sky;
    sky.intensity = Spectrum(1.f);
    for (const Light& light : {point, spot, sun, sky}) {
      Scene scene;
      testing::AddQuad(&scene.mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.5f));
      testing::CompleteTables(&scene);
      scene.lights.push_back(light);
      SolverStatistics statistics;
      const RadiositySolution solution = Solve(scene, 0.2, 64, 16, &statistics);
      ASSERT_GT(solution.mesh.FaceCount(), 0);
      for (size_t t = 0; t < solution.side.size(); ++t) {
        // The sky shines on both sides, the others on one.
        EXPECT_TRUE(solution.side[t] == lit || light.type == LightType::Sky);
      }
      for (size_t i = 0; i < solution.irradiance.size(); ++i) {
        const Vec3f offset = light.position - solution.mesh.positions[i];
        const float distance = Length(offset);
        float expected = float(kPi);
        if (light.IsPlaced()) {
          expected = light.intensity.g * light.ConeFactor(-offset / distance) * 2 /
                     (distance * distance * distance);
        } else if (light.type == LightType::Directional) {
          expected = 3 * std::sqrt(0.5f);
        }
        // Points are gathered a thousandth of an element beside their vertex: the spot falls off
        // by 4 / 0.1 rad.
        EXPECT_NEAR(solution.irradiance[i].g, expected, 0.002);
      }
      // What arrives is absorbed or escapes; half of it each. Points of few paths: 1 %.
      EXPECT_NEAR((statistics.absorbed.g + statistics.escaped.g) / statistics.emitted.g, 1, 0.01);
    }
  }
}

TEST(CachedRadiosity, ADoubledSheetHasTwoSides) {
  const Scene scene = testing::DoubledSheetUnderSuns();
  SolverStatistics statistics;
  const RadiositySolution solution = Solve(scene, 0.2, 64, 16, &statistics);
  double area = 0;
  for (int64_t face = 0; face < solution.mesh.FaceCount(); ++face) {
    const bool isUp = solution.mesh.FrontNormal(face).z > 0;
    area += double(solution.mesh.Area(face));
    for (const int32_t p : solution.mesh.triangles[size_t(face)]) {
      EXPECT_NEAR(solution.irradiance[size_t(p)].g, isUp ? 1 : 4, 1e-4f);
      EXPECT_NEAR(solution.radiosity[size_t(p)].r, isUp ? 0.8f : 2.f, 1e-4f);
    }
  }
  EXPECT_NEAR(area, 8, 1e-4);  // Two sides of 4 m2.
  EXPECT_NEAR((statistics.absorbed.g + statistics.escaped.g) / statistics.emitted.g, 1, 0.01);
}

// pi H + 2 pi (Z - H) / 3 of a sky with a gradient, over a black ground: one side is lit.
TEST(CachedRadiosity, AGradientSky) {
  Scene scene;
  testing::AddQuad(&scene.mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.5f));
  testing::CompleteTables(&scene);
  Light sky;
  sky.type = LightType::GradientSky;
  sky.intensity = Spectrum(4.f);
  sky.horizon = Spectrum(1.f);
  scene.lights = {sky};
  SolverStatistics statistics;
  const RadiositySolution solution = Solve(scene, 0.2, 64, 16, &statistics);
  ASSERT_GT(solution.mesh.FaceCount(), 0);
  for (const uint8_t side : solution.side) EXPECT_EQ(side, kFront);
  // 64 stratified rays.
  for (const Spectrum& e : solution.irradiance) EXPECT_NEAR(e.g, 3 * kPi, 0.01 * 3 * kPi);
  EXPECT_NEAR((statistics.absorbed.g + statistics.escaped.g) / statistics.emitted.g, 1, 0.01);
}

// Nothing depends on how the work was shared out.
TEST(CachedRadiosity, SameForAnyThreads) {
  Scene scene = testing::BoxRoom(1, 0.6f, 1);
  testing::AddBox(&scene.mesh, {0.3f, 0.3f, 0.f}, {0.5f, 0.6f, 0.4f}, testing::BoxMaterials(0.3f),
                  false, 3);
  testing::CompleteTables(&scene);
  SolverStatistics one, three;
  SetThreadCount(1);
  const RadiositySolution alone = Solve(scene, 0.1, 16, 4, &one);
  SetThreadCount(3);
  const RadiositySolution together = Solve(scene, 0.1, 16, 4, &three);
  SetThreadCount(0);
  EXPECT_TRUE(alone.irradiance == together.irradiance);
  EXPECT_TRUE(alone.radiosity == together.radiosity);
  EXPECT_TRUE(alone.inputIrradiance == together.inputIrradiance);
  EXPECT_TRUE(alone.mesh.triangles == together.mesh.triangles);
  EXPECT_EQ(one.rays, three.rays);
  EXPECT_EQ(one.absorbed, three.absorbed);
}

// Slivers, points and folds among the faces take nothing from the light of the others.
TEST(CachedRadiosity, DegenerateFaces) {
  Scene scene = testing::BoxRoom(1, 0.5f, 1);
  TriangleMesh& mesh = scene.mesh;
  const Spectrum grey(0.5f);
  testing::AddTriangle(&mesh, {0.5f, 0.5f, 0.5f}, {0.5f, 0.5f, 0.5f}, {0.5f, 0.5f, 0.5f}, grey,
                       Spectrum(1.f));
  testing::AddTriangle(&mesh, {0.2f, 0.5f, 0.5f}, {0.4f, 0.5f, 0.5f}, {0.6f, 0.5f, 0.5f}, grey);
  testing::AddTriangle(&mesh, {0.1f, 0.1f, 0.5f}, {0.9f, 0.1f, 0.5f}, {0.5f, 0.1000001f, 0.5f},
                       grey);
  // Twice the same face, wound both ways.
  testing::AddTriangle(&mesh, {0.1f, 0.1f, 0.2f}, {0.2f, 0.1f, 0.2f}, {0.1f, 0.2f, 0.2f}, grey);
  testing::AddTriangle(&mesh, {0.1f, 0.1f, 0.2f}, {0.1f, 0.2f, 0.2f}, {0.2f, 0.1f, 0.2f}, grey);
  testing::CompleteTables(&scene);
  const RadiositySolution solution = Solve(scene, 0.2);
  std::vector<bool> delivered(mesh.triangles.size(), false);
  for (const int64_t face : solution.inputFaceId) delivered[size_t(face)] = true;
  for (const bool is : delivered) EXPECT_TRUE(is);
  for (size_t i = 0; i < solution.irradiance.size(); ++i) {
    for (int band = 0; band < 3; ++band) {
      ASSERT_TRUE(std::isfinite(solution.irradiance[i][band]));
      // No place is brighter than a furnace of this exitance and reflectance.
      ASSERT_LE(solution.irradiance[i][band], 2.001f);
      ASSERT_GE(solution.irradiance[i][band], 0);
    }
  }
  EXPECT_NEAR(MeanOverQuad(solution, solution.radiosity, 2 * testing::kFloor).g / 0.15517, 1, 0.05);
}

// A slanted lamp above a facet of 2 cm: points of the lamp lie in its own plane but for rounding.
// The facet sees all of it, so that its light is the closed form; it varies by 4e-4 over 2 cm.
TEST(CachedRadiosity, ASlantedLampIsCutToAnEnd) {
  Scene scene;
  TriangleMesh& mesh = scene.mesh;
  testing::AddQuad(&mesh, {0.29f, 0.29f, 0}, {0.02f, 0, 0}, {0, 0.02f, 0}, Spectrum(0.f));
  testing::AddTriangle(&mesh, {0.2f, 0.1f, 1}, {0.5f, 1.3f, 1.4f}, {1.5f, 0.3f, 0.8f},
                       Spectrum(0.f), Spectrum(1.f));
  testing::CompleteTables(&scene);
  const RadiositySolution solution = Solve(scene, 0.05, 16, 64);
  EXPECT_NEAR(MeanOverQuad(solution, solution.irradiance, 0).g / 0.1285844918, 1, 1e-3);
}

// So far from the origin that a lamp is as small as coordinates are apart: the middles of its edges
// are its corners. Cut there it would lose its light, or be cut for ever.
TEST(CachedRadiosity, ALampTooSmallToBeCut) {
  constexpr float kFar = 1048576, kApart = 0.125f;  // 2^20, and 2^-23 of it
  for (const float shift : {0.f, kApart}) {         // whose middles are rounded this way or that
    Scene scene;
    const float x = kFar + shift, z = kFar + 4 * kApart;
    testing::AddTriangle(&scene.mesh, {x, x, z}, {x, x + kApart, z}, {x + kApart, x, z},
                         Spectrum(0.f), Spectrum(1.f));
    testing::CompleteTables(&scene);
    const RayScene rays(scene.mesh);
    const SourceLight sources(scene, rays);
    Random random(1);
    int64_t cast = 0;
    const LightReceiver below{{x, x, kFar}, {0, 0, 1}, {0, 0, 1}};
    // Area over pi times the squared distance, less what its far corners are farther: 1 / 8.
    const double expected = 0.5 / (16 * kPi);
    EXPECT_NEAR(sources.FromEmitters(below, 64, &random, &cast).g / expected, 1, 0.125);
    EXPECT_GT(cast, 0);
  }
}

// A place closely below a large lamp looks up through a short shaft. What it sees is a speck of the
// lamp, and sends most of the light, all of it in closed form. Upright, tilted, and facing a wall
// of the shaft, so that the lamp stands half below the horizon.
TEST(CachedRadiosity, NearALampWhatIsNearCounts) {
  constexpr float kRim = 0.0099f, kHeight = 0.01f, kHalf = 0.02f, kSeen = kHalf * kHeight / kRim;
  Scene scene;
  TriangleMesh& mesh = scene.mesh;
  testing::AddQuad(&mesh, {-1, -1, kHeight}, {0, 2, 0}, {2, 0, 0}, Spectrum(0.f), Spectrum(1.f));
  for (const float side : {-kHalf, kHalf}) {
    testing::AddQuad(&mesh, {side, -kHalf, 0}, {0, 2 * kHalf, 0}, {0, 0, kRim}, Spectrum(0.f));
    testing::AddQuad(&mesh, {-kHalf, side, 0}, {2 * kHalf, 0, 0}, {0, 0, kRim}, Spectrum(0.f));
  }
  testing::CompleteTables(&scene);
  const RayScene rays(scene.mesh);
  const SourceLight sources(scene, rays);
  const Vec3f seen[4] = {{-kSeen, -kSeen, kHeight},
                         {-kSeen, kSeen, kHeight},
                         {kSeen, kSeen, kHeight},
                         {kSeen, -kSeen, kHeight}};
  Random random(1);
  int64_t cast = 0;
  for (const Vec3f& direction : {Vec3f(0, 0, 1), Vec3f(1, 0, 1), Vec3f(1, 0.5f, 0)}) {
    const Vec3f normal = Normalize(direction);
    const LightReceiver at{{0, 0, 0}, normal, normal};
    const double expected =
        Dot(PolygonIrradianceAbove(seen, 4, at.position, normal), Vec3d(normal));
    for (const int count : {1, 16}) {
      const int tries = 16384 / count;
      double sum = 0;
      for (int i = 0; i < tries; ++i) {
        sum += double(sources.FromEmitters(at, count, &random, &cast).g) / tries;
      }
      // At worst half of 16384 rays arrive: some 4 standard errors.
      EXPECT_NEAR(sum / expected, 1, 0.03) << normal.x << ' ' << normal.y << ' ' << count;
    }
  }
}

TEST(CachedRadiosity, DarkAndEmptyScenes) {
  Scene dark = testing::BoxRoom(1, 0.5f, 0);
  SolverStatistics statistics;
  const RadiositySolution solution = Solve(dark, 0.5, 64, 16, &statistics);
  EXPECT_GT(solution.mesh.FaceCount(), 0);
  for (const Spectrum& e : solution.irradiance) EXPECT_TRUE(e.IsBlack());
  EXPECT_EQ(statistics.emitted, Spectrum());
  EXPECT_EQ(Solve(Scene(), 0).mesh.FaceCount(), 0);
}

TEST(CachedRadiosity, RefusesOptionsWithoutMeaning) {
  const Scene scene = testing::BoxRoom(1, 0.5f, 1);
  const auto with = [](auto change) {
    CachedRadiosityOptions options;
    change(&options);
    return options;
  };
  for (const CachedRadiosityOptions& options :
       {with([](auto* o) { o->paths = 0; }), with([](auto* o) { o->gatherRays = 0; }),
        with([](auto* o) { o->emitterRays = -1; }), with([](auto* o) { o->elementSize = -1; }),
        with([](auto* o) { o->elementSize = std::nan(""); }),
        with([](auto* o) { o->elementSize = 1e-6; })}) {
    EXPECT_THROW(SolveCachedRadiosity(scene, options), Error);
  }
  EXPECT_THROW(SolveCachedRadiosity(scene, {}, nullptr, [](double, const char*) { return false; }),
               Cancelled);
}

}  // namespace
}  // namespace lambert
