// Radiance HDR files, whole, in every way to store them, and cut off anywhere.
#include "Scene/Core/RadianceFile.h"

#include <gtest/gtest.h>

#include <string>

#include "Common/Core/Error.h"

namespace lambert {
namespace {

using std::string_literals::operator""s;

const std::string kHeader = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
/// One W/(m2 sr) in every band.
const std::string kOne = "\x80\x80\x80\x81"s;

RadiancePixels Decode(const std::string& bytes) {
  return DecodeRadiance(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
}

/// A row of 8 texels of 1, band by band: runs, and for the last band a stretch.
std::string BandsOfOnes() {
  return "\x02\x02\x00\x08"s + "\x88\x80\x88\x80\x88\x80" + "\x08" + std::string(8, '\x81');
}

void ExpectOnes(const RadiancePixels& image, size_t count) {
  ASSERT_EQ(image.texels.size(), count);
  for (const Spectrum& texel : image.texels) EXPECT_EQ(texel, Spectrum(1.f));
}

TEST(RadianceFile, PlainPixels) {
  const RadiancePixels image =
      Decode(kHeader + "-Y 1 +X 2\n" + "\x80\x40\x20\x81" + "\x80\x80\x80\x8a");
  EXPECT_EQ(image.width, 2);
  EXPECT_EQ(image.height, 1);
  EXPECT_EQ(image.texels[0], Spectrum(1, 0.5f, 0.25f));
  EXPECT_EQ(image.texels[1], Spectrum(512.f));
}

TEST(RadianceFile, RunsOfBands) {
  ExpectOnes(Decode(kHeader + "-Y 2 +X 8\n" + BandsOfOnes() + BandsOfOnes()), 16);
}

TEST(RadianceFile, RunsOfPixels) {
  // Two digits: 1 + 256 times the same again.
  ExpectOnes(Decode(kHeader + "-Y 1 +X 258\n" + kOne + "\x01\x01\x01\x01" + "\x01\x01\x01\x01"),
             258);
  // Rows of next to no bytes: 159 + 134 * 256 + 65536 times the same again.
  const std::string row = kOne + "\x01\x01\x01\x9f" + "\x01\x01\x01\x86" + "\x01\x01\x01\x01";
  ExpectOnes(Decode(kHeader + "-Y 3 +X 100000\n" + row + row + row), 300000);
}

TEST(RadianceFile, ExposuresAreTakenBack) {
  const std::string header = "#?RADIANCE\nEXPOSURE=4\nEXPOSURE=0.5\n\n-Y 1 +X 1\n";
  EXPECT_EQ(Decode(header + kOne).texels[0], Spectrum(0.5f));
}

TEST(RadianceFile, CutOffAnywhereItIsRefused) {
  const std::string whole = kHeader + "-Y 2 +X 8\n" + BandsOfOnes() + BandsOfOnes();
  for (size_t size = 0; size < whole.size(); ++size) {
    EXPECT_THROW(Decode(whole.substr(0, size)), Error) << size;
  }
}

TEST(RadianceFile, RefusesWhatItCannotMean) {
  EXPECT_THROW(Decode("v 0 0 0\n"), Error);
  EXPECT_THROW(Decode("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n" + kOne), Error);
  EXPECT_THROW(Decode(kHeader + "+X 1 -Y 1\n" + kOne), Error);
  EXPECT_THROW(Decode(kHeader + "-Y 0 +X 1\n"), Error);
  EXPECT_THROW(Decode(kHeader + "-Y 99999999 +X 99999999\n" + kOne), Error);
  EXPECT_THROW(Decode("#?RADIANCE\nEXPOSURE=0\n\n-Y 1 +X 1\n" + kOne), Error);
  // Runs that are longer than the row, or of nothing.
  EXPECT_THROW(Decode(kHeader + "-Y 1 +X 8\n" + "\x02\x02\x00\x08"s + "\x89\x80"), Error);
  EXPECT_THROW(Decode(kHeader + "-Y 1 +X 8\n" + "\x02\x02\x00\x08"s + "\x00\x80"s), Error);
  EXPECT_THROW(Decode(kHeader + "-Y 1 +X 2\n" + "\x01\x01\x01\x01"), Error);
}

}  // namespace
}  // namespace lambert
