#include "Display/Core/DodgingAndBurning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "Common/Core/Error.h"

namespace lambert {
namespace {

constexpr int kSize = 128;
constexpr double kKey = 0.18;

/// Left half `dark`, right half `bright`.
std::vector<float> TwoHalves(float dark, float bright) {
  std::vector<float> image(size_t(kSize) * kSize);
  for (size_t pixel = 0; pixel < image.size(); ++pixel) {
    image[pixel] = pixel % kSize < kSize / 2 ? dark : bright;
  }
  return image;
}

TEST(DodgingAndBurning, AnEvenPictureIsItsOwnSurround) {
  for (const float value : AdaptingSurrounds(TwoHalves(2, 2), kSize, kSize, 1, kKey)) {
    EXPECT_NEAR(value, 2, 1e-4);
  }
}

TEST(DodgingAndBurning, SurroundsDoNotReachOverAnEdge) {
  // A hundredfold edge: on the dark side the plain surround of 43 pixels holds light from over it.
  const auto surrounds = AdaptingSurrounds(TwoHalves(1, 100), kSize, kSize, 1, kKey);
  const float* row = surrounds.data() + kSize * kSize / 2;
  EXPECT_NEAR(row[kSize / 2 - 6], 1, 0.1);  // As the threshold of 0.05 allows, twice over.
  EXPECT_NEAR(row[kSize / 2 + 6], 100, 10.);
  EXPECT_NEAR(row[4], 1, 1e-3);
}

TEST(DodgingAndBurning, FineDetailKeepsItsContrast) {
  // Stripes of a pixel, a tenth brighter and darker than their mean: the surround is the mean, so
  // that display luminance 1 / (1 + surround) of them keeps the whole of their contrast.
  std::vector<float> image(size_t(kSize) * kSize);
  for (size_t pixel = 0; pixel < image.size(); ++pixel) image[pixel] = pixel % 2 ? 1.1f : 0.9f;
  const auto surrounds = AdaptingSurrounds(image, kSize, kSize, 1, kKey);
  const size_t middle = kSize * kSize / 2 + kSize / 2;
  EXPECT_NEAR(surrounds[middle], 1, 0.01);
  EXPECT_NEAR(surrounds[middle + 1], 1, 0.01);
}

TEST(DodgingAndBurning, TurnsWithThePicture) {
  // Wide and low: what is done along rows is done along columns.
  std::vector<float> wide(64 * 16), high(64 * 16);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 64; ++x) {
      wide[size_t(y * 64 + x)] = high[size_t(x * 16 + y)] = float(1 + (x * 7 + y * 3) % 11);
    }
  }
  const auto a = AdaptingSurrounds(wide, 64, 16, 1, kKey);
  const auto b = AdaptingSurrounds(high, 16, 64, 1, kKey);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 64; ++x) {
      EXPECT_NEAR(a[size_t(y * 64 + x)], b[size_t(x * 16 + y)], 1e-4);
    }
  }
}

TEST(DodgingAndBurning, RefusesSizesThatDoNotAgree) {
  EXPECT_THROW(AdaptingSurrounds({1, 2, 3}, 2, 2, 1, kKey), Error);
  EXPECT_THROW(AdaptingSurrounds({}, 0, 0, 1, kKey), Error);
}

}  // namespace
}  // namespace lambert
