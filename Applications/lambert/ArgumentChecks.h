// What the options of several commands share: numbers, and checks of them.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "Common/Core/Spectrum.h"

namespace lambert {

inline Spectrum ToSpectrum(const std::vector<float>& bands) {
  return {bands[0], bands[1], bands[2]};
}

/// Numbers separated by `separator`; empty where any of them is not one.
inline std::vector<double> ParseNumbers(const std::string& text, char separator) {
  std::vector<double> numbers;
  std::stringstream stream(text);
  for (std::string field; std::getline(stream, field, separator);) {
    char* end = nullptr;
    numbers.push_back(std::strtod(field.c_str(), &end));
    if (field.empty() || *end || !std::isfinite(numbers.back())) return {};
  }
  return numbers;
}

/// A finite number from `low` to `high`. CLI11's own ranges let NaN pass.
inline CLI::Validator Within(double low, double high, const std::string& description) {
  return CLI::Validator(
      [=](const std::string& text) {
        const std::vector<double> number = ParseNumbers(text, ',');
        const bool good = number.size() == 1 && number[0] >= low && number[0] <= high;
        return good ? std::string() : "\"" + text + "\" is not a number " + description;
      },
      "");
}

inline CLI::Validator NotNegative() {
  return Within(0, std::numeric_limits<float>::max(), "of 0 or more");
}

inline void RequirePngName(const std::string& image) {
  const std::string ending = std::filesystem::path(image).extension().string();
  if (!image.empty() && ending != ".png" && ending != ".PNG") {
    throw CLI::ValidationError("--image", "the name has to end in .png");
  }
}

}  // namespace lambert
