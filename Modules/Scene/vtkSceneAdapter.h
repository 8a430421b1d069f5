// The bridge between a vtkPolyData and a lit scene: mesh arrays, and the material, part and light
// tables and the camera that ride in the field data under the names of vtkRadiosityArrays, so that
// VTK's own writers keep them. C++ only.
#ifndef vtkSceneAdapter_h
#define vtkSceneAdapter_h

#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"
#include "lambertSceneModule.h"

class vtkDataArray;
class vtkPolyData;

namespace lambert {
/// The scene that `input` carries, its geometry as it stands. Tables that it lacks get default
/// rows, as many as its faces name, at least one (lights: none). Polygons and strips are cut into
/// triangles, each with the SourceCellId of the cell that it came from; vertices and lines are left
/// out. The ids of a piece (ScenePieces) become rows of its own tables. A mesh without point
/// normals gets them, within `featureAngle` degrees: its own points keep their numbers, copies
/// where it is creased follow them. Throws Error for arrays of the wrong length or number of
/// components and for values out of range. Images of environments are left to whoever asks for
/// their light (ReadEnvironmentImages). `storedTriangles`, if given, gets the triangles with the
/// points of `input`.
LAMBERTSCENE_EXPORT Scene
SceneFromPolyData(vtkPolyData* input, double featureAngle = 30,
                  std::vector<std::array<int32_t, 3>>* storedTriangles = nullptr);

/// The same with no normals made: where `input` has none, the mesh has none.
LAMBERTSCENE_EXPORT Scene SceneAsStoredInPolyData(vtkPolyData* input);

/// Fills `output` with the mesh arrays and the tables of `scene`.
LAMBERTSCENE_EXPORT void PolyDataFromScene(const Scene& scene, vtkPolyData* output);

/// Fills `output` with the refined mesh and its light; InputFaceId, Side (and LeafId) at its cells,
/// Irradiance and Radiosity at its points, and the tables of `scene`, whose rows its cells name.
LAMBERTSCENE_EXPORT void PolyDataFromSolution(const RadiositySolution& solution, const Scene& scene,
                                              vtkPolyData* output);

/// The sides of faces (kFront, kBack) in an array of one component. Throws Error for what is no
/// side.
LAMBERTSCENE_EXPORT std::vector<uint8_t> SidesFromArray(vtkDataArray* array);

/// The solution that output port 0 of a method carries, `inputIrradiance` and `leafId` apart.
/// Throws Error where InputFaceId, Side, Irradiance or Radiosity is missing or of the wrong shape,
/// for faces below 0 and what is no side, and for cells that are no triangles.
LAMBERTSCENE_EXPORT RadiositySolution SolutionFromPolyData(vtkPolyData* input);
}  // namespace lambert

#endif
