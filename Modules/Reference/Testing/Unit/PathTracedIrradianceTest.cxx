// The path tracer against closed forms. A tolerance is 4 standard errors (one test in some 10,000
// would miss by chance; seeds are fixed, so that it never flickers) plus an allowance for float
// rounding, 1e-4 of the value.
#include "Reference/Core/PathTracedIrradiance.h"

#include <gtest/gtest.h>

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Common/Testing/TestScenes.h"

namespace lambert {
namespace {

using namespace testing;

IrradianceEstimate At(const Scene& scene, const Vec3f& position, const Vec3f& normal,
                      int samples = 4096, const Vec3f& geometricNormal = {}) {
  PathTracedIrradianceOptions options;
  options.samples = samples;
  const bool same = LengthSquared(geometricNormal) == 0;
  return PathTracedIrradiance(scene).Estimate({{position, normal, same ? normal : geometricNormal}},
                                              options)[0];
}

void ExpectIrradiance(const IrradianceEstimate& estimate, double expected, double allowance = 1e-4,
                      double largestError = 0.02) {
  for (int band = 0; band < 3; ++band) {
    EXPECT_NEAR(estimate.irradiance[band], expected,
                4 * estimate.standardError[band] + allowance * expected);
    // The error bar itself must be short, or the line above says nothing.
    EXPECT_LT(estimate.standardError[band], largestError * expected);
  }
}

/// A unit square of exitance 1 at z = 1, over [0,1]^2, that emits downward and reflects nothing.
Scene SquareLamp() {
  Scene scene;
  AddQuad(&scene.mesh, {0, 0, 1}, {0, 1, 0}, {1, 0, 0}, Spectrum(0.f), Spectrum(1.f));
  CompleteTables(&scene);
  return scene;
}

TEST(PathTracedIrradiance, RectangleAboveParallelFacet) {
  // View factor of a differential area to a parallel rectangle under its corner and its centre.
  ExpectIrradiance(At(SquareLamp(), {0, 0, 0}, {0, 0, 1}), 0.1385316060);
  ExpectIrradiance(At(SquareLamp(), {0.5f, 0.5f, 0}, {0, 0, 1}), 0.2394564705);
}

TEST(PathTracedIrradiance, RectangleAbovePerpendicularFacet) {
  ExpectIrradiance(At(SquareLamp(), {0, 0, 0}, {1, 0, 0}), 0.0557341970);
  Scene scene;
  AddQuad(&scene.mesh, {0, 0, 0.5f}, {0, 1, 0}, {2, 0, 0}, Spectrum(0.f), Spectrum(1.f));
  ExpectIrradiance(At(scene, {0, 0, 0}, {1, 0, 0}), 0.1587748045);
}

TEST(PathTracedIrradiance, VectorIrradianceOfTriangle) {
  Scene scene;
  AddTriangle(&scene.mesh, {0.2f, 0.1f, 1}, {1.5f, 0.3f, 0.8f}, {0.5f, 1.3f, 1.4f}, Spectrum(0.f),
              Spectrum(1.f));
  scene.mesh.faceFlags[0] = kEmitsFront | kEmitsBack;
  // The whole triangle is above the horizon of a facet that faces z, so that its irradiance is that
  // component.
  ExpectIrradiance(At(scene, {0.3f, 0.3f, 0}, {0, 0, 1}), 0.1285844918);
}

TEST(PathTracedIrradiance, SphereByItsViewFactor) {
  // (r/h)^2 cos t. A sphere of 64 x 128 facets lies inside the true one by 1 - cos(pi/128) of its
  // radius at most: its silhouette is up to 0.1 % smaller.
  Scene scene;
  AddSphere(&scene.mesh, {0, 0, 2}, 1, 64, Spectrum(0.f), Spectrum(1.f));
  ExpectIrradiance(At(scene, {0, 0, 0}, {0, 0, 1}), 0.25, 1.2e-3);
  const float tilt = float(kPi) / 6;
  ExpectIrradiance(At(scene, {0, 0, 0}, {std::sin(tilt), 0, std::cos(tilt)}), 0.2165063509, 1.2e-3);
}

TEST(PathTracedIrradiance, DiscByItsViewFactor) {
  // A fan of 256 triangles: its area is smaller than the disc's by 1e-4.
  for (const auto& [radius, expected] : {std::pair(1.f, 0.5), std::pair(0.5f, 0.2)}) {
    Scene scene;
    const int sectors = 256;
    for (int i = 0; i < sectors; ++i) {
      const double a = 2 * kPi * i / sectors, b = 2 * kPi * (i + 1) / sectors;
      AddTriangle(&scene.mesh, {0, 0, 1},
                  Vec3f(radius * float(std::cos(b)), radius * float(std::sin(b)), 1),
                  Vec3f(radius * float(std::cos(a)), radius * float(std::sin(a)), 1), Spectrum(0.f),
                  Spectrum(1.f));
    }
    ExpectIrradiance(At(scene, {0, 0, 0}, {0, 0, 1}), expected, 2e-4);
  }
}

TEST(PathTracedIrradiance, FurnaceOfAnyReflectance) {
  // Irradiance everywhere is the radiosity 1 / (1 - rho) of the walls.
  for (const float rho : {0.5f, 0.8f, 0.95f}) {
    const Scene scene = FurnaceCube(rho);
    for (const Vec3f& p : {Vec3f(0.5f, 0.5f, 0), Vec3f(0.001f, 0.9f, 0), Vec3f(0.3f, 0.2f, 0)}) {
      ExpectIrradiance(At(scene, p, {0, 0, 1}, 2048), 1 / (1 - double(rho)));
    }
    ExpectIrradiance(At(scene, {0.4f, 0.6f, 0.3f}, {0.6f, 0, -0.8f}, 2048), 1 / (1 - double(rho)));
  }
}

TEST(PathTracedIrradiance, RoomUnderBlackCeiling) {
  // Reference values good to 4-5 digits: allowance half a unit of the last.
  const Scene scene = BoxRoom(1, 0.5f, 1);
  const int samples = 1 << 18;
  const struct {
    Vec3f position, normal;
    double irradiance, lastDigit;
  } places[] = {{{0.5f, 0.5f, 0}, {0, 0, 1}, 0.35828, 5e-6},
                {{0.25f, 0.25f, 0}, {0, 0, 1}, 0.32181, 5e-6},
                {{0.05f, 0.05f, 0}, {0, 0, 1}, 0.2463, 5e-5},
                {{0, 0.5f, 0.5f}, {1, 0, 0}, 0.32242, 5e-6},
                {{0, 0.5f, 0.75f}, {1, 0, 0}, 0.4387, 5e-5}};
  for (const auto& place : places) {
    ExpectIrradiance(At(scene, place.position, place.normal, samples), place.irradiance,
                     1e-4 + place.lastDigit / place.irradiance, 0.002);
  }
}

TEST(PathTracedIrradiance, PointSpotAndDirectionalLights) {
  Scene scene;
  AddQuad(&scene.mesh, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, Spectrum(0.5f));
  Light point;
  point.position = {0, 0, 2};
  point.intensity = Spectrum(10, 20, 30);
  scene.lights = {point};
  // I cos^3 / h^2; nothing random in it.
  const double distance = std::sqrt(4 + 0.25);
  const IrradianceEstimate lit = At(scene, {0.5f, 0, 0}, {0, 0, 1}, 16);
  EXPECT_NEAR(lit.irradiance.r, 10 * 2 / std::pow(distance, 3), 1e-5);
  EXPECT_NEAR(lit.irradiance.b, 30 * 2 / std::pow(distance, 3), 3e-5);
  EXPECT_EQ(lit.standardError.r, 0);
  EXPECT_EQ(At(scene, {0.5f, 0, 0}, {0, 0, -1}, 16).irradiance, Spectrum(0.f));

  Light spot = point;
  spot.type = LightType::Spot;
  spot.innerConeAngle = 0.1f, spot.outerConeAngle = 0.5f;
  scene.lights = {spot};
  EXPECT_NEAR(At(scene, {0, 0, 0}, {0, 0, 1}, 16).irradiance.r, 10 / 4.0, 1e-5);
  EXPECT_EQ(At(scene, {1.5f, 0, 0}, {0, 0, 1}, 16).irradiance, Spectrum(0.f));

  Light sun;
  sun.type = LightType::Directional;
  sun.direction = Normalize(Vec3f(0, 1, -1));
  sun.intensity = Spectrum(8.f);
  scene.lights = {sun};
  EXPECT_NEAR(At(scene, {0, 0, 0}, {0, 0, 1}, 16).irradiance.g, 8 / std::sqrt(2.0), 1e-5);
  EXPECT_EQ(At(scene, {0, 0, -1}, {0, 0, 1}, 16).irradiance, Spectrum(0.f)) << "the plane blocks";
}

TEST(PathTracedIrradiance, LightsReachByReflection) {
  // Over an endless plane lit by the sun with E the irradiance from below is rho E; the plane of
  // 2000 m ends where the facet at 1 m sees 1e-6 of it.
  Scene scene;
  AddQuad(&scene.mesh, {-1000, -1000, 0}, {2000, 0, 0}, {0, 2000, 0}, Spectrum(0.4f));
  Light sun;
  sun.type = LightType::Directional;
  sun.intensity = Spectrum(2.f);
  Light second = sun;
  second.intensity = Spectrum(1.f);
  scene.lights = {sun, second};
  ExpectIrradiance(At(scene, {0, 0, 1}, {0, 0, -1}, 4096), 0.4 * 3);
}

TEST(PathTracedIrradiance, GradientSkyOverAPlane) {
  // pi H + 2 pi (Z - H) / 3; upright, pi H / 2 + 2 (Z - H) / 3.
  Scene scene;
  AddQuad(&scene.mesh, {5, 5, -1}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.f));
  Light sky;
  sky.type = LightType::GradientSky;
  sky.intensity = Spectrum(4.f);
  sky.horizon = Spectrum(1.f);
  scene.lights = {sky};
  ExpectIrradiance(At(scene, {}, {0, 0, 1}), 3 * kPi);
  ExpectIrradiance(At(scene, {}, {0, 1, 0}), kPi / 2 + 2);
}

TEST(PathTracedIrradiance, PenumbraOfASun) {
  const float size = 0.04f;
  const Scene scene = ScreenUnderSun(size);
  for (const float x : {-0.01f, 0.f, 0.005f, 0.015f}) {
    // But for the square of the sun's size.
    ExpectIrradiance(At(scene, {x, 0, 0}, {0, 0, 1}), Penumbra(double(x), double(size)), 1e-3);
  }
  EXPECT_EQ(At(scene, {-0.03f, 0, 0}, {0, 0, 1}).irradiance.g, 0);
  EXPECT_NEAR(At(scene, {0.03f, 0, 0}, {0, 0, 1}).irradiance.g, 1, 1e-4);
}

TEST(PathTracedIrradiance, SkyOverPlaneAndBehindBlocker) {
  Scene scene;
  Light sky;
  sky.type = LightType::Sky;
  sky.intensity = Spectrum(2.f);
  scene.lights = {sky};
  AddQuad(&scene.mesh, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, Spectrum(0.f));
  ExpectIrradiance(At(scene, {0, 0, 0}, {0, 0, 1}, 64), 2 * kPi);
  // A black unit square over the corner takes its view factor away.
  AddQuad(&scene.mesh, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.f));
  ExpectIrradiance(At(scene, {0, 0, 0}, {0, 0, 1}), 2 * kPi * (1 - 0.1385316060));
}

