// Lit models as glTF 2.0, drawn alike by every viewer: KHR_materials_unlit, colours and textures of
// the core. C++ only.
#ifndef GltfFile_h
#define GltfFile_h

#include "LitModel.h"

namespace lambert {
/// `model` as the bytes of a GLB file: positions in metres; COLOR_0 linear, 16 bits a band; images
/// as PNG, sRGB, those of the scene as PNG or JPEG; a material a mesh, one-sided; the camera as a
/// node. Throws Error for a model of more than 4 GB, which the format cannot hold.
LAMBERTENGINE_EXPORT std::string GlbOf(const LitModel& model);

/// The same as one JSON text, its buffer in it as base64.
LAMBERTENGINE_EXPORT std::string GltfOf(const LitModel& model);
}  // namespace lambert

#endif
