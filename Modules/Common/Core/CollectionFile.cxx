#include "Common/Core/CollectionFile.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "Common/Core/Error.h"
#include "Common/Core/FileEnding.h"
#include "Common/Core/OutputFile.h"

namespace lambert {

namespace fs = std::filesystem;

namespace {

/// Bytes of the UTF-8 character at `begin`; 0 where there is none that XML can hold.
size_t LengthOfCharacter(const std::string& text, size_t begin) {
  const auto byte = [&](size_t i) {
    return begin + i < text.size() ? uint32_t(uint8_t(text[begin + i])) : 0u;
  };
  const uint32_t first = byte(0);
  if (first < 0x80) return first >= 0x20 || first == '\t' || first == '\n' || first == '\r';
  const size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4) return 0;
  uint32_t code = first & (0xffu >> (length + 1));
  for (size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3f);
  }
  const uint32_t least[] = {0x80, 0x800, 0x10000};
  const bool isSurrogate = code >= 0xd800 && code < 0xe000;
  const bool isNoCharacter = code == 0xfffe || code == 0xffff || code > 0x10ffff;
  return code < least[length - 2] || isSurrogate || isNoCharacter ? 0 : length;
}

/// The text with `instead` of every byte that is no part of a character.
template <class Instead>
std::string WithCharactersOnly(const std::string& text, const Instead& instead) {
  std::string characters;
  for (size_t i = 0; i < text.size();) {
    const size_t length = LengthOfCharacter(text, i);
    characters += length > 0 ? text.substr(i, length) : instead(uint8_t(text[i]));
    i += std::max<size_t>(1, length);
  }
  return characters;
}

/// As the value of an attribute.
std::string AsXml(const std::string& text) {
  constexpr const char* kReplacement = "\xef\xbf\xbd";
  std::string xml;
  for (const char c : WithCharactersOnly(text, [&](uint8_t) { return kReplacement; })) {
    if (std::string("&<>\"\t\n\r").find(c) == std::string::npos) {
      xml += c;
    } else {
      xml += "&#" + std::to_string(int(c)) + ";";
    }
  }
  return xml;
}

/// What pieces and their folder are named after.
std::string StemOf(const std::string& fileName) {
  return WithCharactersOnly(fs::path(fileName).stem().string(), [](uint8_t byte) {
    char text[4];
    std::snprintf(text, sizeof text, "%%%02X", byte);
    return std::string(text);
  });
}

std::string NameOfPiece(const std::string& fileName, int64_t write, size_t piece) {
  return StemOf(fileName) + "-" + std::to_string(write) + "-" + std::to_string(piece) + ".vtp";
}

/// Which write of a collection left a piece of this name; none where it is no such name.
std::optional<int64_t> WriteOf(const std::string& piece, const std::string& fileName) {
  constexpr size_t kMostDigits = 9;
  size_t at = 0;
  const auto skip = [&](const std::string& word) {
    if (piece.compare(at, word.size(), word) != 0) return false;
    at += word.size();
    return true;
  };
  const auto number = [&] {
    const size_t begin = at;
    while (at < piece.size() && std::isdigit(uint8_t(piece[at]))) ++at;
    return piece.substr(begin, at - begin);
  };
  if (!skip(StemOf(fileName) + "-")) return {};
  const std::string write = number();
  if (write.empty() || write.size() > kMostDigits || !skip("-")) return {};
  if (number().empty() || !skip(".vtp")) return {};
  skip(".part");
  if (at != piece.size()) return {};
  return std::stoll(write);
}

/// The pieces in the folder, and which write left them.
std::vector<std::pair<fs::path, int64_t>> PiecesThere(const std::string& fileName) {
  std::vector<std::pair<fs::path, int64_t>> pieces;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(FolderOfPieces(fileName), ignored)) {
    const auto write = WriteOf(entry.path().filename().string(), fileName);
    if (write) pieces.emplace_back(entry.path(), *write);
  }
  return pieces;
}

