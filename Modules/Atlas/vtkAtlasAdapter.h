// The bridge between an atlas and the vtkPolyData that carries it. C++ only.
#ifndef vtkAtlasAdapter_h
#define vtkAtlasAdapter_h

#include "Atlas/Core/RadiosityAtlas.h"
#include "Scene/Core/Scene.h"
#include "lambertAtlasModule.h"

class vtkPolyData;

namespace lambert {
/// Fills `output` with the mesh and the tables of `scene`, points split where charts meet, with
/// LightMapTCoords at its points and ChartId and PageId at its cells.
LAMBERTATLAS_EXPORT void PolyDataFromAtlas(const RadiosityAtlas& atlas, Scene scene,
                                           vtkPolyData* output);
}  // namespace lambert

#endif
