#include "LitModel.h"

#include "Atlas/Core/BrightenedImage.h"
#include "Atlas/Core/ChartMesh.h"
#include "Atlas/Core/RadiosityMap.h"
#include "Atlas/Core/ShownSides.h"
#include "Atlas/Core/SurfaceSubset.h"
#include "Display/Core/DefaultCamera.h"
#include "Display/Core/ToneMapping.h"
#include "Display/Core/UpAxis.h"
#include "PngImage.h"
#include "Scene/Core/BaseTexture.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

namespace lambert {
namespace {
ToneMapping AdaptTo(const RadiositySolution& solution, const ToneMappingOptions& options) {
  return ToneMapping(LuminanceSamples(solution.mesh, solution.radiosity), options);
}

/// Full white encodes to a little under 1 in floats.
bool IsClipped(const Spectrum& display) { return display.MaxBand() >= SrgbFromLinear(1); }

LitModel EmptyModel(const Scene& scene, const RadiositySolution& solution) {
  LitModel model;
  model.name =
      scene.parts.empty() ? "" : std::filesystem::path(scene.parts[0].source).stem().string();
  model.camera = scene.camera ? *scene.camera
                              : DefaultCamera(solution.mesh, solution.radiosity, 4. / 3,
                                              GuessUpAxis(solution.mesh));
  return model;
}

/// What the display shows of `light`, linear. Counts what is brighter than it.
Spectrum LinearDisplay(const ToneMapping& toneMapping, const Spectrum& light, int64_t* clipped) {
  const Spectrum display = toneMapping.Apply(light);
  *clipped += IsClipped(display);
  return {LinearFromSrgb(display.r), LinearFromSrgb(display.g), LinearFromSrgb(display.b)};
}

/// Adds triangles of the solution, lit at their points.
class PointLitMeshes {
 public:
  PointLitMeshes(const Scene& scene, const RadiositySolution& solution,
                 const BaseTextures* textures, const ToneMapping& toneMapping, LitModel* model)
      : scene_(scene),
        solution_(solution),
        textures_(textures),
        toneMapping_(toneMapping),
        model_(*model) {}

  /// A mesh of what has no texture, and one for each material that has one.
  void Add(const std::vector<int64_t>& triangles) {
    std::vector<int64_t> plain;
    std::map<int32_t, std::vector<int64_t>> textured;
    for (const int64_t triangle : triangles) {
      const int64_t face = this->solution_.inputFaceId[static_cast<size_t>(triangle)];
      if (this->textures_ && this->textures_->IsTextured(face)) {
        textured[this->scene_.mesh.materialId[static_cast<size_t>(face)]].push_back(triangle);
      } else {
        plain.push_back(triangle);
      }
    }
    this->AddColored(plain);
    const size_t firstTextured = this->model_.meshes.size();
    for (const auto& [material, ofMaterial] : textured) {
      this->AddTextured(material, ofMaterial);
    }
    this->BrightenImages(firstTextured);
  }

 private:
  LitMesh TakeMesh(const std::vector<int64_t>& triangles, std::vector<int64_t>* points) const {
    TriangleMesh taken = TakeFaces(this->solution_.mesh, triangles, points);
    LitMesh lit;
    lit.positions = std::move(taken.positions);
    lit.triangles = std::move(taken.triangles);
    return lit;
  }

  void AddColored(const std::vector<int64_t>& triangles) {
    if (triangles.empty()) {
      return;
    }
    std::vector<int64_t> points;
    LitMesh lit = this->TakeMesh(triangles, &points);
    lit.name = "lit at its points";
    for (const int64_t point : points) {
      lit.colors.push_back(LinearDisplay(this->toneMapping_,
                                         this->solution_.radiosity[static_cast<size_t>(point)],
                                         &this->model_.clippedPoints));
    }
    this->model_.meshes.push_back(std::move(lit));
  }

