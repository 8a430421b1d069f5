#include "Scene/Core/Scene.h"

namespace lambert {

bool Scene::HasLight() const {
  for (const Light& light : lights) {
    if (!light.IsBlack()) return true;
  }
  for (size_t face = 0; face < mesh.triangles.size(); ++face) {
    if ((mesh.faceFlags[face] & (kEmitsFront | kEmitsBack)) && !mesh.emittance[face].IsBlack()) {
      return true;
    }
  }
  return false;
}

}  // namespace lambert
