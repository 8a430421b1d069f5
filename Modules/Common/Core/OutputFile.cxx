#include "Common/Core/OutputFile.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "Common/Core/Error.h"

namespace lambert {

namespace fs = std::filesystem;

namespace {

/// As many as Linux follows.
constexpr int kMostLinks = 40;

/// What symbolic links lead to, there or not.
fs::path EndOfLinks(fs::path path) {
  std::error_code ignored;
  for (int link = 0; link < kMostLinks && fs::is_symlink(path, ignored); ++link) {
    path = path.parent_path() / fs::read_symlink(path, ignored);
  }
  return path;
}

/// True for devices and pipes.
bool IsNoFile(const std::string& fileName) {
  std::error_code ignored;
  return fs::exists(fileName, ignored) && !fs::is_regular_file(fileName, ignored);
}

/// Rights alone do not say it: tries, and leaves no trace.
void RequireToOpen(const std::string& fileName) {
  std::error_code ignored;
  const bool isNew = !fs::exists(fileName, ignored);
  errno = 0;
  const bool opens = bool(std::ofstream(fileName, std::ios::app));
  const int reason = errno;
  if (!opens) {
    throw Error("The output " + fileName + " cannot be written: " + std::strerror(reason) + ".");
  }
  if (isNew) fs::remove(EndOfLinks(fileName), ignored);
}

}  // namespace

std::string UnfinishedOutput(const std::string& fileName) {
  return IsNoFile(fileName) ? fileName : EndOfLinks(fileName).string() + ".part";
}

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
  if (fs::is_fifo(path, ignored)) return;  // Its reader would take a try for the end.
  RequireToOpen(fileName);
  RequireToOpen(UnfinishedOutput(fileName));
}

void WriteOutput(const std::string& fileName,
                 const std::function<bool(const std::string& name)>& write) {
  RequireWritable(fileName);
  const std::string unfinished = UnfinishedOutput(fileName);
  const bool isFile = unfinished != fileName;
  const bool isWhole = write(unfinished);
  std::error_code failed, ignored;
  if (isWhole && isFile) fs::rename(unfinished, EndOfLinks(fileName), failed);
  if (!isWhole || failed) {
    if (isFile) fs::remove(unfinished, ignored);
    throw Error("The file " + fileName + " could not be written; give a place with room for it.");
  }
}

void WriteOutput(const std::string& fileName, const std::string& bytes) {
  WriteOutput(fileName, [&](const std::string& name) {
    std::ofstream file(name, std::ios::binary);
    file.write(bytes.data(), std::streamsize(bytes.size()));
    return bool(file.flush());
  });
}

}  // namespace lambert
