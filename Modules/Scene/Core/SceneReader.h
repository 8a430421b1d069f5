// Reads scenes from files through Assimp: OBJ+MTL, glTF/GLB, PLY, STL and what else it knows.
#pragma once

#include <string>
#include <vector>

#include "Common/Core/Progress.h"
#include "Scene/Core/SceneAssembly.h"

namespace lambert {

struct SceneReaderOptions {
  double metresPerUnit = 0;           ///< 0: the file's own unit, else 1 (glTF is in metres)
  Spectrum defaultReflectance{0.5f};  ///< of faces whose file gives none
  bool twoSidedEmitters = false;      ///< every emitter emits from both sides
  bool opaqueGlass = false;           ///< transparent materials block and reflect
  bool blackMetals = false;  ///< metals reflect base x (1 - metallic) instead of their base colour
};

/// The scene in `files`, one after the other. Throws Error, one clear sentence, for a missing,
/// truncated, empty or unreadable file and for coordinates that are not finite.
SceneAssembly ReadScene(const std::vector<std::string>& files,
                        const SceneReaderOptions& options = {},
                        const ProgressCallback& progress = {});

/// One change asked for by name: "MATERIAL:reflectance=R,G,B", "MATERIAL:emission=R,G,B" (radiance
/// W/(m2 sr)) or "MATERIAL:two-sided"; several joined by '|'. Applies it to materials and faces.
/// Throws Error where no material has that name or the text does not parse.
void ApplyMaterialSetting(const std::string& setting, SceneAssembly* assembly);

}  // namespace lambert
