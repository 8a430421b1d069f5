#include "Scene/Core/BaseTexture.h"

#include <algorithm>
#include <cmath>

namespace lambert {

namespace {

Spectrum Clamped(const Spectrum& reflectance) {
  Spectrum clamped;
  for (int band = 0; band < 3; ++band) {
    clamped[band] = std::clamp(reflectance[band], 0.f, kMaximumReflectance);
  }
  return clamped;
}

double TwiceArea(const std::array<Vec2f, 3>& corners) {
  const Vec2d u(corners[1] - corners[0]), v(corners[2] - corners[0]);
  return std::abs(u.x * v.y - u.y * v.x);
}

}  // namespace

BaseTextures::BaseTextures(const Scene& scene) : mesh_(&scene.mesh) {
  TextureLibrary library;
  for (const Material& material : scene.materials) {
    Decoded decoded;
    if (material.baseTexture && !scene.mesh.uvs.empty()) {
      const TextureSource& source = *material.baseTexture->source;
      decoded.map = material.baseTexture->map;
      decoded.map.image = library.AddMemory(
          source.name, reinterpret_cast<const unsigned char*>(source.bytes.data()),
          source.bytes.size(), source.decoding);
      decoded.factor = material.baseTexture->factor;
    }
    byMaterial_.push_back(decoded);
  }
  library_ = std::make_shared<const TextureLibrary>(std::move(library));
}

BaseTextures BaseTextures::On(const TriangleMesh& mesh) const {
  BaseTextures textures = *this;
  textures.mesh_ = &mesh;
  return textures;
}

bool BaseTextures::IsTextured(int64_t face) const {
  const TriangleMesh& mesh = *mesh_;
  return byMaterial_[size_t(mesh.materialId[size_t(face)])].map && !mesh.Emits(face, kFront) &&
         !mesh.Emits(face, kBack);
}

Spectrum BaseTextures::Reflectance(int64_t face, const std::array<double, 3>& weights,
                                   double width) const {
  // Where the place lies in the image, and how wide it is there.
  const TriangleMesh& mesh = *mesh_;
  const Decoded& texture = byMaterial_[size_t(mesh.materialId[size_t(face)])];
  std::array<Vec2f, 3> uvs;
  Vec2d uv;
  for (size_t c = 0; c < 3; ++c) {
    uvs[c] = mesh.uvs[size_t(mesh.triangles[size_t(face)][c])];
    uv = uv + Vec2d(uvs[c]) * weights[c];
  }
  const auto& m = texture.map.fromUv;
  const double imageArea = 0.5 * TwiceArea(uvs) * std::abs(m[0] * m[4] - m[1] * m[3]);
  const double area = double(mesh.Area(face));
  const double inImage = area > 0 ? width * std::sqrt(imageArea / area) : 0;
  return Clamped(texture.factor * library_->Lookup(texture.map, Vec2f(uv), inImage).colour);
}

Spectrum BaseTextures::MeanReflectance(int32_t material) const {
  const Decoded& texture = byMaterial_[size_t(material)];
  return Clamped(texture.factor * library_->ImageMean(texture.map).colour);
}

}  // namespace lambert
