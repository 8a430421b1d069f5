#include "ComparedPointsFile.h"

#include "Common/Core/OutputFile.h"

#include <cmath>
#include <sstream>

namespace lambert {
void WriteComparedPoints(const std::string& fileName, const std::vector<ComparedPoint>& points) {
  std::ostringstream file;
  file.precision(9);  // Nine digits bring a float back as it was.
  file << "x,y,z,nx,ny,nz,face,side,r,g,b,reference_r,reference_g,reference_b,standard_error,"
          "part\n";
  for (const ComparedPoint& point : points) {
    const Vec3f &p = point.receiver.position, &n = point.receiver.normal;
    const Spectrum &e = point.delivered, &truth = point.reference.irradiance;
    const double standardError = std::sqrt(SquaredNorm(point.reference.standardError) / 3);
    file << p.x << ',' << p.y << ',' << p.z << ',' << n.x << ',' << n.y << ',' << n.z << ','
         << point.face << ',' << int(point.side) << ',' << e.r << ',' << e.g << ',' << e.b << ','
         << truth.r << ',' << truth.g << ',' << truth.b << ',' << standardError << ',' << point.part
         << '\n';
  }
  WriteOutput(fileName, file.str());
}
}  // namespace lambert
