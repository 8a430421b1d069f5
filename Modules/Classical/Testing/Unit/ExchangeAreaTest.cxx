// Exchange areas against published view factors.
#include "Classical/Core/ExchangeArea.h"

#include <gtest/gtest.h>

#include <vector>

#include "Common/Core/Random.h"

namespace lambert {
namespace {

using Polygon = std::vector<Vec3f>;

/// A convex polygon as a fan, each triangle cut n x n.
std::vector<ExchangeTriangle> Cut(const Polygon& polygon, int n = 1) {
  std::vector<ExchangeTriangle> triangles;
  for (size_t c = 2; c < polygon.size(); ++c) {
    const Vec3f &o = polygon[0], u = (polygon[c - 1] - o) / float(n),
                v = (polygon[c] - o) / float(n);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        const Vec3f p = o + u * float(i) + v * float(j);
        triangles.emplace_back(p, p + u, p + v);
        if (i + j < n - 1) triangles.emplace_back(p + u, p + u + v, p + v);
      }
    }
  }
  return triangles;
}

template <class Kernel>
double FormFactor(const Polygon& from, const Polygon& to, int n, const Kernel& kernel) {
  double sum = 0, area = 0;
  for (const ExchangeTriangle& a : Cut(from, n)) {
    area += double(a.area);
    for (const ExchangeTriangle& b : Cut(to, n)) sum += kernel(a, b);
  }
  return sum / area;
}

double ExactFormFactor(const Polygon& from, const Polygon& to, int n = 1) {
  return FormFactor(from, to, n, ExactExchangeArea);
}

