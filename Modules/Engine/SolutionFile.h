// Solved scenes as files: .vtp and .vtpc with every array, .ply with vertex colours. C++ only.
#ifndef SolutionFile_h
#define SolutionFile_h

#include "Display/Core/ToneMapping.h"
#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"
#include "lambertEngineModule.h"

#include <string>

namespace lambert {
/// True for the names that WriteSolution can write: ending in .vtp, .vtpc or .ply, in any case.
LAMBERTENGINE_EXPORT bool IsSolutionFileName(const std::string& fileName);

/// Writes by the ending. `.vtp`: the refined mesh with all its arrays and the tables of `scene`.
/// `.vtpc`: the same part by part. `.ply`: binary, per vertex x y z, nx ny nz, red green blue (tone
/// mapped, sRGB), irradiance_r irradiance_g irradiance_b (W/m2). Viewers of PLY do not cull, so of
/// a face with two lit sides the brighter stays, unless `bothSides`. Throws Error where the file
/// cannot be written.
LAMBERTENGINE_EXPORT void WriteSolution(const RadiositySolution& solution, const Scene& scene,
                                        const std::string& fileName,
                                        const ToneMappingOptions& toneMapping = {},
                                        bool bothSides = false);

/// Triangles of `solution` to be shown without culling: of each input face its brighter side, by
/// the mean luminance of radiosity over the side.
LAMBERTENGINE_EXPORT std::vector<int64_t> BrighterSides(const RadiositySolution& solution);
}  // namespace lambert

#endif
