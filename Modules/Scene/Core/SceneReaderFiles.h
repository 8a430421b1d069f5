// Files as they lie on disk: what is wrong with them is found here, before a parser guesses.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lambert {

/// The bytes of the file. Throws Error where it is missing, a folder, unreadable or empty.
std::string LoadFile(const std::string& path);

/// Extension in lower case, without the dot.
std::string FileExtension(const std::string& path);

/// What a material library says of a material, beside what the importer reads of it.
struct MtlScan {
  bool hasKd = false;
  std::optional<float> dissolve;  ///< "d", which counts before "Tr"; the importer takes the last
};

/// What a scan of an OBJ file found.
struct ObjScan {
  std::string text;  ///< the file with numbers as the parser takes them (".2" as "0.2")
  std::vector<std::string> missingMtl;       ///< material libraries that are not there
  std::map<std::string, MtlScan> materials;  ///< by name
};

/// A material library from its first material on: the importer crashes on a texture before that.
std::string MtlText(const std::string& path);

/// Checks every number of the vertices. Throws Error, with the line, where one is missing or not
/// finite.
ObjScan ScanObj(const std::string& path, std::string text);

/// Throws Error where the file ends before the elements that its header announces.
void CheckPly(const std::string& path, const std::string& bytes);

/// Throws Error where the header of an OFF file announces more points than can be: memory would run
/// out.
void CheckOff(const std::string& path, const std::string& bytes);

/// Throws Error where a text file has no end.
void CheckStl(const std::string& path, const std::string& bytes);

}  // namespace lambert
