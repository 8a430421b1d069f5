// What kind of file a name is of.
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace lambert {

/// The ending of a file name in small letters, with its dot: ".vtp"; empty where it has none.
inline std::string FileEnding(const std::string& fileName) {
  std::string ending = std::filesystem::path(fileName).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return ending;
}

}  // namespace lambert
