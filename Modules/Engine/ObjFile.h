// Lit models as OBJ, which nearly everything reads. C++ only.
#ifndef ObjFile_h
#define ObjFile_h

#include "LitModel.h"

#include <string>
#include <vector>

namespace lambert {
/// The files that WriteObj leaves beside NAME.obj: NAME.mtl, then its images.
LAMBERTENGINE_EXPORT std::vector<std::string> FilesBesideObj(const std::string& fileName,
                                                             int images);

/// Writes NAME.obj and beside it NAME.mtl and an image a page, NAME-0.png, ...: a group and a
/// material a mesh; images are `map_Kd` of materials without shading (`illum 0`), on coordinates of
/// their own; colours of points stand behind their positions, sRGB, [0, 1], white where there is an
/// image. Metres, in the scene's own axes. For models whose images are pages
/// (LitModelOptions::texturesAtPoints off). Throws Error where a file cannot be written.
LAMBERTENGINE_EXPORT void WriteObj(const LitModel& model, const std::string& fileName);
}  // namespace lambert

#endif
