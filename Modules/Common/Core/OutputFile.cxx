#include "Common/Core/OutputFile.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "Common/Core/Error.h"

namespace lambert {

namespace fs = std::filesystem;

void RequireWritable(const std::string& fileName) {
  const fs::path path(fileName);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    throw Error("The output " + fileName + " cannot be written: there is no folder " +
                folder.string() + ".");
  }
  if (fs::is_directory(path, ignored)) {
    throw Error("The output " + fileName + " cannot be written: it is a folder.");
  }
  // Rights alone do not say it: try, and leave no trace.
  const bool isNew = !fs::exists(path, ignored);
  errno = 0;
  const bool opens = bool(std::ofstream(fileName, std::ios::app));
  const int reason = errno;
  if (!opens) {
    throw Error("The output " + fileName + " cannot be written: " + std::strerror(reason) + ".");
  }
  if (isNew) fs::remove(path, ignored);
}

void WriteOutput(const std::string& fileName, const std::string& bytes) {
  std::ofstream file(fileName, std::ios::binary);
  file.write(bytes.data(), std::streamsize(bytes.size()));
  if (!file.flush()) FailToWrite(fileName);
}

void FailToWrite(const std::string& fileName) {
  std::error_code ignored;
  if (fs::is_regular_file(fileName, ignored)) fs::remove(fileName, ignored);
  throw Error("The file " + fileName + " could not be written; give a place with room for it.");
}

}  // namespace lambert
