// An atlas of a whole mesh: charts, and where their corners lie on its pages (thesis 5.2).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "Atlas/Core/ChartSegmentation.h"
#include "Common/Core/Progress.h"

namespace lambert {

/// How many texels a metre charts have.
enum class TexelDensity : uint8_t {
  Uniform,      ///< all the same
  Illumination  ///< by the error that the light map of even texels makes on them (thesis 9.3.1)
};

struct AtlasOptions {
  double stretch = 2;    ///< of a chart, as a factor, [1, inf)
  int pageSize = 1024;   ///< texels along a side, [16, 16384]
  int pages = 1;         ///< the budget, [1, inf); counts where `texelSize` is 0
  double texelSize = 0;  ///< m, [0, inf), on up to 256 pages; 0: what fills the pages
  int padding = 2;       ///< texels between a chart and the edge of what it takes, [0, 64]
  /// Levels of mip maps above the pages themselves whose lookups inside charts take in nothing of
  /// others, [0, 5]: the padding is 1.5 * 2^levels texels at least.
  int mipLevels = 0;
  TexelDensity density = TexelDensity::Uniform;  ///< counts where there is a solution to follow

  bool operator==(const AtlasOptions& other) const;
};

struct RadiosityAtlas {
  ChartSet set;
  std::vector<int32_t> pageOfChart;                 ///< [0, pages)
  std::vector<std::array<Vec2f, 3>> textureCoords;  ///< by face: of its corners, [0, 1], v upward
  int pages = 0, pageSize = 0, padding = 0;
  double texelSize = 0;    ///< m; the mean where densities differ
  double utilisation = 0;  ///< area of the charts over that of the pages
  double chartSeconds = 0, packSeconds = 0;
};

/// Charts of every surface on pages. `mesh` is in the order of `tree`. Does not depend on the
/// number of threads. Throws Error for options out of range and for charts that do not fit,
/// Cancelled.
RadiosityAtlas MakeRadiosityAtlas(const TriangleMesh& mesh, const ClusterTree& tree,
                                  const AtlasOptions& options = {},
                                  const ProgressCallback& progress = {});

/// Texels between a chart and the edge of what it takes: as asked for, and for the mip maps.
int PaddingOf(const AtlasOptions& options);
/// Texels that a chart may be long.
int LongestChart(const AtlasOptions& options);

///@{ Its two steps, for those who repeat one of them. The charts that the options ask for, to be
/// cut
/// by CutIntoCharts; ChartSet::IsOf tells whether those of other options will do. And their places
/// on pages. Throw as above.
ChartOptions ChartOptionsOf(const ClusterTree& tree, const AtlasOptions& options);
RadiosityAtlas PackAtlas(ChartSet set, const AtlasOptions& options,
                         const ProgressCallback& progress = {});
///@}

/// Gives every chart points of its own: a point whose charts or places in them differ becomes
/// several. Returns the texture coordinates of each, [0, 1], and the points that they were.
std::vector<Vec2f> SplitAtCharts(const RadiosityAtlas& atlas, TriangleMesh* mesh,
                                 std::vector<int64_t>* points = nullptr);

/// Weights of the corners of a face at a place in its plane; all of the first where it has no area.
std::array<float, 3> WeightsInFace(const TriangleMesh& mesh, int64_t face, const Vec3f& place);
/// Texture coordinates of such a place, [0, 1].
Vec2f PlaceOnPage(const TriangleMesh& mesh, const RadiosityAtlas& atlas, int64_t face,
                  const Vec3f& place);

/// By texel of a page, row after row from below: the face that holds its middle; -1 where none
/// does.
std::vector<int32_t> FacesOfTexels(const RadiosityAtlas& atlas, int page);

}  // namespace lambert
