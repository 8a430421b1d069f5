#include "Common/Core/Barycentric.h"

#include <gtest/gtest.h>

namespace lambert {
namespace {

const Vec3f kA{1, 1, 0}, kB{3, 1, 0}, kC{1, 5, 0};

TEST(Barycentric, WeighsCornersByWhereAPlaceLies) {
  const auto weights = BarycentricWeights(kA, kB, kC, kA * 0.5f + kB * 0.3f + kC * 0.2f);
  ASSERT_TRUE(weights);
  EXPECT_NEAR(weights->x, 0.5f, 1e-6f);
  EXPECT_NEAR(weights->y, 0.3f, 1e-6f);
  EXPECT_NEAR(weights->z, 0.2f, 1e-6f);
}

TEST(Barycentric, TakesTheNearestPlaceInThePlane) {
  const auto weights = BarycentricWeights(kA, kB, kC, {3, 1, 7});
  ASSERT_TRUE(weights);
  EXPECT_NEAR(weights->y, 1, 1e-6f);
}

TEST(Barycentric, IsNegativeOutside) {
  const auto weights = BarycentricWeights(kA, kB, kC, {0, 2, 0});
  ASSERT_TRUE(weights);
  EXPECT_LT(weights->y, 0);
}

TEST(Barycentric, HasNoneWithoutArea) {
  EXPECT_FALSE(BarycentricWeights(kA, kB, kA + (kB - kA) * 2.f, kA));
  EXPECT_FALSE(BarycentricWeights(kA, kA, kA, kA));
}

}  // namespace
}  // namespace lambert