TEST(PathTracedIrradiance, BlockerBetweenSquares) {
  // Exchange of two unit squares at gap 1 with an opaque 0.5 x 0.5 square half way: the mean
  // irradiance of the lower.
  for (const auto& [corner, expected] :
       {std::pair(0.f, 0.1498686718), std::pair(0.25f, 0.0995062946)}) {
    Scene scene = SquareLamp();
    AddQuad(&scene.mesh, {corner, corner, 0.5f}, {0.5f, 0, 0}, {0, 0.5f, 0}, Spectrum(0.f));
    std::vector<ReceiverPoint> points;
    const int n = 64;
    for (int i = 0; i < n * n; ++i) {
      points.push_back(
          {{(float(i % n) + 0.5f) / n, (float(i / n) + 0.5f) / n, 0}, {0, 0, 1}, {0, 0, 1}});
    }
    PathTracedIrradianceOptions options;
    options.samples = 256;
    double mean = 0, variance = 0;
    for (const IrradianceEstimate& e : PathTracedIrradiance(scene).Estimate(points, options)) {
      mean += e.irradiance.g / (n * n);
      variance += double(e.standardError.g) * e.standardError.g / (n * n) / (n * n);
    }
    // The midpoint rule over a function with a second derivative below 4 misses by less than 4 /
    // (12 n^2).
    EXPECT_NEAR(mean, expected, 4 * std::sqrt(variance) + 4.0 / (12 * n * n));
    EXPECT_LT(std::sqrt(variance), 1e-3 * expected);
  }
}

