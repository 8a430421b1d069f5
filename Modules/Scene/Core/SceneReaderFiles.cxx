#include "Scene/Core/SceneReaderFiles.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>

#include "Common/Core/Error.h"
#include "Common/Core/FileEnding.h"

namespace lambert {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// Splits off the next word of `line`; empty at its end.
std::string_view NextWord(std::string_view* line) {
  size_t begin = 0;
  while (begin < line->size() && IsBlank((*line)[begin])) ++begin;
  size_t end = begin;
  while (end < line->size() && !IsBlank((*line)[end])) ++end;
  const std::string_view word = line->substr(begin, end - begin);
  line->remove_prefix(end);
  return word;
}

std::string_view NextLine(std::string_view* text) {
  const size_t end = text->find('\n');
  const std::string_view line = text->substr(0, end);
  text->remove_prefix(end == std::string_view::npos ? text->size() : end + 1);
  return line;
}

std::string_view Trim(std::string_view text) {
  while (!text.empty() && IsBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && IsBlank(text.back())) text.remove_suffix(1);
  return text;
}

bool IsFiniteNumber(std::string_view word) {
  if (word.front() == '+') word.remove_prefix(1);
  float value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::result_out_of_range)
    return word.find("e-") != word.npos || word.find("E-") != word.npos;
  return error == std::errc() && end == word.data() + word.size() && std::isfinite(value);
}

/// Checks the numbers of one vertex line; true where one starts with a dot.
bool CheckVertexLine(std::string_view line, const std::string& path, int64_t number) {
  const std::string where =
      " in line " + std::to_string(number) + " of \"" + path + "\"; repair the file.";
  const size_t needed = NextWord(&line) == "vt" ? 1 : 3;
  bool dotted = false;
  size_t count = 0;
  for (std::string_view word = NextWord(&line); !word.empty(); word = NextWord(&line)) {
    if (word.front() == '#' || word == "\\") break;
    if (!IsFiniteNumber(word)) {
      const std::string quoted(word.substr(0, word.find('\0')));  // A zero would end the sentence.
      throw Error("\"" + quoted + "\" is not a finite number" + where);
    }
    dotted |= word.front() == '.';
    ++count;
  }
  if (count < needed && line.empty()) throw Error("A coordinate is missing" + where);
  return dotted;
}

void AppendUndotted(std::string_view line, std::string* text) {
  for (size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '.' && i > 0 && IsBlank(line[i - 1])) *text += '0';
    *text += line[i];
  }
}

/// Scans the library; false where it is not there.
bool ScanMtl(const fs::path& path, std::map<std::string, MtlScan>* materials) {
  if (!std::ifstream(path)) return false;
  std::istringstream stream(MtlText(path.string()));
  std::string line, name;
  while (std::getline(stream, line)) {
    std::string_view rest(line);
    const std::string_view word = NextWord(&rest);
    if (word == "newmtl") name = Trim(rest);
    MtlScan& material = (*materials)[name];
    material.hasKd |= word == "Kd";
    if (word != "d") continue;
    const std::string_view value = NextWord(&rest);
    float dissolve = 1;
    std::from_chars(value.data(), value.data() + value.size(), dissolve);
    material.dissolve = dissolve;
  }
  return true;
}

struct PlyElement {
  int64_t count = 0;
  /// Bytes of each property; of a list, first those of its count (negative), then those of an
  /// entry.
  std::vector<int> sizes;
};

struct PlyHeader {
  std::string format;
  std::vector<PlyElement> elements;
  bool ended = false;
};

int PlyTypeSize(std::string_view type) {
  if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
  if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
  return type == "double" || type == "float64" ? 8 : 4;
}

/// Reads the header off the front of `rest`.
PlyHeader ReadPlyHeader(std::string_view* rest) {
  PlyHeader header;
  while (!rest->empty() && !header.ended) {
    std::string_view line = NextLine(rest);
    const std::string_view word = NextWord(&line);
    if (word == "format") header.format = NextWord(&line);
    if (word == "element") {
      NextWord(&line);
      header.elements.push_back({std::atoll(std::string(NextWord(&line)).c_str()), {}});
    }
    if (word == "property" && !header.elements.empty()) {
      auto& sizes = header.elements.back().sizes;
      const std::string_view type = NextWord(&line);
      if (type == "list") sizes.push_back(-PlyTypeSize(NextWord(&line)));
      sizes.push_back(PlyTypeSize(type == "list" ? NextWord(&line) : type));
    }
    header.ended = word == "end_header";
  }
  return header;
}

/// Text holds one element a line.
bool HasPlyLines(const PlyHeader& header, std::string_view body) {
  int64_t announced = 0, found = 0;
  for (const PlyElement& element : header.elements) announced += element.count;
  while (!body.empty()) found += !Trim(NextLine(&body)).empty();
  return found >= announced;
}

uint64_t PlyCount(std::string_view bytes, bool bigEndian) {
  uint64_t value = 0;
  for (size_t i = 0; i < bytes.size(); ++i) {
    const size_t shift = 8 * (bigEndian ? bytes.size() - 1 - i : i);
    value |= uint64_t(static_cast<unsigned char>(bytes[i])) << shift;
  }
  return value;
}

