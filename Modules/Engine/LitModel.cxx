#include "LitModel.h"

#include "Atlas/Core/ChartMesh.h"
#include "Atlas/Core/RadiosityMap.h"
#include "Atlas/Core/SurfaceSubset.h"
#include "Display/Core/DefaultCamera.h"
#include "Display/Core/ToneMapping.h"
#include "Display/Core/UpAxis.h"

#include <filesystem>
#include <numeric>

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

/// Adds `triangles` of the solution with colours at their points.
void AddColoredMesh(const RadiositySolution& solution, const std::vector<int64_t>& triangles,
                    const ToneMapping& toneMapping, LitModel* model) {
  if (triangles.empty()) {
    return;
  }
  std::vector<int64_t> points;
  TriangleMesh taken = TakeFaces(solution.mesh, triangles, &points);
  LitMesh lit;
  lit.name = "lit at its points";
  lit.positions = std::move(taken.positions);
  lit.triangles = std::move(taken.triangles);
  for (int64_t point : points) {
    const Spectrum display = toneMapping.Apply(solution.radiosity[static_cast<size_t>(point)]);
    model->clippedPoints += IsClipped(display);
    lit.colors.emplace_back(LinearFromSrgb(display.r), LinearFromSrgb(display.g),
                            LinearFromSrgb(display.b));
  }
  model->meshes.push_back(std::move(lit));
}

/// A page as an image; clipped texels count where a chart lies.
LitImage ImageOfPage(const std::vector<Spectrum>& radiosity, const std::vector<int32_t>& faces,
                     int size, const ToneMapping& toneMapping, int64_t* clipped) {
  LitImage image;
  image.width = image.height = size;
  image.codes.reserve(radiosity.size() * 3);
  const size_t side = static_cast<size_t>(size);
  for (size_t row = side; row-- > 0;) {
    for (size_t texel = row * side; texel < (row + 1) * side; ++texel) {
      const Spectrum display = toneMapping.Apply(radiosity[texel]);
      *clipped += faces[texel] >= 0 && IsClipped(display);
      for (uint8_t code : toneMapping.ApplyToBytes(radiosity[texel])) {
        image.codes.push_back(code);
      }
    }
  }
  return image;
}

/// Faces whose light the map holds: by face, whether the side that shows is lit. The triangles of
/// the solution that lie on other sides go to `others`.
std::vector<bool> MappedFaces(const TriangleMesh& mesh, const RadiositySolution& solution,
                              const std::vector<uint8_t>& sides, std::vector<int64_t>* others) {
  std::vector<bool> isMapped(mesh.triangles.size(), false);
  for (size_t triangle = 0; triangle < solution.side.size(); ++triangle) {
    const size_t face = static_cast<size_t>(solution.inputFaceId[triangle]);
    if (solution.side[triangle] == sides[static_cast<size_t>(mesh.surfaceId[face])]) {
      isMapped[face] = true;
    } else {
      others->push_back(static_cast<int64_t>(triangle));
    }
  }
  return isMapped;
}

/// The mapped faces of a page, wound towards the side that shows.
LitMesh MeshOfPage(const TriangleMesh& split, const std::vector<Vec2f>& textureCoords,
                   const std::vector<int32_t>& pageOfFace, int page,
                   const std::vector<bool>& isMapped, const std::vector<uint8_t>& sides) {
  std::vector<int64_t> faces, points;
  for (size_t face = 0; face < split.triangles.size(); ++face) {
    if (pageOfFace[face] == page && isMapped[face]) {
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
}  // namespace

LitModel MakeLitModel(const Scene& scene, const RadiositySolution& solution,
                      const ToneMappingOptions& tone) {
  LitModel model = EmptyModel(scene, solution);
  std::vector<int64_t> triangles(solution.mesh.triangles.size());
  std::iota(triangles.begin(), triangles.end(), int64_t(0));
  AddColoredMesh(solution, triangles, AdaptTo(solution, tone), &model);
  return model;
}

LitModel MakeLitModel(const Scene& scene, const RadiositySolution& solution,
                      const RadiosityAtlas& atlas, const LightMap& map,
                      const ToneMappingOptions& tone) {
  // What leaves the surfaces, and the sides on which it shows.
  LitModel model = EmptyModel(scene, solution);
  const ToneMapping toneMapping = AdaptTo(solution, tone);
  const std::vector<uint8_t> sides = BrighterSidesOfSurfaces(scene.mesh, solution);
  const std::vector<std::vector<Spectrum>> pages = MakeRadiosityMap(scene.mesh, atlas, map, sides);

  // Faces of the map, a mesh and an image a page.
  std::vector<int64_t> others;
  const std::vector<bool> isMapped = MappedFaces(scene.mesh, solution, sides, &others);
  TriangleMesh split = scene.mesh;
  const std::vector<Vec2f> textureCoords = SplitAtCharts(atlas, &split);
  std::vector<int32_t> pageOfFace;
  for (int32_t chart : ChartOfFace(atlas.set)) {
    pageOfFace.push_back(atlas.pageOfChart[static_cast<size_t>(chart)]);
  }
  for (int page = 0; page < atlas.pages; ++page) {
    LitMesh mesh = MeshOfPage(split, textureCoords, pageOfFace, page, isMapped, sides);
    if (mesh.triangles.empty()) {
      continue;
    }
    mesh.name = "light map " + std::to_string(page);
    mesh.image = static_cast<int>(model.images.size());
    model.images.push_back(ImageOfPage(pages[static_cast<size_t>(page)], FacesOfTexels(atlas, page),
                                       map.pageSize, toneMapping, &model.clippedTexels));
    model.images.back().name = mesh.name;
    model.meshes.push_back(std::move(mesh));
  }

  // Lit sides that it does not hold.
  AddColoredMesh(solution, others, toneMapping, &model);
  return model;
}
}  // namespace lambert
