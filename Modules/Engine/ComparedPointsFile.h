// Where a solution was compared with the truth, as CSV. C++ only.
#ifndef ComparedPointsFile_h
#define ComparedPointsFile_h

#include "Reference/Core/SolutionError.h"
#include "lambertEngineModule.h"

#include <string>
#include <vector>

namespace lambert {
/// Writes a CSV with the header
/// `x,y,z,nx,ny,nz,face,side,r,g,b,reference_r,reference_g,reference_b,standard_error,part`: place
/// in m and normal, the scene's face and which side (0 front, 1 back), irradiance that is delivered
/// and of the reference in W/m2, its standard error (root mean square of
/// the bands), and what the point adds to
/// the squared bounded error, over all of it. A row a point, in the order given. Throws Error where
/// the file cannot be written.
LAMBERTENGINE_EXPORT void WriteComparedPoints(const std::string& fileName,
                                              const std::vector<ComparedPoint>& points);
}  // namespace lambert

#endif
