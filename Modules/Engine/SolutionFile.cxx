#include "SolutionFile.h"

#include "Common/Core/Error.h"
#include "Scene/vtkSceneAdapter.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkXMLPolyDataWriter.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numeric>

namespace lambert {
namespace {
namespace fs = std::filesystem;

bool EndsWith(const std::string& fileName, const std::string& end) {
  std::ifstream file(fileName, std::ios::binary);
  std::string tail(end.size(), ' ');
  file.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  return file.read(tail.data(), static_cast<std::streamsize>(tail.size())) && tail == end;
}

void WriteVtp(const RadiositySolution& solution, const Scene& scene, const std::string& fileName) {
  vtkNew<vtkPolyData> data;
  PolyDataFromSolution(solution, scene, data);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetFileName(fileName.c_str());
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToLZ4();  // zlib takes longer than many a solution.
  // A full disk is no error to VTK's writer: see whether the end arrived.
  if (!writer->Write() || writer->GetErrorCode() != 0 || !EndsWith(fileName, "</VTKFile>\n")) {
    throw Error("The file " + fileName + " could not be written.");
  }
}

/// Little-endian values one after the other, as every machine that VTK 9 runs on in Debian holds
/// them.
class ByteWriter {
 public:
  template <class T>
  void Put(const T& value) {
    const char* bytes = reinterpret_cast<const char*>(&value);
    this->Bytes.insert(this->Bytes.end(), bytes, bytes + sizeof(T));
  }
  const std::vector<char>& Data() const { return this->Bytes; }

 private:
  std::vector<char> Bytes;
};

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
  ByteWriter body;
  for (int32_t point : used) {
    const size_t i = static_cast<size_t>(point);
    body.Put(mesh.positions[i]);
    body.Put(mesh.normals.empty() ? Vec3f() : mesh.normals[i]);
    body.Put(toneMapping.ApplyToBytes(solution.radiosity[i]));
    body.Put(solution.irradiance[i]);
  }

  // Triangles.
  for (int64_t triangle : triangles) {
    body.Put(static_cast<uint8_t>(3));
    for (int32_t point : mesh.triangles[static_cast<size_t>(triangle)]) {
      body.Put(number[static_cast<size_t>(point)]);
    }
  }
  std::ofstream file(fileName, std::ios::binary);
  file << PlyHeader(used.size(), triangles.size());
  file.write(body.Data().data(), static_cast<std::streamsize>(body.Data().size()));
  if (!file.flush()) {
    throw Error("The file " + fileName + " could not be written.");
  }
}
}  // namespace

std::string FileEnding(const std::string& fileName) {
  std::string ending = fs::path(fileName).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

bool IsSolutionFileName(const std::string& fileName) {
  return FileEnding(fileName) == ".vtp" || FileEnding(fileName) == ".ply";
}

void RequireWritable(const std::string& fileName) {
  const fs::path path(fileName);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    throw Error("The output " + fileName + " cannot be written: there is no folder " +
                folder.string() + ".");
  }
  if (fs::is_directory(path, ignored)) {
    throw Error("The output " + fileName + " cannot be written: it is a folder.");
  }
  // Rights alone do not say it: try, and leave no trace.
  const bool isNew = !fs::exists(path, ignored);
  errno = 0;
  const bool opens = static_cast<bool>(std::ofstream(fileName, std::ios::app));
  const int reason = errno;
  if (!opens) {
    throw Error("The output " + fileName + " cannot be written: " + std::strerror(reason) + ".");
  }
  if (isNew) {
    fs::remove(path, ignored);
  }
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
  if (FileEnding(fileName) == ".vtp") {
    WriteVtp(solution, scene, fileName);
    return;
  }
  std::vector<int64_t> triangles(solution.mesh.triangles.size());
  std::iota(triangles.begin(), triangles.end(), 0);
  WritePly(solution, fileName, toneMapping, bothSides ? triangles : BrighterSides(solution));
}
}  // namespace lambert
