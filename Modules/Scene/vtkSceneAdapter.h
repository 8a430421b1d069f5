// The bridge between a vtkPolyData and a lit scene: mesh arrays, and the material, part and light tables that ride
// in the field data, so that VTK's own writers keep them. C++ only.
#ifndef vtkSceneAdapter_h
#define vtkSceneAdapter_h

#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"
#include "lambertSceneModule.h"

class vtkPolyData;

namespace lambert
{
/// The scene that `input` carries; tables that it lacks get one default row each (lights: none).
LAMBERTSCENE_EXPORT Scene SceneFromPolyData(vtkPolyData* input);
/// Fills `output` with the mesh arrays and the tables of `scene`.
LAMBERTSCENE_EXPORT void PolyDataFromScene(const Scene& scene, vtkPolyData* output);
/// Fills `output` with the refined mesh and its light.
LAMBERTSCENE_EXPORT void PolyDataFromSolution(
  const RadiositySolution& solution, vtkPolyData* output);
}

#endif
