// Finer texels where light varies (thesis 9.3.1): the error of a light map, chart by chart, and an
// atlas of the same charts that shares its texels so that it is least.
#pragma once

#include <vector>

#include "Atlas/Core/LightMap.h"
#include "Atlas/Core/RadiosityAtlas.h"
#include "Common/Core/Progress.h"
#include "Scene/Core/RadiositySolution.h"

namespace lambert {

/// Of lookups in a light map against the solution, on the sides that show.
struct ChartError {
  double area = 0;     ///< m2
  double squares = 0;  ///< of the differences of irradiance, times area: (W/m2)2 m2
  double light = 0;    ///< the same of irradiance itself
};
std::vector<ChartError> ErrorsOfCharts(const TriangleMesh& mesh, const RadiosityAtlas& atlas,
                                       const LightMap& map, const RadiositySolution& solution);
/// The relative RMS over all charts.
double RelativeError(const std::vector<ChartError>& errors);

/// By chart, texels a metre as a factor of what even texels have, a quarter to four times as many,
/// the number of texels in all as it was: as the cube root of the RMS error that even texels leave.
/// Where the squared error falls with the fourth power of a texel, as in smooth light, the sum is
/// least.
std::vector<double> DensitiesByError(const std::vector<ChartError>& errors);

/// Where the options ask for it, the charts of `atlas`, which has even texels, packed anew with
/// densities by the error of its light map; else `atlas` as it is. `mesh`, atlas and solution as
/// for MakeLightMap. Throws as PackAtlas and MakeLightMap do.
RadiosityAtlas WithTexelDensity(const TriangleMesh& mesh, RadiosityAtlas atlas,
                                const RadiositySolution& solution, const AtlasOptions& options,
                                const ProgressCallback& progress = {});

}  // namespace lambert
