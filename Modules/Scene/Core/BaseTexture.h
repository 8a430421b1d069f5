// The images that files give surfaces their colour with, for those who draw them. Light knows their
// means over triangles alone.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "Scene/Core/Scene.h"
#include "Scene/Core/SceneReaderTextures.h"

namespace lambert {

/// The texture of a material. It lies on the uvs of the mesh.
struct BaseTexture {
  std::shared_ptr<const TextureSource> source;
  TextureMap map;        ///< how it lies there; its row is the reader's
  Spectrum factor{1.f};  ///< that it is multiplied by, linear
};

/// The base textures of a scene, decoded.
class BaseTextures {
 public:
  /// `scene` outlives it.
  explicit BaseTextures(const Scene& scene);
  /// The same images on the faces of another mesh of the same materials, which outlives them.
  BaseTextures On(const TriangleMesh& mesh) const;

  /// Whether the face shows a texture; one that emits shows its light.
  bool IsTextured(int64_t face) const;
  /// Diffuse reflectance, [0, 0.98], at the barycentrics of a textured face, taken over about
  /// `width`, m.
  Spectrum Reflectance(int64_t face, const std::array<double, 3>& weights, double width) const;
  /// Of a material with a texture: the mean over its image, [0, 0.98].
  Spectrum MeanReflectance(int32_t material) const;

 private:
  struct Decoded {
    TextureMap map;  ///< in the library
    Spectrum factor;
  };

  const TriangleMesh* mesh_;
  std::shared_ptr<const TextureLibrary> library_;
  std::vector<Decoded> byMaterial_;
};

}  // namespace lambert
