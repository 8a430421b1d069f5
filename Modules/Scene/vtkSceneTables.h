// The material, part and light tables and the camera of a scene in vtkFieldData. C++ only.
#ifndef vtkSceneTables_h
#define vtkSceneTables_h

#include "Scene/Core/Scene.h"

class vtkFieldData;

namespace lambert {
/// Fills materials, parts, lights and camera of `scene` with what `fields` holds.
/// Throws Error where the columns of a table differ in length or in number of components.
void ReadSceneTables(vtkFieldData* fields, Scene* scene);
/// Adds the tables of `scene` to `fields`.
void WriteSceneTables(const Scene& scene, vtkFieldData* fields);
}  // namespace lambert

#endif
