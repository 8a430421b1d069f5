// What glTF says beside geometry: materials, lights, cameras, instances. They are read from its
// JSON; geometry is left to the importer, which gets a copy in which materials, meshes and nodes
// are named by their index, to join the two.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "Common/Core/Error.h"
#include "Scene/Core/SceneReaderMaterials.h"
#include "Scene/Core/SceneReaderTransform.h"

namespace lambert {

class GltfDocument {
 public:
  /// Parses a .gltf or .glb. Throws Error where it is cut off, not glTF 2, or needs an extension
  /// that is not read.
  GltfDocument(const std::string& path, const std::string& bytes);

  /// The document with indices for names, as the importer gets it.
  std::string IndexedBytes(const ReadContext& context) const;
  /// The index in such a name, -1 where it has none.
  static int IndexFromName(const std::string& name);

  /// One row a material of the file, and a last one for primitives that have none.
  std::vector<SurfaceMaterial> Materials(const ReadContext& context) const;
  std::string NodeName(int node) const;
  /// Placements of the node's mesh in the node: one, or those of EXT_mesh_gpu_instancing.
  std::vector<Matrix4> Instances(int node) const;
  /// Triangles that primitive `primitive` of a mesh announces; -1 where it is not made of
  /// triangles.
  int64_t AnnouncedTriangles(int mesh, int primitive) const;
  int64_t PrimitiveCount(int mesh) const;
  /// The node's light (KHR_lights_punctual) and camera where it has one; `toWorld` places the node.
  std::optional<Light> NodeLight(int node, const Matrix4& toWorld) const;
  std::optional<Camera> NodeCamera(int node, const Matrix4& toWorld) const;

 private:
  using Json = nlohmann::json;

  void ParseBinary(const std::string& bytes);
  void CheckExtensions() const;
  void CheckAccessors() const;
  void CheckNodes() const;
  const Json& Row(const char* table, int index) const;
  std::string_view Resource(const Json& owner, std::string* storage) const;
  std::string_view BufferView(int index, std::string* storage) const;
  std::vector<double> Accessor(int index, size_t components) const;
  TextureMap Texture(const Json& info, const TextureDecoding& decoding,
                     const ReadContext& context) const;
  SurfaceMaterial ReadMaterial(const Json& source, const ReadContext& context) const;
  Error Broken(const std::string& what) const;

  std::string path_, folder_;
  Json json_;
  std::string binary_;  ///< the BIN chunk of a .glb
  bool isBinary_ = false;
};

}  // namespace lambert
