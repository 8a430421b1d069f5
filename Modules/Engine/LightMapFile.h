// Light maps as files: the mesh with its texture coordinates, and a picture of floats a page. C++
// only.
#ifndef LightMapFile_h
#define LightMapFile_h

#include "Atlas/Core/LightMap.h"
#include "Atlas/Core/SurfaceRepresentation.h"
#include "Scene/Core/Scene.h"
#include "lambertEngineModule.h"

#include <string>
#include <vector>

namespace lambert {
/// Names of the pages of the light map NAME.vtp: NAME-0.hdr, NAME-1.hdr, ...
LAMBERTENGINE_EXPORT std::vector<std::string> LightMapPageNames(const std::string& fileName,
                                                                int pages);

/// Writes NAME.vtp, the mesh of `scene` with LightMapTCoords, ChartId and PageId, and beside it a
/// page each as Radiance HDR: irradiance, W/m2, three bands, the row of v = 1 first. Throws Error
/// where a file cannot be written.
LAMBERTENGINE_EXPORT void WriteLightMap(const RadiosityAtlas& atlas, const LightMap& map,
                                        const Scene& scene, const std::string& fileName);

/// The same of a scene whose surfaces are lit by their points or by the light map: NAME.vtp has
/// Irradiance at its points, and LightMapTCoords of (-1, -1) where these light.
LAMBERTENGINE_EXPORT void WriteRepresentedScene(const RepresentedScene& represented,
                                                const Scene& scene, const std::string& fileName);
}  // namespace lambert

#endif
