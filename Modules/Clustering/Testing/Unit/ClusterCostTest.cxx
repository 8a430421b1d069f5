#include "Clustering/Core/ClusterCost.h"

#include <gtest/gtest.h>

#include "Common/Core/Random.h"

namespace lambert {
namespace {

ClusterMoments RandomMoments(Random* random, float thickness) {
  const auto point = [&] {
    return Vec3f(random->Uniform(), random->Uniform(), thickness * random->Uniform());
  };
  ClusterMoments m = ClusterMoments::OfTriangle(point(), point(), point());
  for (int i = 0; i < 10; ++i)
    m = ClusterMoments::Join(m, ClusterMoments::OfTriangle(point(), point(), point()));
  m.perimeter = 4;
  return m;
}

TEST(ClusterCost, FitErrorIsTheSmallestEigenvalue) {
  // Against the power of the shifted matrix: the largest eigenvalue of (trace I - Z) is trace minus
  // the smallest of Z.
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const ClusterMoments m = RandomMoments(&random, i % 2 ? 1.f : 0.05f);
    const double trace = double(m.xx) + m.yy + m.zz;
    Vec3d v{0.3, 0.5, 0.8};
    double largest = 0;
    for (int step = 0; step < 3000; ++step) {
      const Vec3d w{trace * v.x - (m.xx * v.x + m.xy * v.y + m.zx * v.z),
                    trace * v.y - (m.xy * v.x + m.yy * v.y + m.yz * v.z),
                    trace * v.z - (m.zx * v.x + m.yz * v.y + m.zz * v.z)};
      largest = Length(w);
      v = Normalize(w);
    }
    const double expected = (trace - largest) / (3.0 * m.faces);
    // Two steps of a cubically convergent iteration; ranks are an eighth of an octave wide.
    EXPECT_NEAR(m.FitError(), expected, 0.02 * expected + 1e-9);
    EXPECT_LE(m.FitError(), expected * (1 + 1e-6) + 1e-12);
  }
}

TEST(ClusterCost, IsTheSameFromBothEnds) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const ClusterMoments a = RandomMoments(&random, 0.2f), b = RandomMoments(&random, 0.3f);
    EXPECT_EQ(RankOfJoining(a, b, 0.5, 0.01), RankOfJoining(b, a, 0.5, 0.01));
  }
}

TEST(ClusterCost, PrefersPlanarThenSmallThenCompact) {
  const auto square = [](Vec3f corner, Vec3f u, Vec3f v) {
    ClusterMoments m =
        ClusterMoments::Join(ClusterMoments::OfTriangle(corner, corner + u, corner + u + v),
                             ClusterMoments::OfTriangle(corner, corner + u + v, corner + v));
    m.perimeter = 2 * (Length(u) + Length(v));
    return m;
  };
  const ClusterMoments a = square({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const ClusterMoments beside = square({1, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const ClusterMoments wide = square({1, 0, 0}, {4, 0, 0}, {0, 1, 0});
  const ClusterMoments upright = square({1, 0, 0}, {0, 0, 1}, {0, 1, 0});
  const CostRank flat = RankOfJoining(a, beside, 1, 0.01);
  EXPECT_LT(flat, RankOfJoining(a, wide, 1, 0.01));
  EXPECT_LT(RankOfJoining(a, wide, 1, 0.01), RankOfJoining(a, upright, 1, 0.01));
  EXPECT_LT(flat, RankOfJoining(a, beside, 0.1, 0.01));  // joined at a corner: a longer border
}

TEST(ClusterCost, ClosedAndEmptyClustersHaveFiniteRanks) {
  ClusterMoments up = ClusterMoments::OfTriangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  ClusterMoments down = ClusterMoments::OfTriangle({0, 0, 0}, {0, 1, 0}, {1, 0, 0});
  up.perimeter = down.perimeter = 3.5;
  // E_fit + k A alone: 0.01 m2, below what an open cluster of such spread costs.
  EXPECT_LT(RankOfJoining(up, down, 3.5, 0.01), RankOfJoining(up, down, 1, 0.01));
  const ClusterMoments point = ClusterMoments::OfTriangle({1, 1, 1}, {1, 1, 1}, {1, 1, 1});
  EXPECT_EQ(point.FitError(), 0);
  EXPECT_LE(RankOfJoining(point, point, 0, 0.01), RankOfJoining(up, point, 0, 0.01));
}

}  // namespace
}  // namespace lambert
