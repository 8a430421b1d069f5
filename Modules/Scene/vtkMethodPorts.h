// From the input port of a method to its scene, and from its solution to its output ports: what the
// shells of all methods share. C++ only.
#ifndef vtkMethodPorts_h
#define vtkMethodPorts_h

#include "Scene/Core/RadiositySolution.h"
#include "Scene/Core/Scene.h"
#include "lambertSceneModule.h"

#include <array>
#include <cstdint>
#include <vector>

class vtkPolyData;
class vtkTable;

namespace lambert {
/// The scene that a method solves, and the way back to the input it came from.
struct MethodScene {
  Scene scene;
  std::vector<int64_t> inputFace;  ///< per face of the scene: triangle of the input
  std::vector<std::array<int32_t, 3>> inputTriangles;  ///< with the points of the input
};

/// The scene of `input` with a sky of that radiance (R, G, B; W/(m2 sr); black: none) added to its
/// lights, its faces as they stand. Throws Error as SceneFromPolyData does, and for a radiance that
/// is negative or not finite.
LAMBERTSCENE_EXPORT MethodScene MethodSceneFromPolyData(vtkPolyData* input, const double sky[3]);

/// Output port 0: the refined mesh, InputFaceId counting the triangles of the input.
LAMBERTSCENE_EXPORT void FillRefinedMesh(const RadiositySolution& solution,
                                         const MethodScene& methodScene, vtkPolyData* output);

/// Output port 1: a row an iteration.
LAMBERTSCENE_EXPORT void FillHistory(const SolverStatistics& statistics, vtkTable* output);

/// Output port 2: `output` holds the input as it came and gets light at its points. The scene may
/// have split a point where its faces fall apart into several normals: an input point gets the mean
/// of its corners, weighted by their faces' areas.
LAMBERTSCENE_EXPORT void FillInputMesh(const RadiositySolution& solution,
                                       const MethodScene& methodScene, vtkPolyData* output);
}  // namespace lambert

#endif
