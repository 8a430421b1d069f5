#include "Common/Core/StageSeconds.h"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

namespace lambert::testing {

TEST(StageSeconds, SumsByNameInTheOrderOfEnding) {
  StageSeconds seconds;
  seconds.Add("links", 1);
  seconds.Add("gather", 2);
  seconds.Add("links", 3);
  ASSERT_EQ(seconds.All().size(), 2u);
  EXPECT_EQ(seconds.All()[0].first, "links");
  EXPECT_EQ(seconds.All()[0].second, 4);
  EXPECT_EQ(seconds.All()[1].second, 2);
}

TEST(StageSeconds, HandsOnWhatWorkReturns) {
  StageSeconds seconds;
  const std::unique_ptr<int> made = seconds.Time("making", [] { return std::make_unique<int>(7); });
  EXPECT_EQ(*made, 7);
  seconds.Time("nothing", [] {});
  ASSERT_EQ(seconds.All().size(), 2u);
  EXPECT_GE(seconds.All()[0].second, 0);
}

TEST(StageSeconds, CountsWhatThrew) {
  StageSeconds seconds;
  EXPECT_THROW(seconds.Time("failing", []() -> int { throw std::runtime_error("no"); }),
               std::runtime_error);
  EXPECT_EQ(seconds.All().size(), 1u);
}

}  // namespace lambert::testing
