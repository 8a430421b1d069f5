#include "Common/Core/SobolPoint.h"

#include <gtest/gtest.h>

#include <vector>

namespace lambert {
namespace {

// Blocks beyond 2^24 take all bytes of a number.
TEST(SobolPoint, EveryBlockHasOnePointInEachBoxOfItsArea) {
  for (const uint32_t first : {0u, 64u, 0x05a3c940u, 0xffffffc0u}) {
    for (const uint64_t scramble : {uint64_t(0), uint64_t(0x123456789abcdef0)}) {
      for (uint32_t columns = 1; columns <= 64; columns *= 2) {
        std::vector<int> points(64, 0);
        for (uint32_t i = 0; i < 64; ++i) {
          const Vec2f p = SobolPoint(first + i, scramble);
          ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
          const uint32_t rows = 64 / columns;
          ++points[uint32_t(p.x * float(columns)) * rows + uint32_t(p.y * float(rows))];
        }
        EXPECT_EQ(points, std::vector<int>(64, 1));
      }
    }
  }
}

}  // namespace
}  // namespace lambert
