#include "Atlas/Core/BrightenedImage.h"

#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "Atlas/Core/PngBytes.h"
#include "Common/Core/Error.h"

namespace lambert {
namespace {

/// Two texels and a bright one that is a hole.
const std::vector<uint8_t> kCodes = {90, 40, 0, 255, 20, 128, 0, 255, 255, 255, 255, 10};

std::string Dark() { return PngBytes(3, 1, 4, kCodes.data()); }

float Linear(int code) { return LinearFromSrgb(float(code) / 255); }

TEST(BrightenedImage, HasRoomUpToItsBrightestTexel) {
  const Spectrum room = RoomAbove(Dark(), 0.5f);
  EXPECT_NEAR(room.r, 1 / Linear(90), 1e-4);
  EXPECT_NEAR(room.g, 1 / Linear(128), 1e-4);
  EXPECT_EQ(room.b, 1);  // Black stays so.
}

TEST(BrightenedImage, HolesCountWhereTheyAreNone) { EXPECT_EQ(RoomAbove(Dark(), -1), Spectrum(1)); }

TEST(BrightenedImage, IsBrighterByLinearFactors) {
  const Spectrum factor(3, 2, 5);
  const std::string file = Brightened(Dark(), factor);
  int width = 0, height = 0, bands = 0;
  stbi_uc* codes = stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(file.data()),
                                         int(file.size()), &width, &height, &bands, 4);
  ASSERT_TRUE(codes);
  EXPECT_EQ(width, 3);
  EXPECT_EQ(height, 1);
  for (size_t i = 0; i < 8; ++i) {
    if (i % 4 == 3) continue;
    const float wanted = std::min(1.f, factor[int(i % 4)] * Linear(kCodes[i]));
    EXPECT_NEAR(codes[i], 255 * SrgbFromLinear(wanted), 0.51) << i;
  }
  for (size_t i = 3; i < 12; i += 4) EXPECT_EQ(codes[i], kCodes[i]);  // Alpha
  for (size_t i = 8; i < 11; ++i) EXPECT_EQ(codes[i], 255);           // What is full stays full.
  stbi_image_free(codes);
}

TEST(BrightenedImage, RefusesWhatIsNoImage) {
  EXPECT_THROW(RoomAbove("no image", -1), Error);
  EXPECT_THROW(Brightened("no image", Spectrum(2)), Error);
}

}  // namespace
}  // namespace lambert