  /// Colours by which the mean of the image becomes what the display shows of the texture's mean,
  /// above 1 where the image is too dark for that.
  void AddTextured(int32_t material, const std::vector<int64_t>& triangles) {
    const Material& surface = this->scene_.materials[static_cast<size_t>(material)];
    const BaseTexture& texture = *surface.baseTexture;
    std::vector<int64_t> points;
    LitMesh lit = this->TakeMesh(triangles, &points);
    lit.name = surface.name;
    lit.image = this->ImageOf(texture);
    lit.alphaCutoff = texture.source->decoding.alphaCutoff;
    const Spectrum mean = this->textures_->MeanReflectance(material);
    for (const int64_t point : points) {
      const size_t p = static_cast<size_t>(point);
      const Spectrum shown = LinearDisplay(this->toneMapping_, mean * this->solution_.irradiance[p],
                                           &this->model_.clippedPoints);
      Spectrum light;
      for (int band = 0; band < 3; ++band) {
        light[band] = mean[band] > 0 ? texture.factor[band] * shown[band] / mean[band] : 0;
      }
      lit.colors.push_back(light);
      lit.textureCoords.push_back(PlaceInImage(texture.map, this->solution_.mesh.uvs[p]));
    }
    this->model_.meshes.push_back(std::move(lit));
  }

  /// No format lets a colour exceed 1. Images that are too dark for their colours are brightened,
  /// as far as their own texels stay within the display; colours that are above 1 still clip.
  void BrightenImages(size_t firstMesh) {
    std::map<int, Spectrum> factors;
    const auto forEachColor = [&](const auto& visit) {
      for (size_t mesh = firstMesh; mesh < this->model_.meshes.size(); ++mesh) {
        for (Spectrum& color : this->model_.meshes[mesh].colors) {
          visit(&color, &factors[this->model_.meshes[mesh].image]);
        }
      }
    };
    forEachColor([](Spectrum* color, Spectrum* most) {
      for (int band = 0; band < 3; ++band) {
        (*most)[band] = std::max((*most)[band], (*color)[band]);
      }
    });
    for (auto& [image, factor] : factors) {
      LitImage& lit = this->model_.images[static_cast<size_t>(image)];
      const Spectrum room =
          factor.MaxBand() > 1 ? RoomAbove(lit.file, this->alphaCutoffs_.at(image)) : Spectrum(1.f);
      for (int band = 0; band < 3; ++band) {
        factor[band] = std::clamp(factor[band], 1.f, room[band]);
      }
      if (factor.MaxBand() > 1) {
        lit.file = Brightened(lit.file, factor);
      }
    }
    forEachColor([&](Spectrum* color, const Spectrum* factor) {
      bool isClipped = false;
      for (int band = 0; band < 3; ++band) {
        (*color)[band] /= (*factor)[band];
        isClipped |= (*color)[band] > 1;
        (*color)[band] = std::min(1.f, (*color)[band]);
      }
      this->model_.clippedPoints += isClipped;
    });
  }

  /// v upward.
  static Vec2f PlaceInImage(const TextureMap& map, const Vec2f& uv) {
    const auto& m = map.fromUv;
    return Vec2f(Vec2d(m[0] * uv.x + m[1] * uv.y + m[2], 1 - (m[3] * uv.x + m[4] * uv.y + m[5])));
  }

  /// The row of its image; materials share one where they look it up alike.
  int ImageOf(const BaseTexture& texture) {
    const auto [known, isNew] =
        this->images_.try_emplace({texture.source.get(), texture.map.wrapU, texture.map.wrapV},
                                  static_cast<int>(this->model_.images.size()));
    if (isNew) {
      LitImage image;
      image.name = std::filesystem::path(texture.source->name).filename().string();
      image.file = ViewerImageOf(texture.source->bytes);
      image.wrapU = texture.map.wrapU;
      image.wrapV = texture.map.wrapV;
      this->alphaCutoffs_[known->second] = texture.source->decoding.alphaCutoff;
      this->model_.images.push_back(std::move(image));
    }
    return known->second;
  }

