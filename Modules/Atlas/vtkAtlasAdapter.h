// The bridge between an atlas and the vtkPolyData that carries it. C++ only.
#ifndef vtkAtlasAdapter_h
#define vtkAtlasAdapter_h

#include "Atlas/Core/RadiosityAtlas.h"
#include "Atlas/Core/SurfaceRepresentation.h"
#include "Scene/Core/Scene.h"
#include "lambertAtlasModule.h"

class vtkPolyData;

namespace lambert {
/// Fills `output` with the mesh and the tables of `scene`, points split where charts meet, with
/// LightMapTCoords at its points and ChartId and PageId at its cells.
LAMBERTATLAS_EXPORT void PolyDataFromAtlas(const RadiosityAtlas& atlas, Scene scene,
                                           vtkPolyData* output);

/// Fills `output` with the faces of `represented`, those of the light map first, and the tables of
/// `scene`. At the points: Irradiance, and LightMapTCoords, which are (-1, -1) where the points
/// light; at the cells PageId, of a face that its points light 0.
LAMBERTATLAS_EXPORT void PolyDataFromRepresentedScene(const RepresentedScene& represented,
                                                      Scene scene, vtkPolyData* output);
}  // namespace lambert

#endif
