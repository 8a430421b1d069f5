#include "LitModel.h"

#include "Atlas/Core/ChartMesh.h"
#include "Atlas/Core/RadiosityMap.h"
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

/// Numbers the points of a mesh that are used, in the order of their use.
class PointNumbers {
 public:
  explicit PointNumbers(size_t points) : Numbers(points, -1) {}

  /// Calls add(point) when a point is met first.
  template <class Add>
  std::array<int32_t, 3> operator()(const std::array<int32_t, 3>& triangle, const Add& add) {
    std::array<int32_t, 3> numbered;
    for (size_t c = 0; c < 3; ++c) {
      int32_t& number = this->Numbers[static_cast<size_t>(triangle[c])];
      if (number < 0) {
        number = this->Count++;
        add(static_cast<size_t>(triangle[c]));
      }
      numbered[c] = number;
    }
    return numbered;
  }

 private:
  std::vector<int32_t> Numbers;
  int32_t Count = 0;
};

/// Adds `triangles` of the solution with colours at their points.
void AddColoredMesh(const RadiositySolution& solution, const std::vector<size_t>& triangles,
                    const ToneMapping& toneMapping, LitModel* model) {
  if (triangles.empty()) {
    return;
  }
  LitMesh lit;
  lit.name = "lit at its points";
  PointNumbers numbers(solution.mesh.positions.size());
  for (size_t triangle : triangles) {
    lit.triangles.push_back(numbers(solution.mesh.triangles[triangle], [&](size_t point) {
      const Spectrum display = toneMapping.Apply(solution.radiosity[point]);
      model->clippedPoints += IsClipped(display);
      lit.positions.push_back(solution.mesh.positions[point]);
      lit.colors.emplace_back(LinearFromSrgb(display.r), LinearFromSrgb(display.g),
                              LinearFromSrgb(display.b));
    }));
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
                              const std::vector<uint8_t>& sides, std::vector<size_t>* others) {
  std::vector<bool> isMapped(mesh.triangles.size(), false);
  for (size_t triangle = 0; triangle < solution.side.size(); ++triangle) {
    const size_t face = static_cast<size_t>(solution.inputFaceId[triangle]);
    if (solution.side[triangle] == sides[static_cast<size_t>(mesh.surfaceId[face])]) {
      isMapped[face] = true;
    } else {
      others->push_back(triangle);
    }
  }
  return isMapped;
}

/// The mapped faces of a page, wound towards the side that shows.
LitMesh MeshOfPage(const TriangleMesh& split, const std::vector<Vec2f>& textureCoords,
                   const std::vector<int32_t>& pageOfFace, int page,
                   const std::vector<bool>& isMapped, const std::vector<uint8_t>& sides) {
  LitMesh lit;
  PointNumbers numbers(split.positions.size());
  for (size_t face = 0; face < split.triangles.size(); ++face) {
    if (pageOfFace[face] != page || !isMapped[face]) {
      continue;
    }
    std::array<int32_t, 3> corners = numbers(split.triangles[face], [&](size_t point) {
      lit.positions.push_back(split.positions[point]);
      lit.textureCoords.push_back(textureCoords[point]);
    });
    if (sides[static_cast<size_t>(split.surfaceId[face])] == kBack) {
      std::swap(corners[1], corners[2]);
    }
    lit.triangles.push_back(corners);
  }
  return lit;
}
}  // namespace

LitModel MakeLitModel(const Scene& scene, const RadiositySolution& solution,
                      const ToneMappingOptions& tone) {
  LitModel model = EmptyModel(scene, solution);
  std::vector<size_t> triangles(solution.mesh.triangles.size());
  std::iota(triangles.begin(), triangles.end(), size_t(0));
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
  std::vector<size_t> others;
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
