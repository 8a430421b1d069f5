// A solved scene as any viewer draws it: triangles with display colours at their points or in
// images, and a camera. The formats of viewers are written from it. C++ only.
#ifndef LitModel_h
#define LitModel_h

#include "Atlas/Core/LightMap.h"
#include "Atlas/Core/SurfaceRepresentation.h"
#include "Display/Core/ToneMapping.h"
#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"
#include "Scene/Core/SceneReaderTextures.h"
#include "lambertEngineModule.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace lambert {
/// 8-bit sRGB codes, three a texel, the row of v = 1 first; or an image of the scene's.
struct LitImage {
  std::string name;
  int width = 0, height = 0;  ///< texels of codes
  std::vector<uint8_t> codes;
  std::string file;  ///< the bytes of a PNG or JPEG file instead of codes
  TextureWrap wrapU = TextureWrap::Clamp, wrapV = TextureWrap::Clamp;
};

/// Triangles to be drawn without shading, from their front alone. What shows is the texel of the
/// image, the colour, or their product where there are both.
struct LitMesh {
  std::string name;
  std::vector<Vec3f> positions;                   ///< world space, m
  std::vector<Vec2f> textureCoords;               ///< one a point where there is an image, v upward
  std::vector<Spectrum> colors;                   ///< one a point, or none: linear, [0, 1]
  std::vector<std::array<int32_t, 3>> triangles;  ///< counter-clockwise from the front
  int image = -1;                                 ///< row of LitModel::images; -1: none
  float alphaCutoff = -1;  ///< texels of less alpha are holes; below 0: there are none
};

struct LitModel {
  std::string name;
  std::vector<LitImage> images;
  std::vector<LitMesh> meshes;
  Camera camera;
  int64_t clippedPoints = 0, clippedTexels = 0;  ///< brighter than the display in a band
  int64_t bakedTexels = 0;                       ///< of images that base textures are baked into
};

struct LitModelOptions {
  ToneMappingOptions tone;
  /// Under a light map: textured surfaces keep the images of the scene and are lit at their points;
  /// otherwise both are baked into one image.
  bool keepTextures = false;
  /// What is lit at its points shows its base textures; else the mean that it has on each face.
  bool texturesAtPoints = true;
  int bakedSize = 2048;  ///< texels along a side of a page with baked textures, [16, 16384]
};

/// The refined mesh with colours at its points, lit back sides as faces of their own: a mesh of
/// what has no texture, and one for each texture, whose colours are light to multiply it by. Light
/// is tone mapped as vtkRadiosityToneMapping does, adapted to the whole solution, textured surfaces
/// by their mean. The camera is the scene's, else one that is chosen.
LAMBERTENGINE_EXPORT LitModel MakeLitModel(const Scene& scene, const RadiositySolution& solution,
                                           const LitModelOptions& options = {});

/// The scene's own faces under a light map, its pages as images: radiosity, tone mapped as above. A
/// mesh a page; then the sides that the map does not hold, and what keeps its textures, as above.
/// Throws Error where the arguments do not belong together.
LAMBERTENGINE_EXPORT LitModel MakeLitModel(const Scene& scene, const RadiositySolution& solution,
                                           const RadiosityAtlas& atlas, const LightMap& map,
                                           const LitModelOptions& options = {});

/// Every surface in its representation: what the light map takes as its pages show it, all other
/// lit sides by their points, both in the one tone of the whole solution. Where textured surfaces
/// are lit at their points, textures on the pages are tone mapped by their means, too.
/// `represented` is of `scene`; `solution` may have been simplified since. Throws as above.
LAMBERTENGINE_EXPORT LitModel MakeLitModel(const Scene& scene, const RadiositySolution& solution,
                                           const RepresentedScene& represented,
                                           const LitModelOptions& options = {});
}  // namespace lambert

#endif
