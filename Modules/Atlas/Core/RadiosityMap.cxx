#include "Atlas/Core/RadiosityMap.h"

#include <algorithm>
#include <array>
#include <string>

#include "Atlas/Core/TexelRaster.h"
#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"

namespace lambert {

namespace {

size_t TexelOf(int size, const Vec2f& textureCoords) {
  const auto along = [&](float x) { return size_t(std::clamp(int(x * float(size)), 0, size - 1)); };
  return along(textureCoords.y) * size_t(size) + along(textureCoords.x);
}

/// Faces that hold the middle of no texel get those of their corners and their middle that are
/// still free.
void AddSmallFaces(const RadiosityAtlas& atlas, int page, std::vector<int32_t>* faces) {
  for (size_t i = 0; i < atlas.set.charts.size(); ++i) {
    if (atlas.pageOfChart[i] != page) continue;
    const Chart& chart = atlas.set.charts[i];
    for (const int32_t f : atlas.set.FacesOf(chart)) {
      const std::array<Vec2f, 3>& corners = atlas.textureCoords[size_t(f)];
      const Vec2f middle = (corners[0] + corners[1] + corners[2]) * (1.f / 3);
      for (const Vec2f& place : {middle, corners[0], corners[1], corners[2]}) {
        int32_t& face = (*faces)[TexelOf(atlas.pageSize, place)];
        if (face < 0) face = f;
      }
    }
  }
}

/// Texels without a face get that of the nearest that has one, in steps to the four neighbours.
void SpreadFaces(int size, std::vector<int32_t>* faces) {
  std::vector<size_t> front;
  for (size_t texel = 0; texel < faces->size(); ++texel) {
    if ((*faces)[texel] >= 0) front.push_back(texel);
  }
  const size_t side = size_t(size);
  for (size_t i = 0; i < front.size(); ++i) {
    const size_t texel = front[i], x = texel % side, y = texel / side;
    const auto reach = [&](bool isInside, size_t other) {
      if (!isInside || (*faces)[other] >= 0) return;
      (*faces)[other] = (*faces)[texel];
      front.push_back(other);
    };
    reach(x > 0, texel - 1);
    reach(x + 1 < side, texel + 1);
    reach(y > 0, texel - side);
    reach(y + 1 < side, texel + side);
  }
}

/// Whose texel it is, of a page of `atlas`, everywhere.
std::vector<int32_t> NearestFaces(const RadiosityAtlas& atlas, int page,
                                  std::vector<uint8_t>* isInChart) {
  std::vector<int32_t> faces = FacesOfTexels(atlas, page);
  for (const int32_t face : faces) isInChart->push_back(face >= 0);
  AddSmallFaces(atlas, page, &faces);
  SpreadFaces(atlas.pageSize, &faces);
  return faces;
}

/// By page: whether it holds a face with a base texture.
std::vector<bool> TexturedPages(const RadiosityAtlas& atlas, const BaseTextures* textures) {
  std::vector<bool> isTextured(size_t(atlas.pages), false);
  for (size_t i = 0; textures && i < atlas.set.charts.size(); ++i) {
    const Chart& chart = atlas.set.charts[i];
    for (const int32_t f : atlas.set.FacesOf(chart)) {
      if (textures->IsTextured(f)) isTextured[size_t(atlas.pageOfChart[i])] = true;
    }
  }
  return isTextured;
}

/// 0 in bands of nothing.
Spectrum Ratio(const Spectrum& part, const Spectrum& whole) {
  Spectrum ratio;
  for (int band = 0; band < 3; ++band) {
    ratio[band] = whole[band] > 0 ? part[band] / whole[band] : 0;
  }
  return ratio;
}

/// Reflectance at a place of an atlas, by the texture where the face has one.
Spectrum ReflectanceAt(const TriangleMesh& mesh, const RadiosityAtlas& atlas,
                       const BaseTextures* textures, int64_t face, const Vec2d& place) {
  if (!textures || !textures->IsTextured(face)) return mesh.reflectance[size_t(face)];
  std::array<Vec2d, 3> corners;
  for (size_t c = 0; c < 3; ++c) corners[c] = Vec2d(atlas.textureCoords[size_t(face)][c]);
  return textures->Reflectance(face, Barycentric(corners, place), atlas.texelSize);
}

}  // namespace

std::vector<RadiosityPage> MakeRadiosityMap(const TriangleMesh& mesh, const RadiosityAtlas& atlas,
                                            const LightMap& map, const std::vector<uint8_t>& sides,
                                            const BaseTextures* textures, int texturedSize,
                                            bool isTextureApart) {
  // The four belong together.
  if (atlas.textureCoords.size() != mesh.triangles.size() || map.pageSize != atlas.pageSize ||
      map.pages.size() != size_t(atlas.pages)) {
    throw Error("The light map and the atlas are not of this mesh of " +
                std::to_string(mesh.triangles.size()) + " faces.");
  }

  // The same atlas on pages of finer texels, for textures.
  const int parts = std::max(1, texturedSize / atlas.pageSize);
  RadiosityAtlas fine = atlas;
  fine.pageSize *= parts;
  fine.texelSize /= parts;

  const std::vector<bool> isTextured = TexturedPages(atlas, textures);
  std::vector<RadiosityPage> pages(map.pages.size());
  for (size_t p = 0; p < pages.size(); ++p) {
    const RadiosityAtlas& drawn = isTextured[p] ? fine : atlas;
    const bool isFiner = drawn.pageSize > map.pageSize;
    RadiosityPage& page = pages[p];
    page.size = drawn.pageSize;
    page.isTextured = isTextured[p];
    const std::vector<int32_t> faces = NearestFaces(drawn, int(p), &page.isInChart);

    // What leaves it, row by row.
    page.texels.resize(faces.size());
    const bool hasContrast = page.isTextured && isTextureApart;
    if (hasContrast) page.contrast.assign(faces.size(), Spectrum(1.f));
    ParallelForEach(page.size, 16, [&](int64_t y) {
      for (int x = 0; x < page.size; ++x) {
        const size_t texel = size_t(y) * size_t(page.size) + size_t(x);
        const Vec2d place((x + 0.5) / page.size, (double(y) + 0.5) / page.size);
        Spectrum& radiosity = page.texels[texel];
        radiosity = isFiner ? Lookup(map, int(p), Vec2f(place)) : map.pages[p][texel];
        const int32_t face = faces[texel];
        if (face < 0) continue;
        const auto side = static_cast<Side>(sides.at(size_t(mesh.surfaceId[size_t(face)])));
        Spectrum reflectance = ReflectanceAt(mesh, drawn, textures, face, place);
        if (hasContrast && textures->IsTextured(face)) {
          const Spectrum mean = textures->MeanReflectance(mesh.materialId[size_t(face)]);
          page.contrast[texel] = Ratio(reflectance, mean);
          reflectance = mean;
        }
        radiosity = radiosity * reflectance;
        if (mesh.Emits(face, side)) radiosity += mesh.emittance[size_t(face)];
      }
    });
  }
  return pages;
}

}  // namespace lambert
