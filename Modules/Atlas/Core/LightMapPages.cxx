#include "Atlas/Core/LightMapPages.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <stb_image_write.h>

#include <filesystem>

#include "Atlas/Core/PngBytes.h"
#include "Common/Core/Error.h"
#include "Common/Core/OutputFile.h"

namespace lambert {

namespace {

/// The rows of a page, the uppermost first.
std::vector<Spectrum> RowsFromAbove(const std::vector<Spectrum>& texels, size_t size) {
  std::vector<Spectrum> rows;
  rows.reserve(texels.size());
  for (size_t y = size; y-- > 0;) {
    const auto row = texels.begin() + std::ptrdiff_t(y * size);
    rows.insert(rows.end(), row, row + std::ptrdiff_t(size));
  }
  return rows;
}

/// Packed without loss, primaries BT.709.
void WriteExr(const std::string& name, int size, std::vector<Spectrum> rows) {
  Imf::Header header(size, size);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::addChromaticities(header, Imf::Chromaticities());
  Imf::addComments(header, "irradiance, W/m2");
  Imf::FrameBuffer bands;
  const char* const names[] = {"R", "G", "B"};
  for (int band = 0; band < 3; ++band) {
    header.channels().insert(names[band], Imf::Channel(Imf::FLOAT));
    bands.insert(names[band], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(&rows[0][band]),
                                         sizeof(Spectrum), sizeof(Spectrum) * size_t(size)));
  }
  WriteOutput(name, [&](const std::string& place) {
    try {
      Imf::OutputFile file(place.c_str(), header);
      file.setFrameBuffer(bands);
      file.writePixels(size);
      return true;
    } catch (const std::exception&) {
      return false;  // The library's sentence names its own insides.
    }
  });
}

void WritePng(const std::string& name, int size, const std::vector<Spectrum>& rows,
              const TexelCodes& codes) {
  std::vector<uint8_t> texels;
  texels.reserve(rows.size() * 3);
  for (const Spectrum& texel : rows) {
    for (const uint8_t code : codes(texel)) texels.push_back(code);
  }
  WriteOutput(name, PngBytes(size, size, 3, texels.data()));
}

void WriteHdr(const std::string& name, int size, const std::vector<Spectrum>& rows) {
  std::string hdr;
  const auto append = [](void* to, void* more, int count) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(more), size_t(count));
  };
  if (!stbi_write_hdr_to_func(append, &hdr, size, size, 3, &rows[0].r)) {
    throw Error("The page " + name + " could not be packed: there is no memory for it.");
  }
  WriteOutput(name, hdr);
}

const char* EndingOf(PageFormat format) {
  if (format == PageFormat::Exr) return ".exr";
  return format == PageFormat::Png ? ".png" : ".hdr";
}

}  // namespace

std::vector<std::string> LightMapPageNames(const std::string& fileName, int pages,
                                           PageFormat format) {
  const std::filesystem::path path(fileName);
  std::vector<std::string> names;
  for (int page = 0; page < pages; ++page) {
    const std::string name = path.stem().string() + "-" + std::to_string(page) + EndingOf(format);
    names.push_back((path.parent_path() / name).string());
  }
  return names;
}

void WriteLightMapPages(const LightMap& map, const std::string& fileName, PageFormat format,
                        const TexelCodes& codes) {
  const std::vector<std::string> names = LightMapPageNames(fileName, int(map.pages.size()), format);
  for (size_t page = 0; page < names.size(); ++page) {
    std::vector<Spectrum> rows = RowsFromAbove(map.pages[page], size_t(map.pageSize));
    if (format == PageFormat::Exr) WriteExr(names[page], map.pageSize, std::move(rows));
    if (format == PageFormat::Hdr) WriteHdr(names[page], map.pageSize, rows);
    if (format == PageFormat::Png) WritePng(names[page], map.pageSize, rows, codes);
  }
}

}  // namespace lambert
