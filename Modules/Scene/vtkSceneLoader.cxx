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
#include <iterator>
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
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  text.erase(std::min(text.size(), text.find("<AppendedData")));
  for (const std::string element : {"<DataArray", "<Array"}) {
    for (size_t at = 0; (at = text.find(element, at)) != std::string::npos; at += element.size()) {
      const std::string tag = text.substr(at, text.find('>', at) - at);
      const size_t type = tag.find(" type=");
      if (type == std::string::npos || type + 8 > tag.size()) {
        return false;
      }
      const size_t begin = type + 7;  // Behind the quotation mark, of either kind.
      if (known.count(tag.substr(begin, tag.find(tag[begin - 1], begin) - begin)) == 0) {
        return false;
      }
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

/// The faces of one part as a mesh of its own. `local` is -1 for every point, before and after.
TriangleMesh ExtractFaces(const TriangleMesh& all, const std::vector<int64_t>& faces,
                          std::vector<int32_t>* local) {
  TriangleMesh mesh;
  std::vector<size_t> points;
  for (const int64_t face : faces) {
    const size_t from = static_cast<size_t>(face);
    std::array<int32_t, 3> corners = all.triangles[from];
    for (int32_t& corner : corners) {
      int32_t& index = (*local)[static_cast<size_t>(corner)];
      if (index < 0) {
        index = static_cast<int32_t>(points.size());
        points.push_back(static_cast<size_t>(corner));
      }
      corner = index;
    }
    mesh.triangles.push_back(corners);
    mesh.reflectance.push_back(all.reflectance[from]);
    mesh.emittance.push_back(all.emittance[from]);
    mesh.faceFlags.push_back(all.faceFlags[from]);
    mesh.materialId.push_back(all.materialId[from]);
    mesh.sourceCellId.push_back(all.sourceCellId[from]);
  }
  for (const size_t point : points) {
    mesh.positions.push_back(all.positions[point]);
    if (!all.normals.empty()) {
      mesh.normals.push_back(all.normals[point]);
    }
    if (!all.uvs.empty()) {
      mesh.uvs.push_back(all.uvs[point]);
    }
    (*local)[point] = -1;
  }
  return mesh;
}

/// What a VTP's faces lack is taken from the options.
void ApplyOptions(vtkPolyData* input, const SceneReaderOptions& options, Scene* scene) {
  if (!input->GetCellData()->GetArray(vtkRadiosityArrays::Reflectance())) {
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
  std::vector<std::vector<int64_t>> facesOfPart(scene.parts.size());
  for (int64_t face = 0; face < scene.mesh.FaceCount(); ++face) {
    facesOfPart[static_cast<size_t>(scene.mesh.partId[static_cast<size_t>(face)])].push_back(face);
  }
  std::vector<int32_t> local(scene.mesh.positions.size(), -1);
  for (size_t i = 0; i < scene.parts.size(); ++i) {
    Part& part = scene.parts[i];
    part.meshId = static_cast<int32_t>(assembly->meshes.size());
    part.objectToWorld = {
        metresPerUnit, 0, 0, 0, 0, metresPerUnit, 0, 0, 0, 0, metresPerUnit, 0, 0, 0, 0, 1};
    assembly->meshes.push_back(ExtractFaces(scene.mesh, facesOfPart[i], &local));
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
    ApplyOptions(stored, readerOptions, &scene);
    Scale(metresPerUnit, &scene);
    for (size_t i = 0; i < scene.parts.size(); ++i) {
      storedMatrices.emplace_back(assembly.parts.size() + i, scene.parts[i].objectToWorld);
    }
    AppendScene(std::move(scene), metresPerUnit, &assembly);
    assembly.report.files.push_back(file);
    assembly.report.faces += stored->GetNumberOfPolys() + stored->GetNumberOfStrips();
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
