#include "Scene/Core/SceneMaterials.h"

#include <utility>

namespace lambert {

namespace {

template <class T>
std::vector<T> InOrder(const std::vector<int64_t>& order, const std::vector<T>& values) {
  std::vector<T> ordered(values.size());
  for (size_t face = 0; face < ordered.size(); ++face) ordered[face] = values[size_t(order[face])];
  return ordered;
}

}  // namespace

bool TakeMaterials(const Scene& next, const std::vector<int64_t>& order, Scene* scene) {
  // Points, faces, parts, and which faces share a material.
  const TriangleMesh& mesh = next.mesh;
  TriangleMesh& own = scene->mesh;
  if (mesh.triangles.size() != own.triangles.size() || mesh.positions != own.positions ||
      mesh.normals != own.normals || mesh.uvs != own.uvs ||
      InOrder(order, mesh.triangles) != own.triangles ||
      InOrder(order, mesh.materialId) != own.materialId ||
      InOrder(order, mesh.partId) != own.partId) {
    return false;
  }

  // What they reflect and emit.
  std::vector<Spectrum> reflectance = InOrder(order, mesh.reflectance);
  std::vector<Spectrum> emittance = InOrder(order, mesh.emittance);
  std::vector<uint8_t> flags = InOrder(order, mesh.faceFlags);
  if (reflectance == own.reflectance && emittance == own.emittance && flags == own.faceFlags) {
    return false;
  }
  own.reflectance = std::move(reflectance);
  own.emittance = std::move(emittance);
  own.faceFlags = std::move(flags);
  scene->materials = next.materials;
  return true;
}

}  // namespace lambert
