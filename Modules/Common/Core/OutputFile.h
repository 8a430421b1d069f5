// Files that are written whole or not at all: what a full disk cut off would be taken for a result.
#pragma once

#include <functional>
#include <string>

namespace lambert {

/// Throws Error, one sentence, where `fileName` cannot be written: no such folder, no right, a
/// folder itself. Leaves what stands there as it is.
void RequireWritable(const std::string& fileName);

/// The name of an output until it is whole: NAME.part, beside what a link leads to; NAME itself of
/// a device or a pipe, which is written as it stands.
std::string UnfinishedOutput(const std::string& fileName);

/// Writes a file by `write`, which gets the name to write to and returns whether all arrived. That
/// is the unfinished one, which becomes NAME then. Throws Error where not all arrives; what stood
/// there before is left then.
void WriteOutput(const std::string& fileName,
                 const std::function<bool(const std::string& name)>& write);

/// The same of `bytes`.
void WriteOutput(const std::string& fileName, const std::string& bytes);

}  // namespace lambert
