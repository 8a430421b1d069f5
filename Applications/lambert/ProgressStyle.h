// How progress is shown.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>

namespace lambert {

enum class ProgressStyle { Auto, Plain, None };

inline void AddProgress(CLI::App* command, ProgressStyle* progress) {
  const std::map<std::string, ProgressStyle> styles{{"auto", ProgressStyle::Auto},
                                                    {"plain", ProgressStyle::Plain},
                                                    {"none", ProgressStyle::None}};
  command
      ->add_option_function<std::string>(
          "--progress",
          [progress, styles](const std::string& name) { *progress = styles.at(name); },
          "auto: a bar on a terminal, lines in a log; plain; none")
      ->check(CLI::IsMember({"auto", "plain", "none"}))
      ->default_str("auto");
}

}  // namespace lambert
