// Light maps as files: the mesh with its texture coordinates, and its pages. C++ only.
#ifndef LightMapFile_h
#define LightMapFile_h

#include "Atlas/Core/LightMapPages.h"
#include "Atlas/Core/SurfaceRepresentation.h"
#include "Display/Core/ToneMapping.h"
#include "Scene/Core/Scene.h"
#include "lambertEngineModule.h"

#include <string>
#include <vector>

namespace lambert {
/// Writes NAME.vtp or NAME.vtpc, the mesh of `scene` with LightMapTCoords, ChartId and PageId;
/// where it is that of `shown`, InputFaceId and Side. Throws Error where the file cannot be
/// written.
LAMBERTENGINE_EXPORT void WriteLightMap(const RadiosityAtlas& atlas, const Scene& scene,
                                        const ShownSides* shown, const std::string& fileName);

/// The same of a scene whose surfaces are lit by their points or by the light map: NAME.vtp has
/// Irradiance at its points, LightMapTCoords of (-1, -1) and ChartId -1 where these light, and
/// InputFaceId.
LAMBERTENGINE_EXPORT void WriteRepresentedScene(const RepresentedScene& represented,
                                                const Scene& scene, const std::string& fileName);

/// Writes the pages of the map beside it in every one of `formats`, as LightMapPages.h tells. PNG
/// shows a white surface in the light, exposed and tone mapped for the solution.
LAMBERTENGINE_EXPORT void WritePages(const LightMap& map, const RadiositySolution& solution,
                                     const ToneMappingOptions& tone, const std::string& fileName,
                                     const std::vector<PageFormat>& formats);
}  // namespace lambert

#endif