TEST(PathTracedIrradiance, EmitterBesideReceiver) {
  // 1 mm under a square lamp of 1 m a facet sees nothing else: F = 1 less (distance / half side)^2
  // or so.
  ExpectIrradiance(At(SquareLamp(), {0.5f, 0.5f, 0.999f}, {0, 0, 1}), 1, 2e-5);
  // In the edge between a lamp and the wall it stands on, half the wall's hemisphere is the lamp: F
  // = 1/2.
  Scene scene;
  AddQuad(&scene.mesh, {0, -1, 0}, {0, 2, 0}, {0, 0, 2}, Spectrum(0.f), Spectrum(1.f), 8);
  ExpectIrradiance(At(scene, {0.0005f, 0, 0}, {0, 0, 1}), 0.5, 1e-3);
}

TEST(PathTracedIrradiance, SidesThatEmit) {
  Scene scene = SquareLamp();
  const Vec3f above(0, 0, 2), below(0, 0, 0), up(0, 0, 1), down(0, 0, -1);
  EXPECT_EQ(At(scene, above, down).irradiance, Spectrum(0.f));
  scene.mesh.faceFlags = {kEmitsFront | kEmitsBack, kEmitsFront | kEmitsBack};
  ExpectIrradiance(At(scene, above, down), 0.1385316060);
  ExpectIrradiance(At(scene, below, up), 0.1385316060);
  scene.mesh.faceFlags = {kEmitsBack, kEmitsBack};
  ExpectIrradiance(At(scene, above, down), 0.1385316060);
  EXPECT_EQ(At(scene, below, up).irradiance, Spectrum(0.f));
}

