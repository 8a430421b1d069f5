// Files that are written whole or not at all: what a full disk cut off would be taken for a result.
#pragma once

#include <string>

namespace lambert {

/// Throws Error, one sentence, where `fileName` cannot be written: no such folder, no right, a
/// folder itself.
void RequireWritable(const std::string& fileName);

/// Writes `bytes`. Throws Error where not all of them arrive; nothing of the file is left then.
void WriteOutput(const std::string& fileName, const std::string& bytes);

/// Removes what arrived of an output, devices apart, and throws Error.
[[noreturn]] void FailToWrite(const std::string& fileName);

}  // namespace lambert
