// Progress out, cancel in.
#pragma once

#include <functional>

namespace lambert {

/// Called with the fraction done in [0,1] and what is being done; false asks to cancel. May be empty.
using ProgressCallback = std::function<bool(double fraction, const char* stage)>;

/// True to go on.
inline bool Report(const ProgressCallback& progress, double fraction, const char* stage) {
  return !progress || progress(fraction, stage);
}

}  // namespace lambert