TEST(PathTracedIrradiance, BothSidesReflectAndBlock) {
  // A furnace whose walls are wound outward but emit from the back is the same furnace.
  Scene scene = FurnaceCube(0.5f);
  for (size_t face = 0; face < scene.mesh.triangles.size(); ++face) {
    std::swap(scene.mesh.triangles[face][1], scene.mesh.triangles[face][2]);
    scene.mesh.faceFlags[face] = kEmitsBack | kRewound;
  }
  ExpectIrradiance(At(scene, {0.5f, 0.5f, 0}, {0, 0, 1}), 2);
  EXPECT_EQ(At(scene, {0.5f, 0.5f, 0}, {0, 0, -1}).irradiance, Spectrum(0.f)) << "a leak";
}

TEST(PathTracedIrradiance, ShadingNormalWithinGeometricHemisphere) {
  // Under an even sky of radiance 1/pi a facet tilted by t from its geometric normal loses the part
  // of its hemisphere under the horizon: E = (1 + cos t) / 2.
  Scene scene;
  Light sky;
  sky.type = LightType::Sky;
  sky.intensity = Spectrum(float(1 / kPi));
  scene.lights = {sky};
  const float tilt = 0.5f;
  ExpectIrradiance(At(scene, {0, 0, 0}, {std::sin(tilt), 0, std::cos(tilt)}, 4096, {0, 0, 1}),
                   (1 + std::cos(tilt)) / 2);
}

