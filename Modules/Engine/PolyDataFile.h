// VTK's own files of meshes, written whole or not at all. C++ only.
#ifndef PolyDataFile_h
#define PolyDataFile_h

#include "lambertEngineModule.h"

#include <string>

class vtkPolyData;

namespace lambert {
/// Writes `mesh` as .vtp. Throws Error where not all of it arrives; what stood there is left
/// then.
LAMBERTENGINE_EXPORT void WritePolyData(vtkPolyData* mesh, const std::string& fileName);
}  // namespace lambert

#endif
