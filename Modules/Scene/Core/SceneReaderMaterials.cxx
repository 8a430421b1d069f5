#include "Scene/Core/SceneReaderMaterials.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <filesystem>

#include "Common/Core/Error.h"
#include "Scene/Core/BaseTexture.h"

namespace lambert {

namespace {

Spectrum ToSpectrum(const aiColor3D& colour) { return {colour.r, colour.g, colour.b}; }

TextureWrap ToWrap(int mode) {
  if (mode == aiTextureMapMode_Clamp || mode == aiTextureMapMode_Decal) return TextureWrap::Clamp;
  return mode == aiTextureMapMode_Mirror ? TextureWrap::Mirror : TextureWrap::Repeat;
}

/// The file that a texture name means: as it stands, with separators of another system, or beside
/// the scene.
std::string TexturePath(std::string name, const std::string& folder) {
  namespace fs = std::filesystem;
  std::replace(name.begin(), name.end(), '\\', '/');
  const fs::path path(name), beside = fs::path(folder) / path.filename();
  const fs::path given = path.is_absolute() ? path : fs::path(folder) / path;
  std::error_code ignored;
  return !fs::exists(given, ignored) && fs::exists(beside, ignored) ? beside.string()
                                                                    : given.string();
}

int32_t AddEmbedded(const aiTexture& texture, const std::string& key,
                    const TextureDecoding& decoding, TextureLibrary* textures) {
  if (texture.mHeight == 0) {
    return textures->AddMemory(key, reinterpret_cast<const unsigned char*>(texture.pcData),
                               texture.mWidth, decoding);
  }
  std::vector<unsigned char> rgba;
  rgba.reserve(size_t(texture.mWidth) * texture.mHeight * 4);
  for (size_t i = 0; i < size_t(texture.mWidth) * texture.mHeight; ++i) {
    const aiTexel& texel = texture.pcData[i];
    rgba.insert(rgba.end(), {texel.r, texel.g, texel.b, texel.a});
  }
  return textures->AddPixels(key, int(texture.mWidth), int(texture.mHeight), rgba.data(), decoding);
}

TextureMap ReadTexture(const aiScene& scene, const aiMaterial& material, aiTextureType type,
                       const TextureDecoding& decoding, const std::string& folder,
                       const ReadContext& context) {
  TextureMap map;
  aiString name;
  if (material.GetTexture(type, 0, &name) != aiReturn_SUCCESS || name.length == 0) return map;
  const std::string path = TexturePath(name.C_Str(), folder);
  const aiTexture* embedded = scene.GetEmbeddedTexture(name.C_Str());
  map.image = embedded ? AddEmbedded(*embedded, path, decoding, &context.textures)
                       : context.textures.AddFile(path, decoding);
  int wrapU = aiTextureMapMode_Wrap, wrapV = aiTextureMapMode_Wrap;
  material.Get(AI_MATKEY_MAPPINGMODE_U(type, 0), wrapU);
  material.Get(AI_MATKEY_MAPPINGMODE_V(type, 0), wrapV);
  material.Get(AI_MATKEY_UVWSRC(type, 0), map.uvSet);
  map.wrapU = ToWrap(wrapU);
  map.wrapV = ToWrap(wrapV);

  // Scale and offset of the uvs, before v is turned to run down the image.
  aiUVTransform transform;
  if (material.Get(AI_MATKEY_UVTRANSFORM(type, 0), transform) == aiReturn_SUCCESS) {
    map.fromUv = {transform.mScaling.x,     0,
                  transform.mTranslation.x, 0,
                  -transform.mScaling.y,    1 - transform.mTranslation.y};
  }
  return map;
}

SurfaceMaterial ReadMaterial(const aiScene& scene, const aiMaterial& source,
                             const std::string& folder, const ReadContext& context) {
  SurfaceMaterial material;
  aiString name;
  if (source.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS) material.name = name.C_Str();

  // Reflectance: base colour of metals and others, else the diffuse colour.
  aiColor3D colour;
  material.reflectance = context.options.defaultReflectance;
  material.hasReflectance = source.Get(AI_MATKEY_BASE_COLOR, colour) == aiReturn_SUCCESS ||
                            source.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == aiReturn_SUCCESS;
  if (material.hasReflectance) material.reflectance = ToSpectrum(colour);
  source.Get(AI_MATKEY_METALLIC_FACTOR, material.metallic);
  material.base = ReadTexture(scene, source, aiTextureType_DIFFUSE, {}, folder, context);

  // Emission is radiance; a diffuse emitter of radiance L has the exitance M = pi L.
  if (source.Get(AI_MATKEY_COLOR_EMISSIVE, colour) == aiReturn_SUCCESS) {
    material.emittance = ToSpectrum(colour) * float(kPi);
  }
  material.emissive = ReadTexture(scene, source, aiTextureType_EMISSIVE, {}, folder, context);
  material.twoSidedEmitter = context.options.twoSidedEmitters;

  // Transparency.
  float transmission = 0;
  source.Get(AI_MATKEY_OPACITY, material.opacity);
  source.Get(AI_MATKEY_TRANSMISSION_FACTOR, transmission);
  material.transmits = transmission > 0.5f;
  TextureDecoding linear;
  linear.srgb = false;
  material.opacityMap = ReadTexture(scene, source, aiTextureType_OPACITY, linear, folder, context);
  return material;
}

}  // namespace

void ReadContext::Warn(const std::string& sentence) const {
  auto& warnings = assembly.report.warnings;
  if (std::find(warnings.begin(), warnings.end(), sentence) == warnings.end()) {
    warnings.push_back(sentence);
  }
}

std::vector<SurfaceMaterial> ReadMaterials(const aiScene& scene, const std::string& folder,
                                           const ReadContext& context) {
  std::vector<SurfaceMaterial> materials;
  for (unsigned row = 0; row < scene.mNumMaterials; ++row) {
    materials.push_back(ReadMaterial(scene, *scene.mMaterials[row], folder, context));
  }
  return materials;
}

Spectrum ClampReflectance(const Spectrum& value, bool* over) {
  Spectrum clamped;
  for (int band = 0; band < 3; ++band) {
    *over |= value[band] > kMaximumReflectance;
    clamped[band] = std::min(kMaximumReflectance, std::max(0.f, value[band]));
  }
  return clamped;
}

namespace {

/// The base texture as one that points are looked up in. Of metals that are black the mean counts,
/// and of what lies on other texture coordinates than the mesh keeps.
std::shared_ptr<const BaseTexture> KeptTexture(const SurfaceMaterial& source,
                                               const ReadContext& context) {
  const bool isDarkened = context.options.blackMetals && source.metallic > 0;
  if (!source.base || source.base.uvSet != 0 || isDarkened) return nullptr;
  const auto image = context.textures.Source(source.base);
  if (!image) return nullptr;
  return std::make_shared<BaseTexture>(BaseTexture{image, source.base, source.reflectance});
}

}  // namespace

int32_t AppendMaterial(const SurfaceMaterial& source, const std::string& file,
                       const ReadContext& context) {
  if (!source.reflectance.IsFinite() || !source.emittance.IsFinite()) {
    throw Error("The material \"" + source.name + "\" of \"" + file +
                "\" has a value that is not a finite number; repair the file.");
  }
  Material material;
  bool ignored = false;
  material.name = source.name;
  material.reflectance = ClampReflectance(source.reflectance, &ignored);
  for (int band = 0; band < 3; ++band)
    material.emittance[band] = std::max(0.f, source.emittance[band]);
  material.twoSidedEmitter = source.twoSidedEmitter;
  material.baseTexture = KeptTexture(source, context);
  context.assembly.report.maskedMaterials += source.masked;
  context.assembly.materials.push_back(material);
  return int32_t(context.assembly.materials.size()) - 1;
}

}  // namespace lambert
