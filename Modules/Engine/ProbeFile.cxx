#include "ProbeFile.h"

#include "Common/Core/Error.h"
#include "Common/Core/OutputFile.h"
#include "Scene/Core/SceneLimits.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>

namespace lambert {
namespace {
/// What spreadsheets put before UTF-8.
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// Fields between commas, without the blanks around them.
std::vector<std::string> Fields(const std::string& line) {
  std::vector<std::string> fields;
  std::stringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) {
    const size_t first = field.find_first_not_of(" \t\r"), last = field.find_last_not_of(" \t\r");
    fields.push_back(first == std::string::npos ? std::string()
                                                : field.substr(first, last - first + 1));
  }
  return fields;
}

ProbePoint ParsePoint(const std::vector<std::string>& fields, const std::string& place) {
  float values[6];
  if (fields.size() != 6) {
    throw Error(place + " has " + std::to_string(fields.size()) +
                " fields; a probe has six: x,y,z,nx,ny,nz.");
  }
  for (size_t i = 0; i < 6; ++i) {
    char* end = nullptr;
    values[i] = std::strtof(fields[i].c_str(), &end);
    if (fields[i].empty() || *end || !std::isfinite(values[i])) {
      throw Error(place + " holds '" + fields[i] + "', which is not a finite number.");
    }
  }
  const ProbePoint point{{values[0], values[1], values[2]}, {values[3], values[4], values[5]}};
  if (!IsWithinReach(point.position)) {
    throw Error(place + " has a coordinate beyond 1e15 m.");
  }
  if (point.normal == Vec3f()) {
    throw Error(place + " has a zero normal; a probe needs a direction to face.");
  }
  return point;
}
}  // namespace

std::vector<ProbePoint> ReadProbeFile(const std::string& fileName) {
  std::ifstream file(fileName);
  if (!file || std::filesystem::is_directory(fileName)) {
    throw Error("The probe file " + fileName + " cannot be read.");
  }

  // The header says what the columns are.
  std::string line;
  std::getline(file, line);
  if (line.rfind(kByteOrderMark, 0) == 0) {
    line.erase(0, kByteOrderMark.size());
  }
  const std::vector<std::string> header{"x", "y", "z", "nx", "ny", "nz"};
  if (Fields(line) != header) {
    throw Error("The probe file " + fileName + " does not begin with the header x,y,z,nx,ny,nz.");
  }

  // A point a line.
  std::vector<ProbePoint> points;
  for (int number = 2; std::getline(file, line); ++number) {
    if (line.find_first_not_of(" \t\r") != std::string::npos) {
      points.push_back(ParsePoint(
          Fields(line), "Line " + std::to_string(number) + " of the probe file " + fileName));
    }
  }
  return points;
}

void WriteProbeFile(const std::string& fileName, const std::vector<ProbePoint>& points,
                    const std::vector<ProbeReading>& readings) {
  std::ostringstream file;
  file.precision(9);  // Nine digits bring a float back as it was.
  file << "x,y,z,nx,ny,nz,r,g,b,kind\n";
  for (size_t i = 0; i < points.size(); ++i) {
    const Vec3f &p = points[i].position, &n = points[i].normal;
    const Spectrum& e = readings[i].irradiance;
    file << p.x << ',' << p.y << ',' << p.z << ',' << n.x << ',' << n.y << ',' << n.z << ',' << e.r
         << ',' << e.g << ',' << e.b << ',' << ProbeKindName(readings[i].kind) << '\n';
  }
  WriteOutput(fileName, file.str());
}
}  // namespace lambert
