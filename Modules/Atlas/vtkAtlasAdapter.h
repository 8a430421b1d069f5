// The bridge between an atlas and the vtkPolyData that carries it. C++ only.
#ifndef vtkAtlasAdapter_h
#define vtkAtlasAdapter_h

#include "Atlas/Core/RadiosityAtlas.h"
#include "Atlas/Core/ShownSides.h"
#include "Atlas/Core/StoredAtlas.h"
#include "Atlas/Core/SurfaceRepresentation.h"
#include "Scene/Core/Scene.h"
#include "lambertAtlasModule.h"

class vtkMultiBlockDataSet;
class vtkPolyData;

namespace lambert {
/// Fills `output` with the mesh and the tables of `scene`, points split where charts meet, with
/// LightMapTCoords and SharedPointId at its points, ChartId and PageId at its cells, and the size
/// of pages and texels and the padding in its field data. Where the mesh is that of `shown`, also
/// InputFaceId and Side.
LAMBERTATLAS_EXPORT void PolyDataFromAtlas(const RadiosityAtlas& atlas, Scene scene,
                                           vtkPolyData* output, const ShownSides* shown = nullptr);

/// The atlas that such a mesh carries, as far as a light map needs it, and the mesh as it was
/// before it was split; `solution` onto its faces, where they have sides. Throws Error where an
/// array is missing or of the wrong shape.
LAMBERTATLAS_EXPORT RadiosityAtlas AtlasFromPolyData(vtkPolyData* input, TriangleMesh* mesh,
                                                     RadiositySolution* solution);

/// The same to be kept: the atlas whole, but for the places of charts in the plane, with what its
/// faces are of. Throws as above.
LAMBERTATLAS_EXPORT StoredAtlas StoredAtlasFromPolyData(vtkPolyData* input);

/// Fills `output` with a vtkImageData a page, its lowest row first: point scalars Irradiance, 3
/// float, W/m2.
LAMBERTATLAS_EXPORT void PagesFromLightMap(const LightMap& map, vtkMultiBlockDataSet* output);

/// Fills `output` with the faces of `represented`, those of the light map first, and the tables of
/// `scene`, whose mesh is the solved one. At the points: Irradiance, SharedPointId, and
/// LightMapTCoords, which are (-1, -1) where the points light; at the cells InputFaceId, SurfaceId,
/// of a face that its points light ChartId -1 and PageId 0, and Side, where it has sheets; the
/// field data of an atlas.
LAMBERTATLAS_EXPORT void PolyDataFromRepresentedScene(const RepresentedScene& represented,
                                                      Scene scene, vtkPolyData* output);
}  // namespace lambert

#endif
