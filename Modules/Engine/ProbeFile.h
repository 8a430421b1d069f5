// Probe points and readings as CSV. C++ only.
#ifndef ProbeFile_h
#define ProbeFile_h

#include "Visibility/Core/IrradianceProbe.h"
#include "lambertEngineModule.h"

#include <string>
#include <vector>

namespace lambert {
/// Reads a CSV with the header `x,y,z,nx,ny,nz`: positions in m, normals of any length. Empty lines
/// are skipped. Throws Error, naming file and line, for another header, a line that is not six
/// finite numbers, and a zero normal.
LAMBERTENGINE_EXPORT std::vector<ProbePoint> ReadProbeFile(const std::string& fileName);

/// Writes a CSV with the header `x,y,z,nx,ny,nz,r,g,b,kind`: irradiance in W/m2, kind surface,
/// space or inside. A row a point, in the order read. Throws Error where the file cannot be
/// written.
LAMBERTENGINE_EXPORT void WriteProbeFile(const std::string& fileName,
                                         const std::vector<ProbePoint>& points,
                                         const std::vector<ProbeReading>& readings);
}  // namespace lambert

#endif