/// [x0, x1] x [y0, y1] at height z, looking up or down.
Polygon Floor(float x0, float x1, float y0, float y1, float z, bool up) {
  Polygon p{{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
  if (!up) std::swap(p[1], p[3]);
  return p;
}
/// The wall x = 0, 0 <= y <= width, 0 <= z <= height, looking along +x.
Polygon Wall(float width, float height) {
  return {{0, 0, 0}, {0, width, 0}, {0, width, height}, {0, 0, height}};
}

// Apart from each other, the integrand of the outer quadrature is smooth: its points give six
// digits where the gap is as large as the triangles, and a thousandth where it is a tenth of them.
TEST(ExchangeArea, ParallelRectangles) {
  const auto parallel = [](float a, float b, float c) {
    return ExactFormFactor(Floor(0, a, 0, b, 0, true), Floor(0, a, 0, b, c, false));
  };
  EXPECT_NEAR(parallel(1, 1, 1), 0.1998248957, 1e-6);
  EXPECT_NEAR(parallel(2, 1, 1), 0.2858753849, 1e-5);
  EXPECT_NEAR(parallel(1, 1, 10), 0.0031620568, 1e-7);
  EXPECT_NEAR(parallel(1, 1, 0.1f), 0.8269945224, 1e-3);
  const auto shifted = [](float x, float y) {
    return ExactFormFactor(Floor(0, 1, 0, 1, 0, true), Floor(x, x + 1, y, y + 1, 1, false));
  };
  EXPECT_NEAR(shifted(1, 0), 0.0860504892, 1e-6);
  EXPECT_NEAR(shifted(1, 1), 0.0433274096, 1e-6);
  EXPECT_NEAR(shifted(2, 0), 0.0152754501, 1e-6);
}

// With a common edge or corner the integrand of the outer quadrature is x ln x at its ends, for
// which eight points are good to 1e-4.
TEST(ExchangeArea, PerpendicularRectangles) {
  const auto perpendicular = [](float w, float h) {
    return ExactFormFactor(Floor(0, w, 0, 1, 0, true), Wall(1, h));
  };
  EXPECT_NEAR(perpendicular(1, 1), 0.2000437761, 1e-4);
  EXPECT_NEAR(perpendicular(2, 1), 0.1164263014, 1e-4);
  EXPECT_NEAR(perpendicular(1, 2), 0.2328526028, 1e-4);
  const Polygon wall = Wall(1, 1);
  EXPECT_NEAR(ExactFormFactor(wall, Floor(1, 2, 0, 1, 0, true)), 0.0328088267, 1e-6);
  EXPECT_NEAR(ExactFormFactor(wall, Floor(0, 1, 1, 2, 0, true)), 0.0405922301, 1e-4);
  EXPECT_NEAR(ExactFormFactor(wall, Floor(0, 1, 2, 3, 0, true)), 0.0043144144, 1e-5);
}

// Skew triangles, some of them cut by each other's planes.
TEST(ExchangeArea, PolygonPairs) {
  const Polygon t1{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Polygon t3{{0.2f, 0.1f, 1}, {1.5f, 0.3f, 0.8f}, {0.5f, 1.3f, 1.4f}};
  const Polygon t3Down{t3[0], t3[2], t3[1]};
  EXPECT_NEAR(ExactFormFactor(t1, {{0, 0, 1}, {0, 1, 1}, {1, 0, 1}}), 0.1150492281496, 1e-6);
  EXPECT_NEAR(ExactFormFactor(t1, t3Down), 0.12127981201, 1e-6);
  const Polygon pentagon{{0, 0, 0}, {2, 0, 0}, {2.5f, 1, 0}, {1, 2, 0}, {-0.5f, 1, 0}};
  EXPECT_NEAR(ExactFormFactor(pentagon, t3Down), 0.0891642748988, 1e-5);
  EXPECT_EQ(ExactFormFactor(t1, t3), 0);  // from behind

  // A wall that starts below the floor: what is below counts for nothing.
  const Polygon floor = Floor(0, 1, 0, 1, 0, true);
  const Polygon deep{{0, 0, -1}, {0, 1, -1}, {0, 1, 1}, {0, 0, 1}};
  EXPECT_NEAR(ExactFormFactor(floor, deep), 0.2000437761, 1e-4);
}

// Discs of 64 corners, of the circle's area: a 64-gon differs from the circle in shape by 1e-3 of
// its radius.
TEST(ExchangeArea, CoaxialDiscs) {
  const auto disc = [](float radius, float z, bool up) {
    Polygon polygon;
    const double scale = std::sqrt(kPi / (32 * std::sin(kPi / 32)));
    for (int i = 0; i < 64; ++i) {
      const double angle = 2 * kPi * (up ? i : -i) / 64;
      polygon.push_back(
          {float(radius * scale * std::cos(angle)), float(radius * scale * std::sin(angle)), z});
    }
    return polygon;
  };
  EXPECT_NEAR(ExactFormFactor(disc(1, 0, true), disc(1, 1, false)), 0.3819660113, 1e-3);
  EXPECT_NEAR(ExactFormFactor(disc(0.5f, 0, true), disc(1, 1, false)), 0.4688711259, 1e-3);
}

// A cube's floor sees five other sides: together all there is, however finely it is cut.
TEST(ExchangeArea, RowsOfAClosedBoxSumToOne) {
  const std::vector<Polygon> sides{Floor(0, 1, 0, 1, 1, false),
                                   Wall(1, 1),
                                   {{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}},
                                   {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}},
                                   {{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}};
  for (const ExchangeTriangle& a : Cut(Floor(0, 1, 0, 1, 0, true), 6)) {
    double sum = 0;
    for (const Polygon& side : sides) {
      for (const ExchangeTriangle& b : Cut(side, 6)) sum += ExchangeArea(a, b) / double(a.area);
    }
    EXPECT_NEAR(sum, 1, 1e-3);  // what ExchangeArea promises
  }
}

// Seeded pairs, from touching to far: symmetric, bounded by both areas, and the chosen kernel near
// to the exact one.
TEST(ExchangeArea, SymmetricAndBounded) {
  Random random(11);
  const auto point = [&](float scale) {
    const float x = random.Uniform(), y = random.Uniform();
    return Vec3f(x - 0.5f, y - 0.5f, random.Uniform() - 0.5f) * scale;
  };
  int exchanging = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3f shift = point(i % 3 == 0 ? 8 : 2);
    const ExchangeTriangle a(point(1), point(1), point(1));
    const ExchangeTriangle b(point(1) + shift, point(1) + shift, point(1) + shift);
    const double forth = ExchangeArea(a, b), back = ExchangeArea(b, a);
    const double exact = ExactExchangeArea(a, b);
    const double smaller = std::min(double(a.area), double(b.area));
    ASSERT_GE(forth, 0);
    ASSERT_LE(forth, smaller * (1 + 1e-6));  // areas are floats
    // Triangles that pierce each other have singular integrands inside; elsewhere 5e-3 of what two
    // such triangles could exchange at that distance face to face.
    const double squared = LengthSquared(Vec3d(a.centroid) - Vec3d(b.centroid));
    const double reach = double(a.radius) + double(b.radius);
    if (squared > reach * reach) {
      const double most = double(a.area) * double(b.area) / (kPi * squared);
      ASSERT_NEAR(forth, back, 5e-3 * most);
      ASSERT_NEAR(forth, exact, 5e-3 * most);
    }
    if (!CanExchange(a, b)) {
      ASSERT_LE(exact, 1e-4 * smaller);
    }
    exchanging += forth > 0;
  }
  EXPECT_GT(exchanging, 4000);
}

}  // namespace
}  // namespace lambert
