#include "Atlas/Core/LightMapPages.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <gtest/gtest.h>
#include <stb/stb_image.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>

#include "Common/Core/Error.h"

namespace lambert {
namespace {

namespace fs = std::filesystem;

/// Two pages of four by four texels, each of a light of its own: from the smallest float to the
/// largest, and what lies between.
class LightMapPagesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("lambert pages " + std::to_string(::getpid()));
    fs::create_directories(folder_);
    map_.pageSize = 4;
    for (int page = 0; page < 2; ++page) {
      std::vector<Spectrum> texels;
      for (int i = 0; i < 16; ++i) {
        const float x = std::exp2(float(i - 8)) / 3 + float(page);
        texels.emplace_back(x, 2 * x / 3, x / 7);
      }
      texels[3] = {1e-45f, 3e38f, 0};
      map_.pages.push_back(texels);
    }
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string Name() const { return (folder_ / "map of a room.vtp").string(); }
  /// The texel of a row from above.
  const Spectrum& Texel(size_t page, int row, int column) const {
    return map_.pages[page][size_t((3 - row) * 4 + column)];
  }

  fs::path folder_;
  LightMap map_;
};

TEST_F(LightMapPagesTest, ExrHoldsIrradianceToTheBit) {
  WriteLightMapPages(map_, Name(), PageFormat::Exr);
  const std::vector<std::string> names = LightMapPageNames(Name(), 2, PageFormat::Exr);
  EXPECT_EQ(fs::path(names[1]).filename(), "map of a room-1.exr");
  for (size_t page = 0; page < 2; ++page) {
    Imf::InputFile file(names[page].c_str());
    ASSERT_EQ(file.header().dataWindow().max.x, 3);
    ASSERT_EQ(file.header().dataWindow().max.y, 3);
    std::vector<Spectrum> rows(16);
    Imf::FrameBuffer bands;
    const char* const bandNames[] = {"R", "G", "B"};
    for (int band = 0; band < 3; ++band) {
      ASSERT_NE(file.header().channels().findChannel(bandNames[band]), nullptr);
      bands.insert(bandNames[band], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(&rows[0][band]),
                                               sizeof(Spectrum), 4 * sizeof(Spectrum)));
    }
    file.setFrameBuffer(bands);
    file.readPixels(0, 3);
    for (int i = 0; i < 16; ++i) {
      EXPECT_EQ(std::memcmp(&rows[size_t(i)], &Texel(page, i / 4, i % 4), sizeof(Spectrum)), 0);
    }
  }
}

TEST_F(LightMapPagesTest, PngHoldsTheCodes) {
  const auto codes = [](const Spectrum& light) {
    return std::array<uint8_t, 3>{uint8_t(std::min(255.f, 10 * light.r)), 7,
                                  uint8_t(std::min(255.f, light.b))};
  };
  WriteLightMapPages(map_, Name(), PageFormat::Png, codes);
  for (size_t page = 0; page < 2; ++page) {
    int width = 0, height = 0, bands = 0;
    const std::string name = LightMapPageNames(Name(), 2, PageFormat::Png)[page];
    unsigned char* read = stbi_load(name.c_str(), &width, &height, &bands, 0);
    ASSERT_NE(read, nullptr);
    ASSERT_EQ(width, 4);
    ASSERT_EQ(height, 4);
    ASSERT_EQ(bands, 3);
    for (int i = 0; i < 16; ++i) {
      EXPECT_EQ(std::memcmp(read + 3 * i, codes(Texel(page, i / 4, i % 4)).data(), 3), 0);
    }
    stbi_image_free(read);
  }
}

// Radiance shares an exponent between the bands, of eight bits each: half a code of the brightest.
TEST_F(LightMapPagesTest, HdrHoldsIrradianceToAPercentOfTheBrightestBand) {
  map_.pages[0][3] = map_.pages[1][3] = {};
  WriteLightMapPages(map_, Name(), PageFormat::Hdr);
  int width = 0, height = 0, bands = 0;
  const std::string name = LightMapPageNames(Name(), 2, PageFormat::Hdr)[1];
  float* read = stbi_loadf(name.c_str(), &width, &height, &bands, 3);
  ASSERT_NE(read, nullptr);
  for (int i = 0; i < 16; ++i) {
    const Spectrum& texel = Texel(1, i / 4, i % 4);
    for (int band = 0; band < 3; ++band) {
      EXPECT_NEAR(read[3 * i + band], texel[band], 0.01f * texel.MaxBand());
    }
  }
  stbi_image_free(read);
}

TEST_F(LightMapPagesTest, AFolderThatIsNotThereIsTold) {
  for (const PageFormat format : {PageFormat::Exr, PageFormat::Hdr}) {
    const std::string nowhere = (folder_ / "missing" / "map.vtp").string();
    EXPECT_THROW(WriteLightMapPages(map_, nowhere, format), Error);
  }
}

}  // namespace
}  // namespace lambert
