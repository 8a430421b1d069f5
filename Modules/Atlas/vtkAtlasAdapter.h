// The bridge between an atlas and the vtkPolyData that carries it. C++ only.
#ifndef vtkAtlasAdapter_h
#define vtkAtlasAdapter_h

#include "Atlas/Core/RadiosityAtlas.h"
#include "Atlas/Core/SurfaceRepresentation.h"
#include "Scene/Core/Scene.h"
#include "lambertAtlasModule.h"

class vtkMultiBlockDataSet;
class vtkPolyData;

namespace lambert {
/// Fills `output` with the mesh and the tables of `scene`, points split where charts meet, with
/// LightMapTCoords and SharedPointId at its points, ChartId and PageId at its cells, and the size
/// of pages and texels and the padding in its field data.
LAMBERTATLAS_EXPORT void PolyDataFromAtlas(const RadiosityAtlas& atlas, Scene scene,
                                           vtkPolyData* output);

/// The atlas that such a mesh carries, as far as a light map needs it, and the mesh as it was
/// before it was split. Throws Error where an array is missing or of the wrong shape.
LAMBERTATLAS_EXPORT RadiosityAtlas AtlasFromPolyData(vtkPolyData* input, TriangleMesh* mesh);

/// Fills `output` with a vtkImageData a page, its lowest row first: point scalars Irradiance, 3
/// float, W/m2.
LAMBERTATLAS_EXPORT void PagesFromLightMap(const LightMap& map, vtkMultiBlockDataSet* output);

/// Fills `output` with the faces of `represented`, those of the light map first, and the tables of
/// `scene`. At the points: Irradiance, and LightMapTCoords, which are (-1, -1) where the points
/// light; at the cells PageId, of a face that its points light 0.
LAMBERTATLAS_EXPORT void PolyDataFromRepresentedScene(const RepresentedScene& represented,
                                                      Scene scene, vtkPolyData* output);
}  // namespace lambert

#endif
