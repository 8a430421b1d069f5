#include "vtkSceneLoader.h"

#include "Common/Core/Error.h"
#include "Scene/Core/EnvironmentImage.h"
#include "Scene/Core/PieceJoining.h"
#include "Scene/Core/SceneLimits.h"
#include "vtkCellData.h"
#include "vtkPolyData.h"
#include "vtkRadiosityArrays.h"
#include "vtkSceneAdapter.h"
#include "vtkStoredPieces.h"
#include "vtkValueArrays.h"

#include <algorithm>
#include <cmath>

namespace lambert {
namespace {
/// Faces and points of a part, in the mesh that holds all.
struct PartExtent {
  std::vector<int32_t> faces, points;
};

/// What each part has; the points in the order in which its faces name them, by which `all` names
/// them then.
std::vector<PartExtent> FindParts(size_t partCount, TriangleMesh* all) {
  std::vector<PartExtent> parts(partCount);
  for (size_t face = 0; face < all->triangles.size(); ++face) {
    parts[static_cast<size_t>(all->partId[face])].faces.push_back(static_cast<int32_t>(face));
  }
  std::vector<int32_t> local(all->positions.size(), -1);
  for (PartExtent& part : parts) {
    for (const int32_t face : part.faces) {
      for (int32_t& corner : all->triangles[static_cast<size_t>(face)]) {
        int32_t& index = local[static_cast<size_t>(corner)];
        if (index < 0) {
          index = static_cast<int32_t>(part.points.size());
          part.points.push_back(corner);
        }
        corner = index;
      }
    }
    for (const int32_t point : part.points) {
      local[static_cast<size_t>(point)] = -1;
    }
  }
  return parts;
}

/// Gives each mesh its entries of an array, and frees that of all.
template <class T>
void Distribute(std::vector<T> TriangleMesh::*array, std::vector<int32_t> PartExtent::*entries,
                const std::vector<PartExtent>& parts, TriangleMesh* all, TriangleMesh* meshes) {
  const std::vector<T> values = std::move(all->*array);
  for (size_t part = 0; part < parts.size() && !values.empty(); ++part) {
    const std::vector<int32_t>& from = parts[part].*entries;
    std::vector<T>& to = meshes[part].*array;
    to.reserve(from.size());
    for (const int32_t i : from) {
      to.push_back(values[static_cast<size_t>(i)]);
    }
  }
}

/// A mesh for each part.
std::vector<TriangleMesh> SplitIntoParts(size_t partCount, TriangleMesh all) {
  const std::vector<PartExtent> parts = FindParts(partCount, &all);
  std::vector<TriangleMesh> meshes(partCount);
  const auto distribute = [&](auto array, std::vector<int32_t> PartExtent::*entries) {
    Distribute(array, entries, parts, &all, meshes.data());
  };
  distribute(&TriangleMesh::positions, &PartExtent::points);
  distribute(&TriangleMesh::normals, &PartExtent::points);
  distribute(&TriangleMesh::uvs, &PartExtent::points);
  distribute(&TriangleMesh::triangles, &PartExtent::faces);
  distribute(&TriangleMesh::reflectance, &PartExtent::faces);
  distribute(&TriangleMesh::emittance, &PartExtent::faces);
  distribute(&TriangleMesh::faceFlags, &PartExtent::faces);
  distribute(&TriangleMesh::materialId, &PartExtent::faces);
  distribute(&TriangleMesh::sourceCellId, &PartExtent::faces);
  return meshes;
}

/// What the faces of a stored scene lack is taken from the options.
void ApplyOptions(bool hasReflectance, const SceneReaderOptions& options, Scene* scene) {
  if (!hasReflectance) {
    scene->mesh.reflectance.assign(scene->mesh.triangles.size(), options.defaultReflectance);
    for (Material& material : scene->materials) {
      material.reflectance = options.defaultReflectance;
    }
  }
  for (uint8_t& flags : scene->mesh.faceFlags) {
    if (options.twoSidedEmitters && (flags & (kEmitsFront | kEmitsBack))) {
      flags |= kEmitsFront | kEmitsBack;
    }
  }
}

void Scale(double metresPerUnit, Scene* scene) {
  for (Light& light : scene->lights) {
    light.position *= static_cast<float>(metresPerUnit);
  }
  if (scene->camera) {
    scene->camera->position *= metresPerUnit;
    scene->camera->focalPoint *= metresPerUnit;
  }
  for (Part& part : scene->parts) {
    for (size_t i = 0; i < 12; ++i) {
      part.objectToWorld[i] *= metresPerUnit;
    }
  }
}

/// Adds a stored scene to the assembly, a mesh a part. Its points are in the world already: the
/// parts come with the unit alone as their matrix.
void AppendScene(Scene scene, double metresPerUnit, SceneAssembly* assembly) {
  const auto materialOffset = static_cast<int32_t>(assembly->materials.size());
  for (int32_t& material : scene.mesh.materialId) {
    material += materialOffset;
  }
  std::vector<TriangleMesh> meshes = SplitIntoParts(scene.parts.size(), std::move(scene.mesh));
  for (size_t i = 0; i < scene.parts.size(); ++i) {
    Part& part = scene.parts[i];
    part.meshId = static_cast<int32_t>(assembly->meshes.size());
    part.objectToWorld = {
        metresPerUnit, 0, 0, 0, 0, metresPerUnit, 0, 0, 0, 0, metresPerUnit, 0, 0, 0, 0, 1};
    assembly->meshes.push_back(std::move(meshes[i]));
    assembly->parts.push_back(part);
  }
  assembly->materials.insert(assembly->materials.end(), scene.materials.begin(),
                             scene.materials.end());
  assembly->lights.insert(assembly->lights.end(), scene.lights.begin(), scene.lights.end());
  if (!assembly->camera) {
    assembly->camera = scene.camera;
  }
}
/// The scene of a piece, with names where its tables have none.
Scene SceneOfPiece(const StoredPiece& piece, vtkPolyData* stored) {
  try {
    Scene scene = SceneAsStoredInPolyData(stored);
    if (!stored->GetFieldData()->GetAbstractArray(vtkRadiosityArrays::PartName())) {
      for (Part& part : scene.parts) part.name = piece.name;
    }
    return scene;
  } catch (const Error& error) {
    if (piece.collection.empty()) throw;
    throw Error("The piece '" + piece.file + "' of '" + piece.collection +
                "' cannot be read: " + error.what());
  }
}

/// Which rows of the scene's table the materials of a piece are, where it knows.
std::optional<std::vector<int32_t>> MaterialRowsOf(vtkPolyData* piece) {
  vtkDataArray* rows = piece->GetFieldData()->GetArray(vtkRadiosityArrays::MaterialRow());
  if (!rows) return {};
  return NumbersFromArray<int32_t>(rows);
}

/// The matrices that parts were stored with, by their rows in the assembly.
using StoredMatrices = std::vector<std::pair<size_t, std::array<double, 16>>>;

/// Adds the scene of a VTP, or of all pieces of a VTPC, to the assembly.
void AppendStoredScene(const std::string& file, const SceneReaderOptions& options,
                       double metresPerUnit, StoredMatrices* matrices, SceneAssembly* assembly) {
  PieceJoining joining(assembly);
  const int64_t facesBefore = assembly->report.faces;
  for (const StoredPiece& piece : FindStoredPieces(file)) {
    // What the piece holds.
    vtkSmartPointer<vtkPolyData> stored = ReadStoredPiece(piece);
    Scene scene = SceneOfPiece(piece, stored);
    joining.NumberMaterials(MaterialRowsOf(stored), &scene);
    joining.TakeRepeatedLights(&scene);
    ReadEnvironmentImages(&scene.lights);
    assembly->report.faces += stored->GetNumberOfPolys() + stored->GetNumberOfStrips();
    const bool hasReflectance =
        stored->GetCellData()->GetArray(vtkRadiosityArrays::Reflectance()) != nullptr;
    stored = nullptr;

    // Other files that it needs.
    if (!piece.collection.empty()) assembly->report.companions.push_back(piece.file);
    for (const Light& light : scene.lights) {
      if (light.image) assembly->report.companions.push_back(light.imageFile);
    }

    // In metres, behind what is there.
    ApplyOptions(hasReflectance, options, &scene);
    Scale(metresPerUnit, &scene);
    for (size_t i = 0; i < scene.parts.size(); ++i) {
      matrices->emplace_back(assembly->parts.size() + i, scene.parts[i].objectToWorld);
    }
    AppendScene(std::move(scene), metresPerUnit, assembly);
  }
  joining.JoinMaterials();
  if (assembly->report.faces == facesBefore) {
    throw Error("The file '" + file + "' has no faces.");
  }
  assembly->report.files.push_back(file);
}
}  // namespace

Scene LoadScene(const std::vector<std::string>& files, const SceneReaderOptions& readerOptions,
                const CleaningOptions& cleaningOptions,
                const std::vector<std::string>& materialSettings, ReadReport* readReport,
                CleaningReport* cleaningReport, const ProgressCallback& progress) {
  if (files.empty()) {
    throw Error("No file was given to read.");
  }
  const auto half = [&](double begin) {
    return [&progress, begin](double fraction, const char* stage) {
      return Report(progress, begin + 0.5 * fraction, stage);
    };
  };

  if (!(readerOptions.metresPerUnit >= 0 && std::isfinite(readerOptions.metresPerUnit))) {
    throw Error("The length of the unit is " + std::to_string(readerOptions.metresPerUnit) +
                " m; it must be a positive number, or 0 for the file's own.");
  }

  // Read.
  std::vector<std::string> storedScenes, otherFiles;
  for (const std::string& file : files) {
    (IsStoredScene(file) ? storedScenes : otherFiles).push_back(file);
  }
  SceneAssembly assembly;
  if (!otherFiles.empty()) {
    assembly = ReadScene(otherFiles, readerOptions, half(0));
  }
  const double metresPerUnit = readerOptions.metresPerUnit > 0 ? readerOptions.metresPerUnit : 1;
  StoredMatrices storedMatrices;
  for (const std::string& file : storedScenes) {
    AppendStoredScene(file, readerOptions, metresPerUnit, &storedMatrices, &assembly);
  }
  if (otherFiles.empty()) {
    assembly.report.unit = "m";
    assembly.report.metresPerUnit = metresPerUnit;
  }
  for (const std::string& setting : materialSettings) {
    ApplyMaterialSetting(setting, &assembly);
  }
  if (readReport) {
    *readReport = assembly.report;
  }

  // Clean and place.
  Scene scene = AssembleScene(std::move(assembly), cleaningOptions, cleaningReport, half(0.5));
  RequireSolvableMesh(scene.mesh);

  // Parts that were stored in the world get back the matrices they were stored with.
  for (const auto& [part, matrix] : storedMatrices) {
    scene.parts[part].objectToWorld = matrix;
  }
  return scene;
}
}  // namespace lambert