/// The first number that no piece has.
int64_t NextWrite(const std::string& fileName) {
  std::vector<int64_t> taken;
  for (const auto& [piece, write] : PiecesThere(fileName)) taken.push_back(write);
  int64_t next = 0;
  while (std::find(taken.begin(), taken.end(), next) != taken.end()) ++next;
  return next;
}

template <class Of>
void RemovePieces(const std::string& fileName, const Of& isOf) {
  std::error_code ignored;
  for (const auto& [piece, write] : PiecesThere(fileName)) {
    if (isOf(write)) fs::remove(piece, ignored);
  }
}

/// The folder of pieces; one that was made for nothing goes again.
class PieceFolder {
 public:
  explicit PieceFolder(const std::string& fileName) : name_(FolderOfPieces(fileName)) {
    std::error_code failed;
    isNew_ = fs::create_directory(name_, failed);
    if (failed || !fs::is_directory(name_, failed)) {
      const std::string reason = failed ? failed.message() : "it is a file";
      throw Error("The output " + fileName + " cannot be written: the folder " + name_ +
                  " that its pieces go to cannot be made: " + reason + ".");
    }
  }
  ~PieceFolder() {
    std::error_code ignored;
    if (isNew_) fs::remove(name_, ignored);
  }
  PieceFolder(const PieceFolder&) = delete;
  PieceFolder& operator=(const PieceFolder&) = delete;

  std::string PlaceOf(const std::string& piece) const { return (fs::path(name_) / piece).string(); }
  void Keep() { isNew_ = false; }

 private:
  std::string name_;
  bool isNew_ = false;
};

/// What VTK's own writer of collections makes.
std::string IndexOf(const std::string& fileName, int64_t write,
                    const std::vector<std::string>& names) {
  const std::string folder = fs::path(FolderOfPieces(fileName)).filename().string();
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<VTKFile type=\"vtkPartitionedDataSetCollection\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt32\">\n"
      "  <vtkPartitionedDataSetCollection>\n";
  for (size_t piece = 0; piece < names.size(); ++piece) {
    const std::string name = names[piece].empty() ? "" : " name=\"" + AsXml(names[piece]) + "\"";
    const std::string file = folder + "/" + NameOfPiece(fileName, write, piece);
    text += "    <Partitions index=\"" + std::to_string(piece) + "\"" + name + ">\n" +
            "      <DataSet index=\"0\" file=\"" + AsXml(file) + "\"/>\n    </Partitions>\n";
  }
  return text + "  </vtkPartitionedDataSetCollection>\n</VTKFile>\n";
}

}  // namespace

bool IsCollectionFileName(const std::string& fileName) { return FileEnding(fileName) == ".vtpc"; }

std::string FolderOfPieces(const std::string& fileName) {
  return (fs::path(fileName).parent_path() / StemOf(fileName)).string();
}

bool IsPieceOf(const std::string& fileName, const std::string& file) {
  std::error_code ignored;
  const auto place = [&](const fs::path& path) {
    return fs::weakly_canonical(fs::absolute(path, ignored), ignored);
  };
  const fs::path piece = place(file);
  return piece.parent_path() == place(FolderOfPieces(fileName)) &&
         WriteOf(piece.filename().string(), fileName).has_value();
}

void RequireWritableCollection(const std::string& fileName) {
  RequireWritable(fileName);
  const PieceFolder folder(fileName);
  RequireWritable(folder.PlaceOf(NameOfPiece(fileName, NextWrite(fileName), 0)));
}

void WriteCollection(const std::string& fileName, const std::vector<std::string>& names,
                     const std::function<void(size_t piece, const std::string& file)>& write) {
  RequireWritable(fileName);
  PieceFolder folder(fileName);
  const int64_t number = NextWrite(fileName);
  try {
    for (size_t piece = 0; piece < names.size(); ++piece) {
      write(piece, folder.PlaceOf(NameOfPiece(fileName, number, piece)));
    }
    WriteOutput(fileName, IndexOf(fileName, number, names));
  } catch (...) {
    RemovePieces(fileName, [&](int64_t of) { return of == number; });
    throw;
  }
  folder.Keep();
  RemovePieces(fileName, [&](int64_t of) { return of != number; });
}

}  // namespace lambert
