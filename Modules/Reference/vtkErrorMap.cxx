#include "vtkErrorMap.h"

#include "Common/Core/Parallel.h"
#include "Reference/Core/ErrorMap.h"
#include "vtkCellData.h"
#include "vtkCoreShell.h"
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

lambertOptionMacro(vtkErrorMap, Samples, int, samples);
lambertOptionMacro(vtkErrorMap, Seed, vtkTypeUInt64, seed);

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
  return lambert::RunCore(this, [&](const lambert::ProgressCallback& progress) {
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
  });
}

void vtkErrorMap::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Samples: " << this->GetSamples() << "\n"
     << indent << "Seed: " << this->GetSeed() << "\n"
     << indent << "Sky: " << this->Sky[0] << " " << this->Sky[1] << " " << this->Sky[2] << "\n"
     << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
}
