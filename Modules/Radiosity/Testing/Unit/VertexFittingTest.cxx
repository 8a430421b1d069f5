// Light at points that interpolates best.
#include "Radiosity/Core/VertexFitting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "Common/Core/Vector.h"

namespace lambert {
namespace {

/// The unit square in n x n x 2 triangles, lit as `light` says.
struct Grid {
  std::vector<Vec2f> places;
  std::vector<Spectrum> irradiance;
  std::vector<FittedTriangle> triangles;

  Grid(int n, const std::function<float(Vec2f)>& light) {
    for (int i = 0; i < (n + 1) * (n + 1); ++i) {
      places.push_back({float(i % (n + 1)) / float(n), float(i / (n + 1)) / float(n)});
      irradiance.emplace_back(light(places.back()));
    }
    for (int i = 0; i < n * n; ++i) {
      const int32_t a = i / n * (n + 1) + i % n, b = a + 1, c = b + n + 1, d = a + n + 1;
      for (const std::array<int32_t, 3>& t : {std::array{a, b, c}, std::array{a, c, d}}) {
        const Vec2f middle =
            (places[size_t(t[0])] + places[size_t(t[1])] + places[size_t(t[2])]) * (1 / 3.f);
        triangles.push_back({t, 0.5f / float(n * n), Spectrum(light(middle))});
      }
    }
  }
  /// Root of the mean squared error of `values`, interpolated, at the middles of the edges.
  double Error(const std::vector<Spectrum>& values,
               const std::function<float(Vec2f)>& light) const {
    double sum = 0;
    for (const FittedTriangle& t : triangles) {
      for (size_t c = 0; c < 3; ++c) {
        const size_t a = size_t(t.points[c]), b = size_t(t.points[(c + 1) % 3]);
        const double off =
            double((values[a].g + values[b].g) / 2) - double(light((places[a] + places[b]) * 0.5f));
        sum += off * off / double(3 * triangles.size());
      }
    }
    return std::sqrt(sum);
  }
};

TEST(VertexFitting, ABumpIsNotCutOff) {
  const auto bump = [](Vec2f p) { return p.x * (1 - p.x) + p.y * (1 - p.y); };
  const Grid grid(8, bump);
  const std::vector<Spectrum> fitted = FitVertices(grid.irradiance, grid.triangles);
  EXPECT_LT(grid.Error(fitted, bump), 0.6 * grid.Error(grid.irradiance, bump));
}

TEST(VertexFitting, ASlopeStaysAsItIs) {
  const auto slope = [](Vec2f p) { return 1 + p.x + 2 * p.y; };
  const Grid grid(4, slope);
  const std::vector<Spectrum> fitted = FitVertices(grid.irradiance, grid.triangles);
  for (size_t p = 0; p < fitted.size(); ++p) {
    EXPECT_NEAR(fitted[p].g, grid.irradiance[p].g, 1e-5);
  }
}

TEST(VertexFitting, AnEdgeDoesNotOvershoot) {
  const Grid grid(8, [](Vec2f p) { return p.x < 0.45f ? 0.f : 1.f; });
  for (const Spectrum& e : FitVertices(grid.irradiance, grid.triangles)) {
    EXPECT_GE(e.g, 0);
    EXPECT_LE(e.g, 1);
  }
}

}  // namespace
}  // namespace lambert
