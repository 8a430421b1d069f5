// Materials as files describe them, before textures and vertex colours are counted into the faces.
#pragma once

#include <string>
#include <vector>

#include "Scene/Core/SceneReader.h"
#include "Scene/Core/SceneReaderTextures.h"

struct aiMaterial;
struct aiScene;

namespace lambert {

/// What a vertex colour does to the reflectance.
enum class VertexColourUse {
  Replaces,   ///< sRGB codes, the reflectance itself
  Multiplies  ///< linear factors (glTF COLOR_0)
};

struct SurfaceMaterial {
  std::string name;
  Spectrum reflectance{0.5f};  ///< factor of the base texture, linear, not clamped
  bool hasReflectance = true;  ///< false: the file gives none, vertex colours replace it
  float metallic = 0;          ///< factor of the metallic texture; counts where metals are black
  Spectrum emittance;          ///< factor of the emissive texture, W/m2
  bool twoSidedEmitter = false;
  float opacity = 1;  ///< factor of the base texture's alpha and of the opacity texture
  bool transmits = false;
  bool masked = false;    ///< alpha was cut to 0 or 1 when the base texture was decoded
  bool hasAlpha = false;  ///< the base texture's alpha counts
  VertexColourUse vertexColours = VertexColourUse::Replaces;
  TextureMap base, emissive, opacityMap, metallicMap;

  /// Whether vertex colours, where a mesh has them, count.
  bool TakesVertexColours() const {
    return vertexColours == VertexColourUse::Multiplies || !hasReflectance;
  }
};

/// What file readers work on: the scene that grows, what is asked for, and the images met so far.
struct ReadContext {
  const SceneReaderOptions& options;
  SceneAssembly& assembly;
  TextureLibrary& textures;

  /// Adds the sentence to the report's warnings, once.
  void Warn(const std::string& sentence) const;
};

/// The materials of any format but glTF, one a row of the scene's. `folder` is where texture names
/// start.
std::vector<SurfaceMaterial> ReadMaterials(const aiScene& scene, const std::string& folder,
                                           const ReadContext& context);

/// Adds the material to the scene's table and returns its row. Throws Error for a value that is not
/// finite.
int32_t AppendMaterial(const SurfaceMaterial& material, const std::string& file,
                       const ReadContext& context);

/// `value` within [0, kMaximumReflectance]; true in `over` where a band was beyond.
Spectrum ClampReflectance(const Spectrum& value, bool* over);

}  // namespace lambert
