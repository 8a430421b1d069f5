// Files that a run reads and writes.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lambert {

class FilesOfRun {
 public:
  explicit FilesOfRun(const std::vector<std::string>& scene) {
    for (const std::string& name : scene) this->Add("SCENE", name, false);
  }

  /// Throws CLI::ValidationError where an output would write over another file of the run.
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

 private:
  std::map<std::string, std::string> uses_;  ///< a file, and the option that names it
};

}  // namespace lambert
