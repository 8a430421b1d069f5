// What is resident, and what still has room below a ceiling.
#include "Common/Core/MemoryCeiling.h"

#include <gtest/gtest.h>

#include <vector>

namespace lambert {
namespace {

constexpr size_t kSize = 64 << 20;

// Other parts of the process hold still: a tenth of what is taken covers pages of their own.
TEST(MemoryCeilingTest, SeesWhatIsTaken) {
  const int64_t before = ResidentMemoryBytes();
  ASSERT_GT(before, 0);
  const std::vector<char> taken(kSize, 1);
  EXPECT_NEAR(double(ResidentMemoryBytes() - before), double(kSize), 0.1 * double(kSize));
}

TEST(MemoryCeilingTest, HasRoomUpToTheCeiling) {
  const MemoryCeiling none, ceiling(double(ResidentMemoryBytes() + int64_t(kSize)) / 1e6);
  EXPECT_TRUE(none.HasRoomFor(1e15));
  EXPECT_TRUE(ceiling.HasRoomFor(0.9 * double(kSize)));
  EXPECT_FALSE(ceiling.HasRoomFor(1.1 * double(kSize)));
}

// Small pieces that were freed stay with the process until they are asked back.
TEST(MemoryCeilingTest, CountsWhatWasFreedAsRoom) {
  std::vector<std::vector<char>> pieces(kSize / 1024, std::vector<char>(1000, 1));
  const MemoryCeiling ceiling(double(ResidentMemoryBytes()) / 1e6);
  EXPECT_FALSE(ceiling.HasRoomFor(0.5 * double(kSize)));
  pieces = {};
  EXPECT_TRUE(ceiling.HasRoomFor(0.5 * double(kSize)));
}

}  // namespace
}  // namespace lambert