TEST(PathTracedIrradiance, ManyLampsOfUnequalPower) {
  // 16 x 16 small lamps over a plane, one of them a thousand times as bright; each as good as a
  // point.
  Scene scene;
  double expected = 0;
  const Vec3f receiver(0.3f, -0.2f, 0);
  for (int i = 0; i < 256; ++i) {
    const Vec3f p(float(i % 16) - 7.5f, float(i / 16) - 7.5f, 3);
    const float exitance = i == 100 ? 1000.f : 1.f, side = 0.02f;
    AddQuad(&scene.mesh, p - Vec3f(side, side, 0) * 0.5f, {0, side, 0}, {side, 0, 0}, Spectrum(0.f),
            Spectrum(exitance));
    const double d2 = LengthSquared(p - receiver);
    expected += exitance / kPi * side * side * 9 / (d2 * d2);
  }
  ExpectIrradiance(At(scene, receiver, {0, 0, 1}), expected, 2e-4);
}

TEST(PathTracedIrradiance, SameBitsForAnyThreadCount) {
  const Scene scene = BoxRoom(1, 0.7f, 3);
  std::vector<ReceiverPoint> points;
  for (int i = 0; i < 40; ++i) {
    points.push_back({{0.025f * float(i), 0.4f, 0}, {0, 0, 1}, {0, 0, 1}});
  }
  PathTracedIrradianceOptions options;
  options.samples = 64;
  const PathTracedIrradiance tracer(scene);
  SetThreadCount(1);
  const auto one = tracer.Estimate(points, options);
  SetThreadCount(2);
  const auto two = tracer.Estimate(points, options);
  SetThreadCount(0);
  for (size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(one[i].irradiance, two[i].irradiance);
    EXPECT_EQ(one[i].standardError, two[i].standardError);
  }
}

TEST(PathTracedIrradiance, StandardErrorIsHonest) {
  // Over 400 independent estimates of a known value the mean squared miss, in units of the stated
  // error, is 1; its own spread is near 0.1 (400 values of Student's t with 15 degrees of freedom,
  // variance 15/13).
  const Scene scene = BoxRoom(1, 0.5f, 1);
  const std::vector<ReceiverPoint> points(400, {{0.25f, 0.25f, 0}, {0, 0, 1}, {0, 0, 1}});
  PathTracedIrradianceOptions options;
  options.samples = 64;
  double squares = 0;
  for (const IrradianceEstimate& e : PathTracedIrradiance(scene).Estimate(points, options)) {
    squares += std::pow((e.irradiance.g - 0.32181) / e.standardError.g, 2) / 400;
  }
  EXPECT_NEAR(squares, 15.0 / 13, 0.4);
}

TEST(PathTracedIrradiance, RefusesAndCancels) {
  const Scene scene = SquareLamp();
  PathTracedIrradianceOptions options;
  options.samples = 1;
  const PathTracedIrradiance tracer(scene);
  const std::vector<ReceiverPoint> points(3, {{0, 0, 0}, {0, 0, 1}, {0, 0, 1}});
  EXPECT_THROW(tracer.Estimate(points, options), Error);
  EXPECT_THROW(tracer.Estimate(points, {}, [](double, const char*) { return false; }), Cancelled);
  EXPECT_EQ(At(scene, {0, 0, 0}, {0, 0, 0}).irradiance, Spectrum(0.f)) << "no normal at all";
}

}  // namespace
}  // namespace lambert
