// VTK's own files of meshes, written whole or not at all. C++ only.
#ifndef PolyDataFile_h
#define PolyDataFile_h

#include "lambertEngineModule.h"

#include <string>

class vtkPolyData;

namespace lambert {
/// True for the names that WritePolyData can write: ending in .vtp or .vtpc, in any case.
LAMBERTENGINE_EXPORT bool IsPolyDataFileName(const std::string& fileName);

/// Writes `mesh`, a scene with its tables, by the ending. `.vtp`: as it is. `.vtpc`: a collection
/// of its parts under their names (ScenePieces), with a .vtp each in the folder of that name
/// beside it. Throws Error where not all of it arrives; what stood there is left then.
LAMBERTENGINE_EXPORT void WritePolyData(vtkPolyData* mesh, const std::string& fileName);
}  // namespace lambert

#endif
