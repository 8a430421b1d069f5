#include "SolutionFile.h"

#include "Common/Core/FileEnding.h"
#include "Common/Core/OutputFile.h"
#include "PolyDataFile.h"
#include "Scene/vtkSceneAdapter.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace lambert {
namespace {

void WriteMesh(const RadiositySolution& solution, const Scene& scene, const std::string& fileName) {
  vtkNew<vtkPolyData> data;
  PolyDataFromSolution(solution, scene, data);
  WritePolyData(data, fileName);
}

/// Little-endian values one after the other, as every machine that VTK 9 runs on in Debian holds
/// them.
template <class T>
void Put(const T& value, std::string* bytes) {
  bytes->append(reinterpret_cast<const char*>(&value), sizeof(T));
}

std::string PlyHeader(size_t points, size_t triangles) {
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment irradiance in W/m2, linear\n";
  header += "element vertex " + std::to_string(points) + "\n";
  for (const char* name : {"float x", "float y", "float z", "float nx", "float ny", "float nz",
                           "uchar red", "uchar green", "uchar blue", "float irradiance_r",
                           "float irradiance_g", "float irradiance_b"}) {
    header += std::string("property ") + name + "\n";
  }
  header += "element face " + std::to_string(triangles) + "\n";
  return header + "property list uchar int vertex_indices\nend_header\n";
}

void WritePly(const RadiositySolution& solution, const std::string& fileName,
              const ToneMappingOptions& options, const std::vector<int64_t>& triangles) {
  // Number the points that the triangles use.
  const TriangleMesh& mesh = solution.mesh;
  std::vector<int32_t> number(mesh.positions.size(), -1), used;
  for (int64_t triangle : triangles) {
    for (int32_t point : mesh.triangles[static_cast<size_t>(triangle)]) {
      if (number[static_cast<size_t>(point)] < 0) {
        number[static_cast<size_t>(point)] = static_cast<int32_t>(used.size());
        used.push_back(point);
      }
    }
  }

  // Points with their light.
  const ToneMapping toneMapping(LuminanceSamples(mesh, solution.radiosity), options);
  std::string file = PlyHeader(used.size(), triangles.size());
  for (int32_t point : used) {
    const size_t i = static_cast<size_t>(point);
    Put(mesh.positions[i], &file);
    Put(mesh.normals.empty() ? Vec3f() : mesh.normals[i], &file);
    Put(toneMapping.ApplyToBytes(solution.radiosity[i]), &file);
    Put(solution.irradiance[i], &file);
  }

  // Triangles.
  for (int64_t triangle : triangles) {
    Put(static_cast<uint8_t>(3), &file);
    for (int32_t point : mesh.triangles[static_cast<size_t>(triangle)]) {
      Put(number[static_cast<size_t>(point)], &file);
    }
  }
  WriteOutput(fileName, file);
}
}  // namespace

bool IsSolutionFileName(const std::string& fileName) {
  return IsPolyDataFileName(fileName) || FileEnding(fileName) == ".ply";
}

std::vector<int64_t> BrighterSides(const RadiositySolution& solution) {
  // Light leaving either side of every input face, and the area it was summed over.
  const TriangleMesh& mesh = solution.mesh;
  int64_t faces = 0;
  for (int64_t face : solution.inputFaceId) {
    faces = std::max(faces, face + 1);
  }
  std::vector<std::array<double, 2>> light(static_cast<size_t>(faces)), area(light.size());
  for (size_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
    const size_t face = static_cast<size_t>(solution.inputFaceId[triangle]);
    const size_t side = solution.side[triangle];
    const double a = mesh.Area(static_cast<int64_t>(triangle));
    for (int32_t point : mesh.triangles[triangle]) {
      light[face][side] += a * Luminance(solution.radiosity[static_cast<size_t>(point)]);
    }
    area[face][side] += a;
  }

  // Triangles of the brighter side; the front where both are equally bright.
  std::vector<int64_t> kept;
  for (size_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
    const size_t face = static_cast<size_t>(solution.inputFaceId[triangle]);
    const bool hasBoth = area[face][0] > 0 && area[face][1] > 0;
    const bool backWins = light[face][1] * area[face][0] > light[face][0] * area[face][1];
    if (!hasBoth || solution.side[triangle] == (backWins ? kBack : kFront)) {
      kept.push_back(static_cast<int64_t>(triangle));
    }
  }
  return kept;
}

void WriteSolution(const RadiositySolution& solution, const Scene& scene,
                   const std::string& fileName, const ToneMappingOptions& toneMapping,
                   bool bothSides) {
  if (IsPolyDataFileName(fileName)) {
    WriteMesh(solution, scene, fileName);
    return;
  }
  std::vector<int64_t> triangles(solution.mesh.triangles.size());
  std::iota(triangles.begin(), triangles.end(), 0);
  WritePly(solution, fileName, toneMapping, bothSides ? triangles : BrighterSides(solution));
}
}  // namespace lambert
