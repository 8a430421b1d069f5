#include "vtkSceneAdapter.h"

#include "vtkTriangleMeshAdapter.h"

namespace lambert
{
Scene SceneFromPolyData(vtkPolyData* input)
{
  Scene scene;
  scene.mesh = TriangleMeshFromPolyData(input);
  return scene;
}

void PolyDataFromScene(const Scene& scene, vtkPolyData* output)
{
  PolyDataFromTriangleMesh(scene.mesh, output);
}

void PolyDataFromSolution(const RadiositySolution& solution, vtkPolyData* output)
{
  PolyDataFromTriangleMesh(solution.mesh, output);
}
}
