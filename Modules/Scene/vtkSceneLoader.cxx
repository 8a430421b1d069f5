#include "vtkSceneLoader.h"

#include "Common/Core/Error.h"
#include "Scene/Core/EnvironmentImage.h"
#include "Scene/Core/SceneLimits.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"
#include "vtkPolyData.h"
#include "vtkRadiosityArrays.h"
#include "vtkSceneAdapter.h"
#include "vtkXMLPolyDataReader.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <vtksys/SystemTools.hxx>

namespace lambert {
namespace {
/// Hears what VTK's reader would print.
class ErrorListener : public vtkCommand {
 public:
  static ErrorListener* New() { return new ErrorListener; }
  void Execute(vtkObject*, unsigned long, void*) override { this->Heard = true; }
  bool Heard = false;
};

/// Hears what the objects that a reader makes for itself would print.
class ErrorWindow : public vtkOutputWindow {
 public:
  static ErrorWindow* New() { VTK_STANDARD_NEW_BODY(ErrorWindow); }
  void DisplayErrorText(const char*) override { this->Heard = true; }
  void DisplayText(const char*) override {}
  bool Heard = false;
};

/// While it lives, VTK tells of its errors: it does so only while warnings are displayed.
class ErrorsTold {
 public:
  explicit ErrorsTold(vtkOutputWindow* window) {
    vtkObject::GlobalWarningDisplayOn();
    vtkOutputWindow::SetInstance(window);
  }
  ~ErrorsTold() {
    vtkOutputWindow::SetInstance(this->WindowBefore);
    vtkObject::SetGlobalWarningDisplay(this->DisplayBefore);
  }
  ErrorsTold(const ErrorsTold&) = delete;
  ErrorsTold& operator=(const ErrorsTold&) = delete;

 private:
  vtkSmartPointer<vtkOutputWindow> WindowBefore = vtkOutputWindow::GetInstance();
  int DisplayBefore = vtkObject::GetGlobalWarningDisplay();
};

/// VTK's reader crashes on arrays of a type that it does not know.
bool HasKnownTypes(const std::string& file) {
  static const std::set<std::string> known{"Int8",    "Int16",   "Int32",  "Int64",
                                           "UInt8",   "UInt16",  "UInt32", "UInt64",
                                           "Float32", "Float64", "String", "Bit"};
  // Tags, each with what stands before it; appended data are not read.
  std::ifstream stream(file, std::ios::binary);
  std::string text;
  while (std::getline(stream, text, '>') && text.find("<AppendedData") == text.npos) {
    const size_t begin = text.rfind('<');
    if (begin == text.npos) {
      continue;
    }
    const std::string tag = text.substr(begin);
    if (tag.rfind("<DataArray", 0) != 0 && tag.rfind("<Array", 0) != 0) {
      continue;
    }
    const size_t type = tag.find(" type=");
    if (type == std::string::npos || type + 8 > tag.size()) {
      return false;
    }
    const size_t first = type + 7;  // Behind the quotation mark, of either kind.
    if (known.count(tag.substr(first, tag.find(tag[first - 1], first) - first)) == 0) {
      return false;
    }
  }
  return true;
}

bool IsVtp(const std::string& file) {
  return vtksys::SystemTools::LowerCase(vtksys::SystemTools::GetFilenameLastExtension(file)) ==
         ".vtp";
}

vtkSmartPointer<vtkPolyData> ReadVtp(const std::string& file) {
  if (!vtksys::SystemTools::TestFileAccess(file, vtksys::TEST_FILE_READ | vtksys::TEST_FILE_OK)) {
    throw Error("The file '" + file + "' cannot be opened.");
  }
  vtkNew<ErrorWindow> window;
  const ErrorsTold told(window);
  vtkNew<ErrorListener> listener;
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetReaderErrorObserver(listener);
  reader->SetParserErrorObserver(listener);
  reader->AddObserver(vtkCommand::ErrorEvent, listener);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, listener);
  reader->SetFileName(file.c_str());
  const bool readable = reader->CanReadFile(file.c_str()) != 0 && HasKnownTypes(file);
  if (readable) {
    reader->Update();
  }
  if (!readable || listener->Heard || window->Heard || reader->GetErrorCode() != 0) {
    throw Error("The file '" + file + "' is not a VTP file or is damaged.");
  }
  if (reader->GetOutput()->GetNumberOfPolys() + reader->GetOutput()->GetNumberOfStrips() == 0) {
    throw Error("The file '" + file + "' has no faces.");
  }
  return reader->GetOutput();
}

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

/// What a VTP's faces lack is taken from the options.
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
  std::vector<std::string> vtpFiles, otherFiles;
  for (const std::string& file : files) {
    (IsVtp(file) ? vtpFiles : otherFiles).push_back(file);
  }
  SceneAssembly assembly;
  if (!otherFiles.empty()) {
    assembly = ReadScene(otherFiles, readerOptions, half(0));
  }
  const double metresPerUnit = readerOptions.metresPerUnit > 0 ? readerOptions.metresPerUnit : 1;
  std::vector<std::pair<size_t, std::array<double, 16>>> storedMatrices;
  for (const std::string& file : vtpFiles) {
    vtkSmartPointer<vtkPolyData> stored = ReadVtp(file);
    Scene scene = SceneAsStoredInPolyData(stored);
    ReadEnvironmentImages(&scene.lights);
    for (const Light& light : scene.lights) {
      if (light.image) assembly.report.companions.push_back(light.imageFile);
    }
    const bool hasReflectance =
        stored->GetCellData()->GetArray(vtkRadiosityArrays::Reflectance()) != nullptr;
    assembly.report.faces += stored->GetNumberOfPolys() + stored->GetNumberOfStrips();
    stored = nullptr;
    ApplyOptions(hasReflectance, readerOptions, &scene);
    Scale(metresPerUnit, &scene);
    for (size_t i = 0; i < scene.parts.size(); ++i) {
      storedMatrices.emplace_back(assembly.parts.size() + i, scene.parts[i].objectToWorld);
    }
    AppendScene(std::move(scene), metresPerUnit, &assembly);
    assembly.report.files.push_back(file);
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
