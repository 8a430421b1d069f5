// How many rays points get.
#include "Radiosity/Core/GatheredPoints.h"

#include <gtest/gtest.h>

#include <cmath>

#include "SolverScenes.h"

namespace lambert {
namespace {

/// Points of a grid on z = 0, 1 mm apart from `x` on, that look up.
void AddPoints(float x, int count, float area, std::vector<GatheredPoints::Point>* points) {
  for (int i = 0; i < count; ++i) {
    GatherPoint at{{x + 0.001f * float(i % 30), 0.001f * float(i / 30), 0}, {0, 0, 1}, {0, 0, 1}};
    at.area = area;
    points->push_back({uint64_t(points->size()), at, false});
  }
}

// A few points that stand for hardly any area see a small bright square, a lamp lights all others:
// rays at those few gain next to nothing for the error, but would be seen to scatter.
TEST(GatheredPoints, ScatterIsNotSeenWhereItCountsLittle) {
  testing::ModelledScene modelled;
  testing::AddQuad(&modelled.scene.mesh, {-0.035f, -0.045f, 0.8f}, {0, 0.1f, 0}, {0.1f, 0, 0},
                   Spectrum(0.9f));
  testing::AddQuad(&modelled.scene.mesh, {100, -50, 0.1f}, {0, 100, 0}, {100, 0, 0}, Spectrum(0.f),
                   Spectrum(1.f), 1, 1, 1);
  // Where a light sends rays to points nothing bounds what they bring; this one sends hardly any.
  Light faint;
  faint.type = LightType::Point;
  faint.position = {0, 0, 1000};
  faint.intensity = Spectrum(1e-6f);
  modelled.scene.lights = {faint};
  modelled.Model();
  ElementLight light;
  light.Grow(*modelled.hierarchy);
  for (VectorIrradiance& irradiance : light.irradiance) irradiance.isotropic = Spectrum(160.f);
  const FinalGather gather(*modelled.hierarchy, *modelled.rayScene, &light);
  std::vector<GatheredPoints::Point> points;
  constexpr int kFew = 300;
  AddPoints(0, kFew, 1e-6f, &points);
  AddPoints(150, 20 * kFew, 1, &points);

  GatheredPointsOptions options;
  options.noise = 0.08;
  GatheredPoints gathered(gather, options);
  int64_t rays = 0;
  const std::vector<GatheredPoints::Light> lights = gathered.At(points, &rays);
  double mean = 0, square = 0;
  for (int i = 0; i < kFew; ++i) {
    const double e = double(lights[size_t(i)].irradiance.g);
    mean += e / kFew, square += e * e / kFew;
  }
  // Where all see the same, 3 mm from each other, 144 W/m2 of a square of 0.01 m2 at 0.8 m.
  EXPECT_NEAR(mean, 144 * 0.0156 / kPi, 0.05);
  // The lamp gives all others 1 W/m2.
  EXPECT_LT(std::sqrt(square - mean * mean), 0.2);
}

}  // namespace
}  // namespace lambert
