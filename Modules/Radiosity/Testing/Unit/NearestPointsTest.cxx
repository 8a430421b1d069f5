#include "Radiosity/Core/NearestPoints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"

namespace lambert {
namespace {

std::vector<Vec3f> RandomPoints(size_t count) {
  Random random(7);
  std::vector<Vec3f> points(count);
  for (Vec3f& p : points) p = {random.Uniform(), random.Uniform(), 0.1f * random.Uniform()};
  return points;
}

/// Squares of the distances of the nearest, by asking all.
std::vector<float> SquaresByAll(const std::vector<Vec3f>& points, const Vec3f& x, size_t most) {
  std::vector<float> squares;
  for (const Vec3f& p : points) squares.push_back(LengthSquared(p - x));
  std::sort(squares.begin(), squares.end());
  squares.resize(std::min(most, squares.size()));
  return squares;
}

TEST(NearestPoints, AreThoseThatAllPointsTell) {
  for (const size_t count : {size_t(3), size_t(1000), size_t(5 * NearestPoints::kBlockSize)}) {
    const std::vector<Vec3f> points = RandomPoints(count);
    const NearestPoints nearest(points);
    Random random(11);
    for (int trial = 0; trial < 40; ++trial) {
      const Vec3f x(1.2f * random.Uniform() - 0.1f, random.Uniform(), 0.2f * random.Uniform());
      int32_t found[20];
      float squares[20];
      const int size = nearest.Find(x, 20, found, squares);
      const std::vector<float> expected = SquaresByAll(points, x, 20);
      ASSERT_EQ(size_t(size), expected.size());
      for (int i = 0; i < size; ++i) {
        EXPECT_FLOAT_EQ(squares[i], expected[size_t(i)]);
        EXPECT_FLOAT_EQ(squares[i], LengthSquared(points[size_t(found[i])] - x));
      }
    }
  }
}

TEST(NearestPoints, OrderNamesEachPointOnce) {
  std::vector<int32_t> order =
      NearestPoints(RandomPoints(size_t(3 * NearestPoints::kBlockSize + 1))).InOrder();
  std::sort(order.begin(), order.end());
  std::vector<int32_t> all(order.size());
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(order, all);
}

TEST(NearestPoints, AnyNumberOfThreadsFindsTheSameOfManyThatLieEquallyNear) {
  // A grid: nearly every distance occurs more than once.
  std::vector<Vec3f> grid;
  for (int i = 0; i < 400; ++i) {
    for (int j = 0; j < 400; ++j) grid.emplace_back(float(i), float(j), 0.f);
  }
  const auto found = [&](int threads) {
    SetThreadCount(threads);
    const NearestPoints nearest(grid);
    std::vector<int32_t> all(grid.size() * 6);
    std::vector<float> squares(all.size());
    for (size_t i = 0; i < grid.size(); ++i) nearest.Find(grid[i], 6, &all[6 * i], &squares[6 * i]);
    SetThreadCount(0);
    return all;
  };
  EXPECT_EQ(found(1), found(4));
}

TEST(NearestPoints, NothingIsFoundAmongNone) {
  int32_t found = -1;
  float square = -1;
  EXPECT_EQ(NearestPoints({}).Find({0, 0, 0}, 1, &found, &square), 0);
}

}  // namespace
}  // namespace lambert
