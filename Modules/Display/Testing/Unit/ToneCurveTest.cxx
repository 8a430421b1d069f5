#include "Display/Core/ToneCurve.h"

#include <gtest/gtest.h>

namespace lambert {
namespace {

TEST(ToneCurve, PhotographicHasItsKnownValues) {
  // L (1 + L / white^2) / (1 + L) with white 2: 1 to 1.25 / 2, 2 to 1.
  EXPECT_DOUBLE_EQ(EvaluateToneCurve(ToneCurve::Photographic, 0, 2), 0);
  EXPECT_DOUBLE_EQ(EvaluateToneCurve(ToneCurve::Photographic, 1, 2), 0.625);
  EXPECT_DOUBLE_EQ(EvaluateToneCurve(ToneCurve::Photographic, 2, 2), 1);
}

TEST(ToneCurve, LinearLeavesLightAsItIs) {
  EXPECT_DOUBLE_EQ(EvaluateToneCurve(ToneCurve::Linear, 0.18, 5), 0.18);
  EXPECT_DOUBLE_EQ(EvaluateToneCurve(ToneCurve::Linear, 3, 5), 3);
}

TEST(ToneCurve, FilmicHasItsKnownValues) {
  // By hand from the constants of hable2010: f(x) = (x (0.15 x + 0.05) + 0.004) /
  // (x (0.15 x + 0.5) + 0.06) - 1/15 at 0.36, 2 and 11.2.
  const double f036 = 0.04144 / 0.25944 - 1 / 15., f2 = 0.704 / 1.66 - 1 / 15.;
  const double f112 = 19.38 / 24.476 - 1 / 15.;
  EXPECT_NEAR(EvaluateToneCurve(ToneCurve::Filmic, 0, kFilmicWhite), 0, 1e-12);
  EXPECT_NEAR(EvaluateToneCurve(ToneCurve::Filmic, 0.18, kFilmicWhite), f036 / f112, 1e-9);
  EXPECT_NEAR(EvaluateToneCurve(ToneCurve::Filmic, 1, kFilmicWhite), f2 / f112, 1e-9);
  EXPECT_NEAR(EvaluateToneCurve(ToneCurve::Filmic, kFilmicWhite, kFilmicWhite), 1, 1e-12);
}

TEST(ToneCurve, AreMonotonous) {
  for (const ToneCurve curve : {ToneCurve::Photographic, ToneCurve::Linear, ToneCurve::Filmic}) {
    double last = 0;
    for (double value = 1e-3; value < 4; value *= 1.3) {
      EXPECT_GT(EvaluateToneCurve(curve, value, 4), last) << value;
      last = EvaluateToneCurve(curve, value, 4);
    }
  }
}

TEST(ToneCurve, ALightSurroundDarkensAndADarkOneBrightens) {
  const double plain = EvaluateToneCurve(ToneCurve::Photographic, 1, 4);
  EXPECT_DOUBLE_EQ(PhotographicCurve(1, 1, 4), plain);
  EXPECT_DOUBLE_EQ(PhotographicCurve(1, 3, 4), plain / 2);
  EXPECT_DOUBLE_EQ(PhotographicCurve(1, 0, 4), plain * 2);
}

}  // namespace
}  // namespace lambert
