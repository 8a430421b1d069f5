#include "LitModelFile.h"

#include "Common/Core/FileEnding.h"
#include "Common/Core/OutputFile.h"
#include "GltfFile.h"
#include "HtmlFile.h"
#include "ObjFile.h"

namespace lambert {
bool IsLitModelFileName(const std::string& fileName) {
  const std::string ending = FileEnding(fileName);
  return ending == ".glb" || ending == ".gltf" || ending == ".html" || ending == ".obj";
}

void WriteLitModel(const LitModel& model, const std::string& fileName) {
  const std::string ending = FileEnding(fileName);
  if (ending == ".html") {
    WriteOutput(fileName, HtmlOf(model));
  } else if (ending == ".obj") {
    WriteObj(model, fileName);
  } else {
    WriteOutput(fileName, ending == ".glb" ? GlbOf(model) : GltfOf(model));
  }
}
}  // namespace lambert
