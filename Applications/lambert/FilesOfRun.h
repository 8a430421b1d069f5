// Files that a run reads and writes.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "Common/Core/CollectionFile.h"
#include "Common/Core/Error.h"
#include "Common/Core/OutputFile.h"

namespace lambert {

/// A file that a run writes, and the option that asks for it; without a name it is not asked for.
struct OutputOfRun {
  std::string option, name;
  bool isMesh = false;  ///< where it ends in .vtpc, a collection and the folder of its pieces
  bool IsCollection() const { return isMesh && IsCollectionFileName(name); }
};

class FilesOfRun {
 public:
  explicit FilesOfRun(const std::vector<std::string>& scene) {
    for (const std::string& name : scene) this->Add("SCENE", name, false);
  }

  void AddInput(const std::string& option, const std::string& name) {
    this->Add(option, name, false);
  }

  /// Throws CLI::ValidationError where one would write over another file of the run, finished or
  /// not.
  void AddOutputs(const std::vector<OutputOfRun>& outputs) {
    for (const OutputOfRun& output : outputs) {
      const auto& [option, name, isMesh] = output;
      this->Add(option, name, true);
      const std::string unfinished = name.empty() ? "" : UnfinishedOutput(name);
      if (unfinished != name) this->Add(option, unfinished, true);
      if (output.IsCollection()) this->Add(option, FolderOfPieces(name), true);
    }
    for (const OutputOfRun& output : outputs) {
      if (output.IsCollection()) this->RequireNoPieces(output);
    }
  }

 private:
  /// Earlier pieces are written over, too.
  void RequireNoPieces(const OutputOfRun& collection) const {
    for (const auto& [file, option] : uses_) {
      if (!IsPieceOf(collection.name, file)) continue;
      throw CLI::ValidationError(collection.option, "would write over the file of " + option);
    }
  }

  void Add(const std::string& option, const std::string& name, bool isOutput) {
    namespace fs = std::filesystem;
    if (name.empty()) return;
    std::error_code ignored;
    const fs::path place = fs::weakly_canonical(fs::absolute(name, ignored), ignored);
    if (fs::is_character_file(place, ignored) || fs::is_fifo(place, ignored)) return;
    const auto [other, isNew] = uses_.emplace(place.empty() ? name : place.string(), option);
    if (!isNew && isOutput) {
      throw CLI::ValidationError(option, "would write over the file of " + other->second);
    }
  }

  std::map<std::string, std::string> uses_;  ///< a file, and the option that names it
};

/// Throws Error where one of the outputs cannot be written.
inline void RequireWritable(const std::vector<OutputOfRun>& outputs) {
  for (const OutputOfRun& output : outputs) {
    if (output.name.empty()) continue;
    output.IsCollection() ? RequireWritableCollection(output.name) : RequireWritable(output.name);
  }
}

/// Throws Error where one of the outputs would write over one of the files that the scene's files
/// named and that were read with them.
inline void RequireUnread(const std::vector<OutputOfRun>& outputs,
                          const std::vector<std::string>& companions) {
  try {
    FilesOfRun(companions).AddOutputs(outputs);
  } catch (const CLI::ValidationError& error) {
    throw Error(std::string(error.what()) + ", which needs it; name another file.");
  }
}

}  // namespace lambert
