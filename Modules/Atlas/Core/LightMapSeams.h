// Where lookups in a light map have to agree: along the edges between its charts, and along the
// border of what it shows.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "Atlas/Core/LightMap.h"

namespace lambert {

/// The four texels around a place and their parts of a lookup there.
struct Footprint {
  std::array<size_t, 4> texels;
  std::array<double, 4> parts;

  Footprint(int size, const Vec2f& textureCoords) {
    const double x = double(textureCoords.x) * size - 0.5, y = double(textureCoords.y) * size - 0.5;
    const int left = int(std::floor(x)), low = int(std::floor(y));
    const double u = x - left, v = y - low;
    const auto texel = [&](int column, int row) {
      column = std::min(size - 1, std::max(0, column));
      row = std::min(size - 1, std::max(0, row));
      return size_t(row) * size_t(size) + size_t(column);
    };
    texels = {texel(left, low), texel(left + 1, low), texel(left, low + 1),
              texel(left + 1, low + 1)};
    parts = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
  }
  Spectrum Lookup(const std::vector<Spectrum>& page) const {
    Spectrum sum;
    for (size_t i = 0; i < 4; ++i) sum += page[texels[i]] * float(parts[i]);
    return sum;
  }
};

/// Calls visit(part, isClosed) for places from one end of an edge, 0, to the other, 1, that is
/// `length` texels long: every half texel and at the ends lookups are made to agree, and halfway
/// between they are measured, too.
template <class Visit>
void ForEachPlaceAlong(float length, const Visit& visit) {
  const int count = 2 * (1 + int(2 * length));
  for (int i = 0; i <= count; ++i) visit(float(i) / float(count), i % 2 == 0);
}

/// A point of a seam as it lies on both sides; on a border the light beyond is fixed.
struct SeamPoint {
  std::array<int32_t, 2> pages;  ///< the second is -1 on a border
  std::array<Footprint, 2> footprints;
  Spectrum fixed;        ///< of the second side of a border, W/m2
  bool isClosed = true;  ///< else it is only measured
};

/// Along every cut edge whose faces share its points (ForEachPlaceAlong): what they do not share is
/// creased, and light may differ. Then the borders.
std::vector<SeamPoint> FindSeams(const TriangleMesh& mesh, const RadiosityAtlas& atlas,
                                 const std::vector<int32_t>& chartOfFace,
                                 const std::vector<BorderPoint>& borders);

/// `mean` is the mean irradiance of the map, W/m2.
SeamDifference MeasureSeams(const std::vector<SeamPoint>& seams, const LightMap& map, double mean);

/// Moves the texels of seams by as little as may be until lookups on both sides agree, those that
/// no triangle gives light to before others; none gets darker than 0, nor brighter than 1.25 times
/// what is brightest about its places, on either side. All in parts of the light there or of
/// `mean`, whichever is more, or lamps would have all the say. `isDrawn`, by page and texel:
/// whether a triangle gives it light.
void CloseSeams(const std::vector<SeamPoint>& seams, double mean,
                const std::vector<std::vector<uint8_t>>& isDrawn, LightMap* map);

}  // namespace lambert
