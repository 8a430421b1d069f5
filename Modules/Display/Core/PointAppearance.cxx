#include "Display/Core/PointAppearance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "Common/Core/Error.h"
#include "Display/Core/RegularSplit.h"

namespace lambert {
namespace {

const Vec2f kNoPlace(-1, -1);

bool IsOnMap(const Vec2f& place) {
  return place.x >= 0 && place.x <= 1 && place.y >= 0 && place.y <= 1;
}

/// At the points, of what stands at the faces: the mean over the faces about each, by area.
std::vector<Spectrum> MeansAtPoints(const TriangleMesh& mesh,
                                    const std::vector<Spectrum>& ofFaces) {
  std::vector<Spectrum> means(mesh.positions.size());
  std::vector<float> areas(means.size());
  for (size_t face = 0; face < mesh.triangles.size(); ++face) {
    const float area = mesh.Area(int64_t(face));
    for (const int32_t point : mesh.triangles[face]) {
      means[size_t(point)] += area * ofFaces[face];
      areas[size_t(point)] += area;
    }
  }
  for (size_t point = 0; point < means.size(); ++point) {
    if (areas[point] > 0) means[point] = means[point] / areas[point];
  }
  return means;
}

/// Places on all pages, one above the other.
std::vector<Vec2f> PlacesOnMap(const TriangleMesh& mesh, const PointLight& light) {
  std::vector<Vec2f> places(mesh.positions.size(), kNoPlace);
  if (light.pages == 0 || light.lightMapCoords.empty()) return places;
  for (size_t face = 0; face < mesh.triangles.size(); ++face) {
    const int32_t page = light.page.empty() ? 0 : light.page[face];
    for (const int32_t point : mesh.triangles[face]) {
      const Vec2f& onPage = light.lightMapCoords[size_t(point)];
      if (!IsOnMap(onPage)) continue;
      places[size_t(point)] = {onPage.x, (onPage.y + float(page)) / float(light.pages)};
    }
  }
  return places;
}

/// Pieces along the edges of a face that is seen by the light of its points.
constexpr int kPieces = 2;

/// Pieces along the edges of a face so that each is some four texels wide; few, for its mean is
/// all that is asked.
int SplitOverTexels(const std::array<Vec2f, 3>& at, const LightImage& map) {
  constexpr float kTexels = 4;
  constexpr int kMostPieces = 32;
  const Vec2f edge1 = at[1] - at[0], edge2 = at[2] - at[0];
  const float width = std::max(std::abs(edge1.x), std::abs(edge2.x)) * float(map.width);
  const float height = std::max(std::abs(edge1.y), std::abs(edge2.y)) * float(map.height);
  return std::clamp(int(std::max(width, height) / kTexels), kPieces, kMostPieces);
}

/// What varies linearly between three corners, at the barycentrics of corners 1 and 2.
template <class T>
T Between(const std::array<T, 3>& corners, const Vec2f& place) {
  return corners[0] * (1 - place.x - place.y) + corners[1] * place.x + corners[2] * place.y;
}

void RequireLengths(const TriangleMesh& mesh, const PointLight& light) {
  const auto fits = [](size_t length, size_t wanted) { return length == 0 || length == wanted; };
  const size_t points = mesh.positions.size();
  if (!fits(light.irradiance.size(), points) || !fits(light.radiosity.size(), points) ||
      !fits(light.lightMapCoords.size(), points) ||
      !fits(light.page.size(), mesh.triangles.size())) {
    throw Error("The light at the points, or the pages of the faces, are not as many as these.");
  }
}

}  // namespace

PointAppearance MakePointAppearance(const TriangleMesh& mesh, const PointLight& light,
                                    bool textured) {
  RequireLengths(mesh, light);
  PointAppearance appearance;
  appearance.reflectance = MeansAtPoints(mesh, mesh.reflectance);
  appearance.vertexRadiosity = MeansAtPoints(mesh, mesh.emittance);
  appearance.vertexIrradiance.resize(mesh.positions.size());
  appearance.lightMapCoords = PlacesOnMap(mesh, light);

  // What the map does not light shows the light of its points.
  const bool asItStands = !light.radiosity.empty() && !textured;
  for (size_t point = 0; point < mesh.positions.size(); ++point) {
    if (IsOnMap(appearance.lightMapCoords[point])) continue;
    if (asItStands) {
      appearance.vertexRadiosity[point] = light.radiosity[point];
    } else if (light.irradiance.empty()) {
      throw Error(
          "The mesh has points without light: run a radiosity method first, or give the pages of "
          "its light map.");
    } else if (textured) {
      appearance.vertexIrradiance[point] = light.irradiance[point];
    } else {
      appearance.vertexRadiosity[point] += appearance.reflectance[point] * light.irradiance[point];
    }
  }
  return appearance;
}

std::vector<LuminanceSample> ShownSamples(const TriangleMesh& mesh,
                                          const PointAppearance& appearance,
                                          const LightImage& map) {
  std::vector<LuminanceSample> samples;
  for (size_t face = 0; face < mesh.triangles.size(); ++face) {
    if (!mesh.emittance[face].IsBlack()) continue;

    // Places on it, some texels apart where it is lit by the map.
    std::array<Vec2f, 3> at;
    std::array<Spectrum, 3> light;
    for (size_t corner = 0; corner < 3; ++corner) {
      const size_t point = size_t(mesh.triangles[face][corner]);
      at[corner] = appearance.lightMapCoords[point];
      light[corner] = appearance.vertexRadiosity[point] +
                      appearance.reflectance[point] * appearance.vertexIrradiance[point];
    }
    const bool byMap = IsOnMap(at[0]) && !map.pixels.empty();
    const int n = byMap ? SplitOverTexels(at, map) : kPieces;
    const float share = mesh.Area(int64_t(face)) / float(n * n);
    ForEachMiddleOfSplit(n, [&](const Vec2f& place) {
      Spectrum shown = Between(light, place);
      const Vec2f texel = Between(at, place);
      if (byMap) shown += mesh.reflectance[face] * map.At(texel.x, texel.y);
      samples.push_back({Luminance(shown), share});
    });
  }
  return samples;
}

}  // namespace lambert
