// The closed form against published view factors: area to area by cubature of the exact
// differential form factor.
#include "Common/Core/PolygonIrradiance.h"

#include <gtest/gtest.h>

#include <vector>

#include "Common/Core/Spectrum.h"

namespace lambert {
namespace {

using Polygon = std::vector<Vec3f>;

Vec3d IrradianceOf(const Polygon& polygon, const Vec3f& x) {
  return PolygonIrradiance(polygon.data(), int(polygon.size()), x);
}

double FormFactorAt(const Polygon& polygon, const Vec3f& x, const Vec3f& n) {
  return Dot(PolygonIrradianceAbove(polygon.data(), int(polygon.size()), x, n), Vec3d(n));
}

/// Mean over the triangle abc of the form factor to `polygon`, by the midpoint rule on n x n cells:
/// exact to O(1/n^2) where the integrand is smooth, O(1/n) along a contact line.
double MeanFormFactor(const Vec3f& a, const Vec3f& b, const Vec3f& c, const Polygon& polygon,
                      int n) {
  const Vec3f normal = Normalize(Cross(b - a, c - a));
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n - i; ++j) {
      const auto at = [&](float u, float v) {
        return a + (b - a) * (u / float(n)) + (c - a) * (v / float(n));
      };
      sum += FormFactorAt(polygon, at(float(i) + 1 / 3.f, float(j) + 1 / 3.f), normal);
      if (j + 1 < n - i)
        sum += FormFactorAt(polygon, at(float(i) + 2 / 3.f, float(j) + 2 / 3.f), normal);
    }
  }
  return sum / (double(n) * n);
}

double MeanOverRectangle(const Vec3f& o, const Vec3f& u, const Vec3f& v, const Polygon& polygon,
                         int n) {
  return 0.5 * (MeanFormFactor(o, o + u, o + u + v, polygon, n) +
                MeanFormFactor(o, o + u + v, o + v, polygon, n));
}

// A square of side 1 at z = h, emitting downward.
Polygon Ceiling(float h, float x0 = 0, float y0 = 0, float a = 1, float b = 1) {
  return {{x0, y0, h}, {x0, y0 + b, h}, {x0 + a, y0 + b, h}, {x0 + a, y0, h}};
}

TEST(PolygonIrradiance, DifferentialAreaUnderASquare) {
  // Single precision of the corners bounds the digits.
  EXPECT_NEAR(FormFactorAt(Ceiling(1), {0, 0, 0}, {0, 0, 1}), 0.1385316060, 1e-7);
  EXPECT_NEAR(FormFactorAt(Ceiling(1), {0.5f, 0.5f, 0}, {0, 0, 1}), 0.2394564705, 1e-7);
}

TEST(PolygonIrradiance, DifferentialAreaAcrossARectangle) {
  EXPECT_NEAR(FormFactorAt(Ceiling(1), {0, 0, 0}, {1, 0, 0}), 0.0557341970, 1e-7);
  EXPECT_NEAR(FormFactorAt(Ceiling(0.5f, 0, 0, 2, 1), {0, 0, 0}, {1, 0, 0}), 0.1587748045, 1e-7);
}

TEST(PolygonIrradiance, VectorOfASquareAndOfATriangle) {
  const Vec3d square = IrradianceOf(Ceiling(1), {0, 0, 0});
  EXPECT_NEAR(square.x, 0.0557341970, 1e-7);
  EXPECT_NEAR(square.y, 0.0557341970, 1e-7);
  EXPECT_NEAR(square.z, 0.1385316060, 1e-7);
  Polygon triangle{{.2f, .1f, 1}, {.5f, 1.3f, 1.4f}, {1.5f, .3f, .8f}};
  const Vec3d v = IrradianceOf(triangle, {.3f, .3f, 0});
  EXPECT_NEAR(std::fabs(v.x), 0.0479419798, 1e-6);
  EXPECT_NEAR(std::fabs(v.y), 0.0203313635, 1e-6);
  EXPECT_NEAR(std::fabs(v.z), 0.1285844918, 1e-6);
}

TEST(PolygonIrradiance, NothingFromBehind) {
  EXPECT_EQ(IrradianceOf(Ceiling(1), {0.5f, 0.5f, 2}), Vec3d());
  EXPECT_EQ(FormFactorAt(Ceiling(1), {0.5f, 0.5f, 0}, {0, 0, -1}), 0);
}

TEST(PolygonIrradiance, APointOnThePolygonOrOnItsEdgeStaysFinite) {
  const Polygon wall{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};  // faces +x
  for (const Vec3f& x : {Vec3f(0, .5f, .5f), Vec3f(0, .5f, 0), Vec3f(0, 0, 0)}) {
    const double f = FormFactorAt(wall, x, {0, 0, 1});
    EXPECT_TRUE(std::isfinite(f));
    EXPECT_GE(f, 0);
    EXPECT_LE(f, 0.5 + 1e-9);
  }
}

