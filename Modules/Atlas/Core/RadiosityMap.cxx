#include "Atlas/Core/RadiosityMap.h"

#include <algorithm>
#include <array>
#include <string>

#include "Common/Core/Error.h"

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
    for (int32_t f = chart.firstFace; f < chart.firstFace + chart.faceCount; ++f) {
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

}  // namespace

std::vector<std::vector<Spectrum>> MakeRadiosityMap(const TriangleMesh& mesh,
                                                    const RadiosityAtlas& atlas,
                                                    const LightMap& map,
                                                    const std::vector<uint8_t>& sides) {
  // The four belong together.
  if (atlas.textureCoords.size() != mesh.triangles.size() || map.pageSize != atlas.pageSize ||
      map.pages.size() != size_t(atlas.pages)) {
    throw Error("The light map and the atlas are not of this mesh of " +
                std::to_string(mesh.triangles.size()) + " faces.");
  }

  std::vector<std::vector<Spectrum>> pages(map.pages.size());
  for (size_t page = 0; page < pages.size(); ++page) {
    // Whose texel it is.
    std::vector<int32_t> faces = FacesOfTexels(atlas, int(page));
    AddSmallFaces(atlas, int(page), &faces);
    SpreadFaces(atlas.pageSize, &faces);

    // What leaves it.
    pages[page] = map.pages[page];
    for (size_t texel = 0; texel < faces.size(); ++texel) {
      if (faces[texel] < 0) continue;
      const size_t face = size_t(faces[texel]);
      const auto side = static_cast<Side>(sides.at(size_t(mesh.surfaceId[face])));
      pages[page][texel] = pages[page][texel] * mesh.reflectance[face];
      if (mesh.Emits(int64_t(face), side)) pages[page][texel] += mesh.emittance[face];
    }
  }
  return pages;
}

}  // namespace lambert
