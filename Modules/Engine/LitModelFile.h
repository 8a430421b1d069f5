// Lit models as files of the formats that viewers read. C++ only.
#ifndef LitModelFile_h
#define LitModelFile_h

#include "LitModel.h"

#include <string>

namespace lambert {
/// True for the names that WriteLitModel can write: ending in .glb, .gltf, .html or .obj, in
/// any case.
LAMBERTENGINE_EXPORT bool IsLitModelFileName(const std::string& fileName);

/// Writes by the ending: `.glb` and `.gltf` as GltfFile.h tells, `.html` as HtmlFile.h,
/// `.obj` as ObjFile.h. Throws
/// Error where the file cannot be written or its format cannot hold the model.
LAMBERTENGINE_EXPORT void WriteLitModel(const LitModel& model, const std::string& fileName);
}  // namespace lambert

#endif
