// By what a scene is known again: numbers that differ where geometry, materials or lights do.
#pragma once

#include <cstdint>

#include "Scene/Core/Scene.h"

namespace lambert {

/// Hashes of all that light depends on; names, unused materials and the camera are left out.
struct SceneKey {
  uint64_t geometry = 0;   ///< points, normals, faces, surfaces
  uint64_t materials = 0;  ///< reflectance, emittance and flags of the faces
  uint64_t lights = 0;
};

SceneKey KeyOf(const Scene& scene);

}  // namespace lambert
