#include "Scene/Core/SceneKey.h"

#include "Common/Core/ContentHash.h"

namespace lambert {

SceneKey KeyOf(const Scene& scene) {
  const TriangleMesh& mesh = scene.mesh;
  SceneKey key;
  key.geometry = HashOf(mesh.positions, 0);
  key.geometry = HashOf(mesh.normals, key.geometry);
  key.geometry = HashOf(mesh.triangles, key.geometry);
  key.geometry = HashOf(mesh.surfaceId, key.geometry);
  key.materials = HashOf(mesh.reflectance, 0);
  key.materials = HashOf(mesh.emittance, key.materials);
  key.materials = HashOf(mesh.faceFlags, key.materials);
  for (const Light& light : scene.lights) {
    key.lights = HashBits(key.lights, uint64_t(light.type));
    key.lights = HashOf<Vec3f>({light.position, light.direction}, key.lights);
    key.lights = HashOf<Spectrum>({light.intensity}, key.lights);
    key.lights =
        HashOf<float>({light.size, light.innerConeAngle, light.outerConeAngle}, key.lights);
  }
  return key;
}

}  // namespace lambert
