#include "vtkRadiositySceneReader.h"

#include "Scene/Core/SceneReport.h"
#include "vtkCoreShell.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSceneAdapter.h"
#include "vtkSceneLoader.h"

#include <algorithm>

struct vtkRadiositySceneReader::Settings {
  std::vector<std::string> FileNames, MaterialSettings;
  lambert::SceneReaderOptions Reader;
  lambert::CleaningOptions Cleaning;
  std::string ReportJson;
};

vtkStandardNewMacro(vtkRadiositySceneReader);

vtkRadiositySceneReader::vtkRadiositySceneReader() : Options(std::make_unique<Settings>()) {
  this->SetNumberOfInputPorts(0);
  for (int band = 0; band < 3; ++band) {
    this->DefaultReflectance[band] = this->Options->Reader.defaultReflectance[band];
  }
}

vtkRadiositySceneReader::~vtkRadiositySceneReader() = default;

//------------------------------------------------------------------------------
// Options of the algorithms, forwarded.
lambertOptionMacro(vtkRadiositySceneReader, MetresPerUnit, double, Reader.metresPerUnit);
lambertOptionMacro(vtkRadiositySceneReader, TwoSidedEmitters, bool, Reader.twoSidedEmitters);
lambertOptionMacro(vtkRadiositySceneReader, OpaqueGlass, bool, Reader.opaqueGlass);
lambertOptionMacro(vtkRadiositySceneReader, BlackMetals, bool, Reader.blackMetals);
lambertOptionMacro(vtkRadiositySceneReader, Weld, bool, Cleaning.weld);
lambertOptionMacro(vtkRadiositySceneReader, RemoveZeroArea, bool, Cleaning.removeZeroArea);
lambertOptionMacro(vtkRadiositySceneReader, RemoveRepeated, bool, Cleaning.removeRepeated);
lambertOptionMacro(vtkRadiositySceneReader, Orient, bool, Cleaning.orient);
lambertOptionMacro(vtkRadiositySceneReader, FixEmitters, bool, Cleaning.fixEmitters);
lambertOptionMacro(vtkRadiositySceneReader, FeatureAngle, double, Cleaning.featureAngle);

//------------------------------------------------------------------------------
void vtkRadiositySceneReader::SetFileName(const std::string& name) {
  if (this->Options->FileNames != std::vector<std::string>{name}) {
    this->Options->FileNames = {name};
    this->Modified();
  }
}

std::string vtkRadiositySceneReader::GetFileName() { return this->GetFileName(0); }

void vtkRadiositySceneReader::AddFileName(const std::string& name) {
  this->Options->FileNames.push_back(name);
  this->Modified();
}

void vtkRadiositySceneReader::ClearFileNames() {
  this->Options->FileNames.clear();
  this->Modified();
}

int vtkRadiositySceneReader::GetNumberOfFileNames() {
  return static_cast<int>(this->Options->FileNames.size());
}

std::string vtkRadiositySceneReader::GetFileName(int index) {
  const bool given = index >= 0 && index < this->GetNumberOfFileNames();
  return given ? this->Options->FileNames[static_cast<size_t>(index)] : std::string();
}

void vtkRadiositySceneReader::AddMaterialSetting(const std::string& setting) {
  this->Options->MaterialSettings.push_back(setting);
  this->Modified();
}

void vtkRadiositySceneReader::ClearMaterialSettings() {
  this->Options->MaterialSettings.clear();
  this->Modified();
}

int vtkRadiositySceneReader::GetNumberOfMaterialSettings() {
  return static_cast<int>(this->Options->MaterialSettings.size());
}

std::string vtkRadiositySceneReader::GetReportJson() { return this->Options->ReportJson; }

//------------------------------------------------------------------------------
int vtkRadiositySceneReader::RequestData(vtkInformation*, vtkInformationVector**,
                                         vtkInformationVector* outputVector) {
  const auto spectrum = [](const double rgb[3]) {
    return lambert::Spectrum(static_cast<float>(rgb[0]), static_cast<float>(rgb[1]),
                             static_cast<float>(rgb[2]));
  };
  Settings& options = *this->Options;
  options.Reader.defaultReflectance = spectrum(this->DefaultReflectance);
  options.ReportJson.clear();
  return lambert::RunCore(this, [&](const lambert::ProgressCallback& progress) {
    lambert::ReadReport read;
    lambert::CleaningReport cleaning;
    lambert::Scene scene = lambert::LoadScene(options.FileNames, options.Reader, options.Cleaning,
                                              options.MaterialSettings, &read, &cleaning, progress);
    if (!spectrum(this->Sky).IsBlack()) {
      lambert::Light sky;
      sky.type = lambert::LightType::Sky;
      sky.name = "sky";
      sky.intensity = spectrum(this->Sky);
      scene.lights.push_back(sky);
    }
    lambert::PolyDataFromScene(scene, vtkPolyData::GetData(outputVector));
    options.ReportJson = lambert::SceneReportJson(read, cleaning);
  });
}

void vtkRadiositySceneReader::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  for (const std::string& name : this->Options->FileNames) {
    os << indent << "FileName: " << name << "\n";
  }
  os << indent << "MetresPerUnit: " << this->GetMetresPerUnit() << "\n";
  os << indent << "FeatureAngle: " << this->GetFeatureAngle() << "\n";
}
