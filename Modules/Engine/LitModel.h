// A solved scene as any viewer draws it: triangles with display colours at their points or in
// images, and a camera. The formats of viewers are written from it. C++ only.
#ifndef LitModel_h
#define LitModel_h

#include "Atlas/Core/LightMap.h"
#include "Display/Core/ToneMapping.h"
#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"
#include "lambertEngineModule.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace lambert {
/// 8-bit sRGB codes, three a texel, the row of v = 1 first.
struct LitImage {
  std::string name;
  int width = 0, height = 0;  ///< texels
  std::vector<uint8_t> codes;
};

/// Triangles to be drawn without shading, from their front alone. What shows is the texel of the
/// image, or the colour where there is no image.
struct LitMesh {
  std::string name;
  std::vector<Vec3f> positions;      ///< world space, m
  std::vector<Vec2f> textureCoords;  ///< one a point where there is an image, v upward
  std::vector<Spectrum> colors;      ///< one a point where there is none: linear, [0, 1]
  std::vector<std::array<int32_t, 3>> triangles;  ///< counter-clockwise from the front
  int image = -1;                                 ///< row of LitModel::images; -1: none
};

struct LitModel {
  std::string name;
  std::vector<LitImage> images;
  std::vector<LitMesh> meshes;  ///< one for each image, then one for what its points light
  Camera camera;
  int64_t clippedPoints = 0, clippedTexels = 0;  ///< brighter than the display in a band
};

/// The refined mesh with colours at its points, lit back sides as faces of their own. Light is tone
/// mapped as vtkRadiosityToneMapping does, adapted to the whole solution. The camera is the
/// scene's, else one that is chosen.
LAMBERTENGINE_EXPORT LitModel MakeLitModel(const Scene& scene, const RadiositySolution& solution,
                                           const ToneMappingOptions& tone = {});

/// The scene's own faces under a light map, its pages as images: radiosity, tone mapped as above.
/// The sides that the map does not hold are coloured at the points of the refined mesh. Throws
/// Error where the arguments do not belong together.
LAMBERTENGINE_EXPORT LitModel MakeLitModel(const Scene& scene, const RadiositySolution& solution,
                                           const RadiosityAtlas& atlas, const LightMap& map,
                                           const ToneMappingOptions& tone = {});
}  // namespace lambert

#endif