// Rounding must not tell on which side of itself a point of the polygon lies: found in a random
// scene, where the quadrangle gave minus the normal.
TEST(PolygonIrradiance, NothingFromThePolygonThatAPointLiesOn) {
  const Polygon quadrangle{{0.350636691f, 0.205235824f, 0.0753779113f},
                           {0.27547586f, 0.247327387f, 0.0839698613f},
                           {0.336982787f, 0.340242326f, 0.166835487f},
                           {0.380050182f, 0.327485383f, 0.169931844f}};
  const Vec3f x(0.324825674f, 0.268775046f, 0.112974666f), n(0.223732f, 0.562046f, -0.796272f);
  EXPECT_EQ(FormFactorAt(quadrangle, x, n), 0);
  EXPECT_EQ(FormFactorAt(quadrangle, x, -n), 0);
  EXPECT_EQ(IrradianceOf(quadrangle, x), Vec3d());
  // A hundred times as far as rounding goes is before it, which fills the hemisphere but for what
  // passes its nearest edge, some h / r of it with r = 0.03.
  const Vec3f front =
      Normalize(Cross(quadrangle[1] - quadrangle[0], quadrangle[2] - quadrangle[0]));
  EXPECT_NEAR(FormFactorAt(quadrangle, x + front * 1e-5f, -front), 1, 1e-3);
}

TEST(PolygonIrradiance, ParallelRectangles) {
  // Midpoint rule, 64 x 64 cells: below 1e-4 at a gap of the size of the squares.
  const Vec3f o(0, 0, 0), x(1, 0, 0), y(0, 1, 0);
  EXPECT_NEAR(MeanOverRectangle(o, x, y, Ceiling(1), 64), 0.1998248957, 1e-4);
  EXPECT_NEAR(MeanOverRectangle(o, x * 2.f, y, Ceiling(1, 0, 0, 2, 1), 64), 0.2858753849, 1e-4);
  EXPECT_NEAR(MeanOverRectangle(o, x, y, Ceiling(10), 16), 0.0031620568, 1e-6);
  EXPECT_NEAR(MeanOverRectangle(o, x, y, Ceiling(0.1f), 64), 0.8269945224, 1e-3);
  EXPECT_NEAR(MeanOverRectangle(o, x, y, Ceiling(1, 1, 0), 64), 0.0860504892, 1e-4);
  EXPECT_NEAR(MeanOverRectangle(o, x, y, Ceiling(1, 1, 1), 64), 0.0433274096, 1e-4);
}

TEST(PolygonIrradiance, PerpendicularRectangles) {
  const Polygon wall{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};  // x = 0, faces +x
  const Vec3f x(1, 0, 0), y(0, 1, 0);
  // With a common edge the integrand has a kink there: first order, 1/128 of it.
  EXPECT_NEAR(MeanOverRectangle({0, 0, 0}, x, y, wall, 128), 0.2000437761, 5e-4);
  EXPECT_NEAR(MeanOverRectangle({1, 0, 0}, x, y, wall, 64), 0.0328088267, 1e-5);
  EXPECT_NEAR(MeanOverRectangle({0, 1, 0}, x, y, wall, 128), 0.0405922301, 5e-4);
  EXPECT_NEAR(MeanOverRectangle({0, 2, 0}, x, y, wall, 64), 0.0043144144, 1e-5);
}

// A cube with one value a face, one face of exitance 1: the form factors above, solved.
TEST(PolygonIrradiance, CubeOfSixFaces) {
  const Vec3f x(1, 0, 0), y(0, 1, 0);
  const Polygon wall{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
  const double opposite = MeanOverRectangle({0, 0, 0}, x, y, Ceiling(1), 128);
  const double beside = MeanOverRectangle({0, 0, 0}, x, y, wall, 128);
  for (const double rho : {0.5, 0.8}) {
    double bright = 1, far = 0, side = 0;
    for (int sweep = 0; sweep < 500; ++sweep) {
      const double b = 1 + rho * (opposite * far + 4 * beside * side);
      const double f = rho * (opposite * bright + 4 * beside * side);
      side = rho * (beside * (bright + far) + (opposite + 2 * beside) * side);
      bright = b, far = f;
    }
    // The cubature's 3e-4 in a row sum, amplified by 1 / (1 - rho).
    EXPECT_NEAR(bright, rho == 0.5 ? 1.0909090981 : 1.5517241536, 3e-4 * 4 / (1 - rho));
    EXPECT_NEAR(far, rho == 0.5 ? 0.1817458261 : 0.6895510707, 3e-4 * 4 / (1 - rho));
    EXPECT_NEAR(side, rho == 0.5 ? 0.1818362689 : 0.6896811939, 3e-4 * 4 / (1 - rho));
  }
}

TEST(PolygonIrradiance, PolygonPairs) {
  const Polygon t3{{.2f, .1f, 1}, {.5f, 1.3f, 1.4f}, {1.5f, .3f, .8f}};
  EXPECT_NEAR(
      MeanFormFactor({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {{0, 0, 1}, {0, 1, 1}, {1, 0, 1}}, 64),
      0.1150492281, 1e-4);
  EXPECT_NEAR(MeanFormFactor({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, t3, 64), 0.1212798120, 1e-4);
}

TEST(PolygonIrradiance, CoaxialDiscs) {
  // The upper disc as a 16-gon of the same area: within 1 % of the disc's own view factor.
  const double side = std::sqrt(2 * kPi / (16 * std::sin(2 * kPi / 16)));
  Polygon disc;
  for (int i = 0; i < 16; ++i) {
    const double angle = -2 * kPi * i / 16;
    disc.push_back({float(side * std::cos(angle)), float(side * std::sin(angle)), 1});
  }
  double sum = 0, weight = 0;
  for (int i = 0; i < 200; ++i) {
    const double r = (i + 0.5) / 200;
    sum += r * FormFactorAt(disc, {float(r), 0, 0}, {0, 0, 1});
    weight += r;
  }
  EXPECT_NEAR(sum / weight, 0.3819660113, 0.004);
}

}  // namespace
}  // namespace lambert
