#include "vtkErrorMap.h"

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Reference/Core/ErrorMap.h"
#include "vtkCellData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMethodPorts.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkRadiosityArrays.h"
#include "vtkSceneAdapter.h"
#include "vtkValueArrays.h"

vtkStandardNewMacro(vtkErrorMap);

namespace {
constexpr int kScenePort = 1;

void AddMap(const lambert::ErrorMap& map, vtkCellData* cells) {
  std::vector<lambert::Spectrum> irradiance, standardError;
  for (const lambert::IrradianceEstimate& estimate : map.reference) {
    irradiance.push_back(estimate.irradiance);
    standardError.push_back(estimate.standardError);
  }
  using Names = vtkRadiosityArrays;
  cells->AddArray(lambert::ArrayFromTuples(Names::ReferenceIrradiance(), irradiance));
  cells->AddArray(lambert::ArrayFromTuples(Names::StandardError(), standardError));
  cells->SetScalars(lambert::ArrayFromTuples(Names::RelativeError(), map.relativeError));
}
}  // namespace

vtkErrorMap::vtkErrorMap() : Options(new lambert::ErrorMapOptions) {
  this->SetNumberOfInputPorts(2);
}

vtkErrorMap::~vtkErrorMap() = default;

#define lambertOptionMacro(name, type, member) \
  void vtkErrorMap::Set##name(type value) {    \
    if (this->Options->member != value) {      \
      this->Options->member = value;           \
      this->Modified();                        \
    }                                          \
  }                                            \
  type vtkErrorMap::Get##name() { return this->Options->member; }
lambertOptionMacro(Samples, int, samples);
lambertOptionMacro(Seed, vtkTypeUInt64, seed);
#undef lambertOptionMacro

int vtkErrorMap::FillInputPortInformation(int, vtkInformation* information) {
  information->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

void vtkErrorMap::SetSceneConnection(vtkAlgorithmOutput* output) {
  this->SetInputConnection(kScenePort, output);
}

void vtkErrorMap::SetSceneData(vtkDataObject* scene) { this->SetInputData(kScenePort, scene); }

int vtkErrorMap::RequestData(vtkInformation*, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) {
  const auto progress = [this](double fraction, const char* stage) {
    this->SetProgressText(stage);
    this->UpdateProgress(fraction);
    return !this->GetAbortExecute();
  };
  try {
    lambert::SetThreadCount(this->NumberOfThreads);
    vtkPolyData* solved = vtkPolyData::GetData(inputs[0]);
    const lambert::Scene scene =
        lambert::MethodSceneFromPolyData(vtkPolyData::GetData(inputs[kScenePort]), this->Sky).scene;
    const lambert::ErrorMap map =
        lambert::MapError(scene, lambert::SolutionFromPolyData(solved), *this->Options, progress);
    if (!scene.HasLight()) {
      vtkWarningMacro("The scene has no light: no face emits, no lamp is given, the sky is black.");
    }
    vtkPolyData* output = vtkPolyData::GetData(outputs);
    output->ShallowCopy(solved);
    AddMap(map, output->GetCellData());
    return 1;
  } catch (const lambert::Cancelled&) {
    return 1;  // An abort is no error; nothing is delivered.
  } catch (const std::exception& error) {
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

void vtkErrorMap::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Samples: " << this->GetSamples() << "\n"
     << indent << "Seed: " << this->GetSeed() << "\n"
     << indent << "Sky: " << this->Sky[0] << " " << this->Sky[1] << " " << this->Sky[2] << "\n"
     << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
}
