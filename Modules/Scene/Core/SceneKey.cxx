#include "Scene/Core/SceneKey.h"

#include "Common/Core/ContentHash.h"
#include "Scene/Core/EnvironmentImage.h"

namespace lambert {

namespace {

/// The texels and, by the size of the first one, how many there are in a row.
uint64_t HashOfImage(const EnvironmentImage& image, uint64_t seed) {
  std::vector<Spectrum> texels;
  texels.reserve(size_t(image.Count()));
  for (int i = 0; i < image.Count(); ++i) texels.push_back(image.Texel(i));
  return HashOf<double>({image.SolidAngle(0)}, HashOf(texels, seed));
}

}  // namespace

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
    key.lights = HashOf<Spectrum>({light.intensity, light.horizon, light.ground}, key.lights);
    key.lights = HashOf<float>(
        {light.rotation, light.size, light.innerConeAngle, light.outerConeAngle}, key.lights);
    if (light.image) key.lights = HashOfImage(*light.image, key.lights);
  }
  return key;
}

}  // namespace lambert