/// Walks the elements of a binary body.
bool HasPlyBytes(const PlyHeader& header, std::string_view body) {
  const bool bigEndian = header.format == "binary_big_endian";
  size_t at = 0;
  for (const PlyElement& element : header.elements) {
    for (int64_t i = 0; i < element.count; ++i) {
      uint64_t entries = 1;
      for (const int size : element.sizes) {
        const size_t bytes = size_t(std::abs(size));
        if (entries > body.size() || at + entries * bytes > body.size()) return false;
        at += entries * bytes;
        entries = size < 0 ? PlyCount(body.substr(at - bytes, bytes), bigEndian) : 1;
      }
    }
  }
  return true;
}

}  // namespace

std::string FileExtension(const std::string& path) {
  std::string ending = FileEnding(path);
  if (!ending.empty()) ending.erase(0, 1);
  return ending;
}

std::string LoadFile(const std::string& path) {
  std::error_code failure;
  if (!fs::exists(path, failure)) {
    throw Error("The file \"" + path + "\" does not exist; check its name.");
  }
  if (fs::is_directory(path, failure)) {
    throw Error("\"" + path + "\" is a folder; name a file in it.");
  }
  if (!fs::is_regular_file(path, failure)) {
    throw Error("\"" + path + "\" is a device or a pipe; name a file.");
  }
  std::ifstream stream(path, std::ios::binary);
  std::string bytes;
  if (stream) {
    bytes.resize(size_t(fs::file_size(path, failure)));
    stream.read(bytes.data(), std::streamsize(bytes.size()));
  }
  if (!stream) throw Error("The file \"" + path + "\" cannot be read; check its permissions.");
  if (bytes.empty()) throw Error("The file \"" + path + "\" is empty; write it again.");
  return bytes;
}

std::string MtlText(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  for (std::string_view rest(text); !rest.empty();) {
    std::string_view line = NextLine(&rest);
    if (line.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
      line.remove_prefix(kByteOrderMark.size());
    }
    const char* const begin = line.data();
    if (NextWord(&line) == "newmtl") return text.substr(size_t(begin - text.data()));
  }
  return {};
}

ObjScan ScanObj(const std::string& path, std::string text) {
  // What would hide lines from the importer: a byte order mark, line ends of old Macs.
  if (text.find('\n') == std::string::npos) std::replace(text.begin(), text.end(), '\r', '\n');
  if (!text.empty() && text.back() != '\n') text += '\n';
  std::string_view rest(text);
  if (rest.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
    rest.remove_prefix(kByteOrderMark.size());
  }

  // Lines that stay as they are, in a row, up to one that changes.
  ObjScan scan;
  const char* kept = rest.data();
  for (int64_t number = 1; !rest.empty(); ++number) {
    const char* const begin = rest.data();
    std::string_view line = NextLine(&rest);
    while (!line.empty() && IsBlank(line.front())) line.remove_prefix(1);  // Nor indentation.
    const bool vertex =
        line.size() > 2 && line[0] == 'v' && (IsBlank(line[1]) || line[1] == 't' || line[1] == 'n');
    const bool dotted = vertex && CheckVertexLine(line, path, number);
    if (dotted || line.data() != begin) {
      scan.text.append(kept, size_t(begin - kept));
      dotted ? AppendUndotted(line, &scan.text) : void(scan.text += line);
      scan.text += '\n';
      kept = rest.data();
    }
    std::string_view words(line);
    if (line.substr(0, 6) == "mtllib" && NextWord(&words) == "mtllib") {
      const std::string name(Trim(words));
      const fs::path library = fs::path(path).parent_path() / name;
      if (!ScanMtl(library, &scan.materials)) scan.missingMtl.push_back(name);
    }
  }
  if (kept == text.data()) {
    scan.text = std::move(text);
  } else {
    scan.text.append(kept, size_t(text.data() + text.size() - kept));
  }
  return scan;
}

void CheckPly(const std::string& path, const std::string& bytes) {
  std::string_view rest(bytes);
  const PlyHeader header = ReadPlyHeader(&rest);
  const bool whole =
      header.format == "ascii" ? HasPlyLines(header, rest) : HasPlyBytes(header, rest);
  if (!header.ended || !whole) {
    throw Error(
        "The file \"" + path +
        "\" ends before the elements that its header announces; it is cut off, write it again.");
  }
}

void CheckOff(const std::string& path, const std::string& bytes) {
  std::string_view rest(bytes);
  int64_t announced = 0;
  for (int lines = 0; announced == 0 && lines < 2; ++lines) {
    std::string_view line = NextLine(&rest);
    announced = std::atoll(std::string(NextWord(&line)).c_str());
  }
  if (announced > int64_t(bytes.size())) {
    throw Error("The file \"" + path +
                "\" announces more points than it has bytes; write it again.");
  }
}

void CheckStl(const std::string& path, const std::string& bytes) {
  const bool text = bytes.compare(0, 5, "solid") == 0 && bytes.find("facet") < 1000;
  if (text && bytes.find("endsolid", bytes.rfind("facet")) == std::string::npos) {
    throw Error("The file \"" + path +
                "\" ends without \"endsolid\"; it is cut off, write it again.");
  }
}

}  // namespace lambert
