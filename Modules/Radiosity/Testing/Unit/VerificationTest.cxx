// When attempts to meet an error are given up.
#include "Radiosity/Core/Verification.h"

#include <gtest/gtest.h>

#include "Common/Testing/SolutionFixtures.h"
#include "Radiosity/Core/HierarchicalRadiosity.h"

namespace lambert {
namespace {

/// What is said after attempts that found `errors`, at a request of 0.1 and a patience of two.
std::string VerdictOf(const std::vector<double>& errors) {
  const Scene scene;
  HierarchicalRadiosityOptions options;
  options.error = 0.1;
  std::vector<IterationRecord> history;
  for (const double error : errors) {
    history.emplace_back();  // An iteration that was not verified does not count.
    history.emplace_back().error = error;
  }
  Verification verification(scene, options, 2);
  verification.Recall(history);
  return verification.Verdict();
}

TEST(VerificationTest, TakesWhatIsNotVerifiedForMet) { EXPECT_EQ(VerdictOf({}), "error"); }

TEST(VerificationTest, IsMetALittleBelowTheRequest) {
  EXPECT_EQ(VerdictOf({0.2, 0.094}), "error");
  EXPECT_EQ(VerdictOf({0.2, 0.099}), "");
}

TEST(VerificationTest, GivesUpAfterAttemptsThatGainTooLittle) {
  EXPECT_EQ(VerdictOf({0.5, 0.49}), "");
  EXPECT_EQ(VerdictOf({0.5, 0.49, 0.48}), "floor");
  EXPECT_EQ(VerdictOf({0.5, 0.49, 0.3, 0.29}), "");  // One that gains begins anew.
  EXPECT_EQ(VerdictOf({0.5, 0.49, 0.3, 0.29, 0.31}), "floor");
}

TEST(VerificationTest, IsSureWhereTheWholeIntervalIsMet) {
  // A furnace 10 % too bright.
  const Scene scene = testing::BlackFurnace();
  const RadiositySolution solution = testing::FlatSolution(scene, 1.1f, 3, false);
  HierarchicalRadiosityOptions options;
  options.verificationPoints = 500;
  options.error = 0.12;
  Verification loose(scene, options, 1);
  EXPECT_TRUE(loose.IsSurelyMet(solution, 0));
  const double looked = loose.Error();
  EXPECT_EQ(loose.Measure(solution), looked) << "at the same points";
  EXPECT_EQ(loose.Verdict(), "error");
  options.error = 0.1;
  Verification tight(scene, options, 1);
  EXPECT_FALSE(tight.IsSurelyMet(solution, 0));
}

/// What a look finds of a furnace a 25th of which is twice as bright, an rms of 0.2 that few points
/// hold; `isMet` tells whether it is met.
double LookedAt(const HierarchicalRadiosityOptions& options, int64_t rays, bool* isMet) {
  const Scene scene = testing::BlackFurnace();
  Verification verification(scene, options, 1);
  *isMet = verification.IsSurelyMet(testing::WithBrightPatch(scene), rays);
  return verification.Error();
}

TEST(VerificationTest, MorePointsDecideWhereTheRaysOfTheSolutionPayForThem) {
  HierarchicalRadiosityOptions options;
  options.verificationPoints = 500;
  bool isMet = false;
  options.error = LookedAt(options, 0, &isMet);  // It lies within the interval.
  const double few = LookedAt(options, 0, &isMet);
  EXPECT_FALSE(isMet);
  EXPECT_NE(LookedAt(options, 1'000'000'000, &isMet), few);
  options.timeLimit = 100;
  EXPECT_EQ(LookedAt(options, 1'000'000'000, &isMet), few) << "a time limit has none for more";
}

TEST(VerificationTest, IsSureFarBelowTheRequestHoweverWideTheInterval) {
  // By so few points that the interval ends half as high again as the error.
  HierarchicalRadiosityOptions options;
  options.verificationPoints = 100;
  bool isMet = false;
  options.error = LookedAt(options, 0, &isMet);
  const double error = options.error;
  options.error = 1.2 * error;
  EXPECT_EQ(LookedAt(options, 0, &isMet), error);
  EXPECT_FALSE(isMet);
  options.error = 1.3 * error;
  EXPECT_EQ(LookedAt(options, 0, &isMet), error);
  EXPECT_TRUE(isMet);
}

}  // namespace
}  // namespace lambert
