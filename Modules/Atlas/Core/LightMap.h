// The light of a solution in the texels of an atlas (thesis 5.2.5, 5.2.6), its seams closed.
#pragma once

#include <cstdint>
#include <vector>

#include "Atlas/Core/RadiosityAtlas.h"
#include "Common/Core/Spectrum.h"
#include "Scene/Core/RadiositySolution.h"

namespace lambert {

/// By how much lookups on the two sides of a cut edge differ, where light does not: at points of
/// edges whose faces share their points, and at border points. Parts of the light there or of the
/// mean irradiance, whichever is more.
struct SeamDifference {
  double rms = 0, largest = 0;
};

/// A place on the border of what a light map shows, and what the points beyond it show there.
struct BorderPoint {
  int32_t page = 0;
  Vec2f textureCoords;   ///< [0, 1], v upward
  Spectrum irradiance;   ///< W/m2
  bool isClosed = true;  ///< else the difference there is measured alone
};

struct LightMap {
  int pageSize = 0;
  std::vector<std::vector<Spectrum>> pages;  ///< row after row from below, irradiance, W/m2
  int64_t coveredTexels = 0;                 ///< that a triangle gives light to
  int64_t seamPoints = 0;                    ///< at which seams are measured
  SeamDifference before, after;              ///< closing them
};

/// Irradiance in every texel: of the refined mesh where it covers one, extended by the padding of
/// the atlas where it does not, then by what is near on the page (pull-push), so that mip maps
/// take in nothing strange. Border texels are moved by least squares until bilinear lookups agree
/// along the cuts, and bring at `borders` what stands there. `mesh` is the solved mesh, in the
/// order of the atlas. Of a surface that is lit on both sides the brighter is kept: ShownSides
/// makes two surfaces of a sheet. Throws Error where the three do not belong together, Cancelled.
LightMap MakeLightMap(const TriangleMesh& mesh, const RadiosityAtlas& atlas,
                      const RadiositySolution& solution, const ProgressCallback& progress = {},
                      const std::vector<BorderPoint>& borders = {});

/// Bilinear lookup between the middles of texels; texture coordinates in [0, 1], v upward.
Spectrum Lookup(const LightMap& map, int page, const Vec2f& textureCoords);

}  // namespace lambert
