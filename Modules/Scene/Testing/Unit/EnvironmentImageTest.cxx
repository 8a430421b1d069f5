// Texels and directions, and what is refused.
#include "Scene/Core/EnvironmentImage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>

#include "Common/Core/Error.h"

namespace lambert {
namespace {

TEST(EnvironmentImage, TexelsShareTheSphereOut) {
  const EnvironmentImage image(10, 5, std::vector<Spectrum>(50, {1, 2, 3}));
  double all = 0;
  for (int i = 0; i < image.Count(); ++i) {
    all += image.SolidAngle(i);
    for (const Vec2f& u : {Vec2f(0.01f, 0.01f), Vec2f(0.5f, 0.5f), Vec2f(0.99f, 0.99f)}) {
      EXPECT_EQ(image.IndexOf(image.PlaceOn(i, u)), i);
    }
  }
  EXPECT_NEAR(all, 4 * kPi, 1e-9);
  for (int band = 0; band < 3; ++band) EXPECT_NEAR(image.Mean()[band], band + 1, 1e-6);
}

TEST(EnvironmentImage, TheMiddleIsAheadAndTheUppermostRowAbove) {
  const EnvironmentImage image(8, 4, std::vector<Spectrum>(32));
  EXPECT_EQ(image.IndexOf({0.01, 0.1}), 8 + 4);
  EXPECT_EQ(image.IndexOf({kPi / 2 + 0.01, -0.1}), 16 + 6);
  EXPECT_EQ(image.IndexOf({-kPi / 2 + 0.01, 1}), 2);
  EXPECT_EQ(image.IndexOf({3 * kPi / 2 + 0.01, -1}), 24 + 2) << "all around, and on";
}

TEST(EnvironmentImage, RefusesWhatIsNoRadiance) {
  EXPECT_THROW(EnvironmentImage(0, 1, {}), Error);
  EXPECT_THROW(EnvironmentImage(2, 1, {Spectrum(1.f)}), Error);
  EXPECT_THROW(EnvironmentImage(1, 1, {Spectrum(-1.f)}), Error);
  EXPECT_THROW(EnvironmentImage(1, 1, {Spectrum(float(NAN))}), Error);
}

TEST(EnvironmentImage, IsReadFromRadianceFiles) {
  const std::string name = ::testing::TempDir() + "EnvironmentImageTest.hdr";
  std::ofstream(name, std::ios::binary) << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n"
                                        << std::string("\x80\x40\x20\x81\x80\x80\x80\x8a", 8);
  const auto image = ReadEnvironmentImage(name);
  ASSERT_EQ(image->Count(), 2);
  EXPECT_EQ(image->Texel(0), Spectrum(1, 0.5f, 0.25f));
  EXPECT_EQ(image->Texel(1), Spectrum(512.f));

  // Neither what is missing nor what is no such file.
  std::ofstream(name) << "v 0 0 0\n";
  EXPECT_THROW(ReadEnvironmentImage(name), Error);
  std::remove(name.c_str());
  EXPECT_THROW(ReadEnvironmentImage(name), Error);
}

}  // namespace
}  // namespace lambert
