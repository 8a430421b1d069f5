// How many rays points get.
#include "Radiosity/Core/GatheredPoints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

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

/// Points below the small bright square.
std::vector<GatheredPoints::Point> PointsBelow() {
  std::vector<GatheredPoints::Point> points;
  AddPoints(0, 300, 1, &points);
  return points;
}

/// A small bright square above the origin, and a large lamp far from it; one light that hardly
/// sends any, as nothing bounds what lights bring.
class GatheredPointsTest : public ::testing::Test {
 protected:
  GatheredPointsTest() {
    testing::AddQuad(&modelled_.scene.mesh, {-0.035f, -0.045f, 0.8f}, {0, 0.1f, 0}, {0.1f, 0, 0},
                     Spectrum(0.9f));
    testing::AddQuad(&modelled_.scene.mesh, {100, -50, 0.1f}, {0, 100, 0}, {100, 0, 0},
                     Spectrum(0.f), Spectrum(1.f), 1, 1, 1);
    Light faint;
    faint.type = LightType::Point;
    faint.position = {0, 0, 1000};
    faint.intensity = Spectrum(1e-6f);
    modelled_.scene.lights = {faint};
    modelled_.Model();
    light_.Grow(*modelled_.hierarchy);
    for (VectorIrradiance& irradiance : light_.irradiance) irradiance.isotropic = Spectrum(160.f);
    gather_.emplace(*modelled_.hierarchy, *modelled_.rayScene, &light_);
  }

  testing::ModelledScene modelled_;
  ElementLight light_;
  std::optional<FinalGather> gather_;
};

// A few points that stand for hardly any area see a small bright square, a lamp lights all others:
// rays at those few gain next to nothing for the error, but would be seen to scatter.
TEST_F(GatheredPointsTest, ScatterIsNotSeenWhereItCountsLittle) {
  std::vector<GatheredPoints::Point> points;
  constexpr int kFew = 300;
  AddPoints(0, kFew, 1e-6f, &points);
  AddPoints(150, 20 * kFew, 1, &points);

  GatheredPointsOptions options;
  options.noise = 0.08;
  GatheredPoints gathered(*gather_, options);
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

// One ray in many meets the square, so that hardly any number of them is enough.
TEST_F(GatheredPointsTest, ThoseThatWantTheMostRaysGetThem) {
  const std::vector<GatheredPoints::Point> points = PointsBelow();
  GatheredPointsOptions options;
  options.mostRays = 64;
  options.noise = 1e-3;
  GatheredPoints gathered(*gather_, options);
  int64_t rays = 0;
  gathered.At(points, &rays);
  EXPECT_GE(rays, options.mostRays / 2 * int64_t(points.size()));
}

TEST_F(GatheredPointsTest, AreImprovedByTheRaysThatTheyLack) {
  const std::vector<GatheredPoints::Point> points = PointsBelow();
  GatheredPointsOptions loose;
  loose.noise = 1;
  GatheredPoints gathered(*gather_, loose);
  int64_t rays = 0;
  const auto scatter = [&] {
    double sum = 0;
    for (const auto& light : gathered.At(points, &rays)) sum += double(light.variance);
    return sum;
  };
  const double before = scatter();
  GatheredPointsOptions tight = loose;
  tight.noise = 1e-3;
  tight.firstRays = 16;
  const int64_t raysBefore = rays;
  gathered.Improve(tight, &rays);
  EXPECT_GE(rays - raysBefore, tight.mostRays / 2 * int64_t(points.size()));
  EXPECT_LT(scatter(), 0.25 * before);

  // They lack nothing more.
  const int64_t raysAfter = rays;
  gathered.Improve(tight, &rays);
  EXPECT_LT(rays - raysAfter, (raysAfter - raysBefore) / 100);
}

}  // namespace
}  // namespace lambert
