// What the points of a solved mesh bring to its picture, whether their light stands at the points
// themselves or in a light map: one rule for both, with neutral elements (thesis 6.5.1).
#pragma once

#include <cstdint>
#include <vector>

#include "Common/Core/Spectrum.h"
#include "Common/Core/TriangleMesh.h"
#include "Display/Core/Adaptation.h"
#include "Display/Core/LightImage.h"

namespace lambert {

/// Light at the points of a mesh; what is empty is not there.
struct PointLight {
  std::vector<Spectrum> irradiance, radiosity;  ///< W/m2
  std::vector<Vec2f> lightMapCoords;  ///< on the face's page; outside of [0, 1]: lit by its points
  std::vector<int32_t> page;          ///< per face, of the light map
  int pages = 0;                      ///< of the light map; 0: there is none
};

/// Per point. A fragment shows vertexRadiosity + reflectance x light map, or under a texture of the
/// actor's vertexRadiosity + texture x (vertexIrradiance + light map). A point that a light map
/// lights has no light of its own but what it emits; one that does not lies outside of the map,
/// where the map is black.
struct PointAppearance {
  std::vector<Spectrum> vertexRadiosity;   ///< W/m2
  std::vector<Spectrum> vertexIrradiance;  ///< W/m2; black where there is no texture
  std::vector<Spectrum> reflectance;       ///< mean of the faces about the point, by area
  std::vector<Vec2f> lightMapCoords;       ///< on all pages, one above the other; (-1, -1): none
};

/// `textured` where a base texture takes the place of the reflectance. Throws Error where a point
/// has neither light of its own nor a place in the map, and for arrays of the wrong length.
PointAppearance MakePointAppearance(const TriangleMesh& mesh, const PointLight& light,
                                    bool textured);

/// What an eye that sees the whole mesh adapts to, the pages of the light map one above the other:
/// faces that do not emit, at places spread over them.
std::vector<LuminanceSample> ShownSamples(const TriangleMesh& mesh,
                                          const PointAppearance& appearance, const LightImage& map);

}  // namespace lambert
