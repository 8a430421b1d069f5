// What a scene holds, in figures. C++ only.
#ifndef SceneSummary_h
#define SceneSummary_h

#include "Scene/Core/Scene.h"
#include "lambertEngineModule.h"

namespace lambert {
struct SceneSummary {
  int64_t triangles = 0, points = 0, parts = 0, materials = 0, meshes = 0;
  int64_t emittingFaces = 0;
  int64_t pointLights = 0, spotLights = 0, directionalLights = 0, skies = 0;
  Box3f bounds;              ///< m
  double area = 0;           ///< m2, of one side of every face
  Spectrum emittedByFaces;   ///< W, of all emitting sides
  Spectrum emittedByLights;  ///< W, of point and spot lights
};

LAMBERTENGINE_EXPORT SceneSummary SummarizeScene(const Scene& scene);
}  // namespace lambert

#endif
