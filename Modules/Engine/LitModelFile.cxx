#include "LitModelFile.h"

#include "Common/Core/Error.h"
#include "GltfFile.h"
#include "HtmlFile.h"
#include "ObjFile.h"
#include "SolutionFile.h"

#include <fstream>

namespace lambert {
namespace {
void WriteBytes(const std::string& bytes, const std::string& fileName) {
  std::ofstream file(fileName, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file.flush()) {
    throw Error("The file " + fileName + " could not be written.");
  }
}
}  // namespace

bool IsLitModelFileName(const std::string& fileName) {
  const std::string ending = FileEnding(fileName);
  return ending == ".glb" || ending == ".gltf" || ending == ".html" || ending == ".obj";
}

void WriteLitModel(const LitModel& model, const std::string& fileName) {
  const std::string ending = FileEnding(fileName);
  if (ending == ".html") {
    WriteBytes(HtmlOf(model), fileName);
  } else if (ending == ".obj") {
    WriteObj(model, fileName);
  } else {
    WriteBytes(ending == ".glb" ? GlbOf(model) : GltfOf(model), fileName);
  }
}
}  // namespace lambert