  const Scene& scene_;
  const RadiositySolution& solution_;
  const BaseTextures* textures_;  ///< null: means show
  const ToneMapping& toneMapping_;
  LitModel& model_;
  std::map<std::tuple<const TextureSource*, TextureWrap, TextureWrap>, int> images_;
  std::map<int, float> alphaCutoffs_;  ///< by row of an image
};

/// What a viewer shows that multiplies an image by light: sRGB, [0, 1].
Spectrum WithContrast(Spectrum display, const Spectrum& contrast) {
  for (int band = 0; band < 3; ++band) {
    display[band] = SrgbFromLinear(std::min(1.f, LinearFromSrgb(display[band]) * contrast[band]));
  }
  return display;
}

/// A page as an image; clipped texels count where a chart lies.
LitImage ImageOfPage(const RadiosityPage& page, const ToneMapping& toneMapping, int64_t* clipped) {
  LitImage image;
  image.width = image.height = page.size;
  image.codes.reserve(page.texels.size() * 3);
  const size_t side = static_cast<size_t>(page.size);
  for (size_t row = side; row-- > 0;) {
    for (size_t texel = row * side; texel < (row + 1) * side; ++texel) {
      Spectrum display = toneMapping.Apply(page.texels[texel]);
      if (!page.contrast.empty()) {
        display = WithContrast(display, page.contrast[texel]);
      }
      *clipped += page.isInChart[texel] && IsClipped(display);
      for (const uint8_t code : ToneMapping::Codes(display)) {
        image.codes.push_back(code);
      }
    }
  }
  return image;
}

/// What a light map shows of a scene.
struct MappedFaces {
  const TriangleMesh& mesh;  ///< in the order of the atlas
  const RadiosityAtlas& atlas;
  const LightMap& map;
  std::vector<uint8_t> sides;          ///< by surface: that shows
  std::vector<int64_t> inputFace;      ///< by face: of the scene
  std::vector<uint8_t> inputSide;      ///< by face: the side of that face which shows
  std::vector<int64_t> facesAtPoints;  ///< of the scene, whose surfaces are lit at their points
};

/// Faces whose light the map holds, but for those that `keeps` its textures: by face, whether the
/// side that shows is lit. The triangles of the solution that lie elsewhere go to `others`.
template <class Keeps>
std::vector<bool> LitFaces(const TriangleMesh& scene, const MappedFaces& mapped,
                           const RadiositySolution& solution, const Keeps& keeps,
                           std::vector<int64_t>* others) {
  // By face of the scene and side: what shows it.
  std::vector<std::array<int64_t, 2>> shows(scene.triangles.size(), {-1, -1});
  for (size_t face = 0; face < mapped.inputFace.size(); ++face) {
    shows[static_cast<size_t>(mapped.inputFace[face])][mapped.inputSide[face]] =
        static_cast<int64_t>(face);
  }
  std::vector<bool> isLit(mapped.inputFace.size(), false);
  for (size_t triangle = 0; triangle < solution.side.size(); ++triangle) {
    const int64_t inputFace = solution.inputFaceId[triangle];
    const int64_t face = shows[static_cast<size_t>(inputFace)][solution.side[triangle]];
    if (face >= 0 && !keeps(inputFace)) {
      isLit[static_cast<size_t>(face)] = true;
    } else {
      others->push_back(static_cast<int64_t>(triangle));
    }
  }
  return isLit;
}

/// The mapped faces of a page, wound towards the side that shows.
LitMesh MeshOfPage(const TriangleMesh& split, const std::vector<Vec2f>& textureCoords,
                   const std::vector<int32_t>& pageOfFace, int page, const std::vector<bool>& isLit,
                   const std::vector<uint8_t>& sides) {
  std::vector<int64_t> faces, points;
  for (size_t face = 0; face < split.triangles.size(); ++face) {
    if (pageOfFace[face] == page && isLit[face]) {
      faces.push_back(static_cast<int64_t>(face));
    }
  }
  TriangleMesh taken = TakeFaces(split, faces, &points);
  LitMesh lit;
  lit.positions = std::move(taken.positions);
  lit.triangles = std::move(taken.triangles);
  for (int64_t point : points) {
    lit.textureCoords.push_back(textureCoords[static_cast<size_t>(point)]);
  }
  for (size_t face = 0; face < lit.triangles.size(); ++face) {
    if (sides[static_cast<size_t>(taken.surfaceId[face])] == kBack) {
      std::swap(lit.triangles[face][1], lit.triangles[face][2]);
    }
  }
  return lit;
}

/// What the light map shows, a mesh and an image a page; then all else that is lit, by its points.
LitModel MakeMappedModel(const Scene& scene, const RadiositySolution& solution,
                         const MappedFaces& mapped, const LitModelOptions& options) {
  // What leaves the surfaces of the map.
  LitModel model = EmptyModel(scene, solution);
  const BaseTextures textures(scene);
  const ToneMapping toneMapping = AdaptTo(solution, options.tone);
  const BaseTextures texturesOfMap = textures.On(mapped.mesh);
  const auto isTextured = [&](int64_t face) { return textures.IsTextured(face); };
  const bool isTextureApart =
      options.texturesAtPoints &&
      std::any_of(mapped.facesAtPoints.begin(), mapped.facesAtPoints.end(), isTextured);
  const std::vector<RadiosityPage> pages = MakeRadiosityMap(
      mapped.mesh, mapped.atlas, mapped.map, mapped.sides,
      options.keepTextures ? nullptr : &texturesOfMap, options.bakedSize, isTextureApart);

  // Its faces.
  std::vector<int64_t> others;
  const auto keepsTexture = [&](int64_t face) { return options.keepTextures && isTextured(face); };
  const std::vector<bool> isLit = LitFaces(scene.mesh, mapped, solution, keepsTexture, &others);
  TriangleMesh split = mapped.mesh;
  const std::vector<Vec2f> textureCoords = SplitAtCharts(mapped.atlas, &split);
  std::vector<int32_t> pageOfFace;
  for (int32_t chart : ChartOfFace(mapped.atlas.set)) {
    pageOfFace.push_back(mapped.atlas.pageOfChart[static_cast<size_t>(chart)]);
  }
  for (int page = 0; page < mapped.atlas.pages; ++page) {
    LitMesh mesh = MeshOfPage(split, textureCoords, pageOfFace, page, isLit, mapped.sides);
    if (mesh.triangles.empty()) {
      continue;
    }
    const RadiosityPage& radiosity = pages[static_cast<size_t>(page)];
    mesh.name = "light map " + std::to_string(page);
    mesh.image = static_cast<int>(model.images.size());
    model.images.push_back(ImageOfPage(radiosity, toneMapping, &model.clippedTexels));
    model.images.back().name = mesh.name;
    model.bakedTexels += radiosity.isTextured ? int64_t(radiosity.texels.size()) : 0;
    model.meshes.push_back(std::move(mesh));
  }

  // Lit sides that it does not hold.
  const BaseTextures* shown = options.texturesAtPoints ? &textures : nullptr;
  PointLitMeshes(scene, solution, shown, toneMapping, &model).Add(others);
  return model;
}
}  // namespace

LitModel MakeLitModel(const Scene& scene, const RadiositySolution& solution,
                      const LitModelOptions& options) {
  LitModel model = EmptyModel(scene, solution);
  std::optional<BaseTextures> textures;
  if (options.texturesAtPoints) {
    textures.emplace(scene);
  }
  const ToneMapping toneMapping = AdaptTo(solution, options.tone);
  std::vector<int64_t> triangles(solution.mesh.triangles.size());
  std::iota(triangles.begin(), triangles.end(), int64_t(0));
  PointLitMeshes(scene, solution, textures ? &*textures : nullptr, toneMapping, &model)
      .Add(triangles);
  return model;
}

LitModel MakeLitModel(const Scene& scene, const RadiositySolution& solution,
                      const RadiosityAtlas& atlas, const LightMap& map,
                      const LitModelOptions& options) {
  MappedFaces mapped{scene.mesh, atlas, map, BrighterSidesOfSurfaces(scene.mesh, solution),
                     {},         {},    {}};
  mapped.inputFace.resize(scene.mesh.triangles.size());
  std::iota(mapped.inputFace.begin(), mapped.inputFace.end(), int64_t(0));
  for (const int32_t surface : scene.mesh.surfaceId) {
    mapped.inputSide.push_back(mapped.sides[static_cast<size_t>(surface)]);
  }
  return MakeMappedModel(scene, solution, mapped, options);
}

LitModel MakeLitModel(const Scene& scene, const RadiositySolution& solution,
                      const RepresentedScene& represented, const LitModelOptions& options) {
  const SurfaceSubset& subset = represented.mapped;
  const MappedFaces mapped{subset.mesh,
                           represented.atlas,
                           represented.map,
                           BrighterSidesOfSurfaces(subset.mesh, subset.solution),
                           subset.inputFace,
                           SidesOfMappedFaces(represented),
                           represented.points.inputFaceId};
  return MakeMappedModel(scene, solution, mapped, options);
}
}  // namespace lambert
