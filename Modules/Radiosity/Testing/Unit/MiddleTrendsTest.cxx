// What middles of triangles tell of others that are alike.
#include "Radiosity/Core/MiddleTrends.h"

#include <gtest/gtest.h>

#include "Common/Core/Random.h"

namespace lambert {
namespace {

TEST(MiddleTrends, ArePartsOfWhatIsExpectedTogether) {
  // Dark ones beside bright ones: a middle that has light where none was expected is no multiple.
  MiddleTrends trends;
  const MiddleTrends::Kind kind = MiddleTrends::KindOf(0.01, 1e-4, false);
  for (int i = 0; i < 50; ++i) {
    trends.Add(kind, 1.05, 1);
    trends.Add(kind, 0.001, 0);
  }
  EXPECT_NEAR(trends.Of(kind), 0.051, 1e-3);
  EXPECT_EQ(trends.Of(MiddleTrends::KindOf(0.04, 1e-4, false)), 0) << "larger ones";
  EXPECT_EQ(trends.Of(MiddleTrends::KindOf(0.01, 4e-3, false)), 0) << "of more error";
  EXPECT_EQ(trends.Of(MiddleTrends::KindOf(0.01, 1e-4, true)), 0) << "from the last cut";
}

TEST(MiddleTrends, AreNoneWhereTheyMayBeChance) {
  Random random(3);
  MiddleTrends trends;
  const MiddleTrends::Kind scattered = MiddleTrends::KindOf(1, 1, false),
                           few = MiddleTrends::KindOf(8, 1, false);
  for (int i = 0; i < 100; ++i) trends.Add(scattered, 0.5 + random.UniformDouble(), 1);
  for (int i = 0; i < 4; ++i) trends.Add(few, 2, 1);
  EXPECT_LT(std::abs(trends.Of(scattered)), 0.03) << "a mean scatters by 0.029";
  EXPECT_EQ(trends.Of(few), 0);
}

TEST(MiddleTrends, AreNoneWithoutLight) {
  MiddleTrends trends;
  const MiddleTrends::Kind kind = MiddleTrends::KindOf(0, 0, false);
  for (int i = 0; i < 20; ++i) trends.Add(kind, 0, 0);
  EXPECT_EQ(trends.Of(kind), 0);
}

}  // namespace
}  // namespace lambert
