#include "vtkSolutionError.h"

#include "Common/Core/Parallel.h"
#include "Reference/Core/SolutionError.h"
#include "vtkCoreShell.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMethodPorts.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSceneAdapter.h"
#include "vtkTable.h"

vtkStandardNewMacro(vtkSolutionError);

namespace {
constexpr int kScenePort = 1;

template <class Array, class Value>
void AddColumn(const char* name, Value value, vtkTable* table) {
  vtkNew<Array> column;
  column->SetName(name);
  column->InsertNextValue(value);
  table->AddColumn(column);
}

void FillTable(const lambert::SolutionError& error, vtkTable* table) {
  AddColumn<vtkDoubleArray>("error", error.Counting(), table);
  AddColumn<vtkDoubleArray>("rms", error.rms, table);
  AddColumn<vtkDoubleArray>("rms_low", error.rmsLow, table);
  AddColumn<vtkDoubleArray>("rms_high", error.rmsHigh, table);
  AddColumn<vtkDoubleArray>("bounded", error.bounded, table);
  AddColumn<vtkDoubleArray>("bias", error.bias, table);
  AddColumn<vtkDoubleArray>("percentile_95", error.percentile95, table);
  AddColumn<vtkDoubleArray>("noise", error.noise, table);
  AddColumn<vtkIdTypeArray>("points", error.points, table);
  AddColumn<vtkIdTypeArray>("dark_points", error.darkPoints, table);
  AddColumn<vtkIdTypeArray>("missed_points", error.missedPoints, table);
}
}  // namespace

vtkSolutionError::vtkSolutionError() : Options(new lambert::SolutionErrorOptions) {
  this->SetNumberOfInputPorts(2);
}

vtkSolutionError::~vtkSolutionError() = default;

lambertOptionMacro(vtkSolutionError, Points, int, points);
lambertOptionMacro(vtkSolutionError, Samples, int, samples);
lambertOptionMacro(vtkSolutionError, Seed, vtkTypeUInt64, seed);

int vtkSolutionError::FillInputPortInformation(int, vtkInformation* information) {
  information->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

void vtkSolutionError::SetSceneConnection(vtkAlgorithmOutput* output) {
  this->SetInputConnection(kScenePort, output);
}

void vtkSolutionError::SetSceneData(vtkDataObject* scene) { this->SetInputData(kScenePort, scene); }

int vtkSolutionError::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                  vtkInformationVector* outputs) {
  return lambert::RunCore(this, [&](const lambert::ProgressCallback& progress) {
    lambert::SetThreadCount(this->NumberOfThreads);
    const lambert::Scene scene =
        lambert::MethodSceneFromPolyData(vtkPolyData::GetData(inputs[kScenePort]), this->Sky).scene;
    const lambert::RadiositySolution solution =
        lambert::SolutionFromPolyData(vtkPolyData::GetData(inputs[0]));
    const lambert::SolutionError error =
        lambert::MeasureSolutionError(scene, solution, *this->Options, progress);
    if (!scene.HasLight()) {
      vtkWarningMacro("The scene has no light: no face emits, no lamp is given, the sky is black.");
    }
    FillTable(error, vtkTable::GetData(outputs));
  });
}

void vtkSolutionError::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Points: " << this->GetPoints() << "\n"
     << indent << "Samples: " << this->GetSamples() << "\n"
     << indent << "Seed: " << this->GetSeed() << "\n"
     << indent << "Sky: " << this->Sky[0] << " " << this->Sky[1] << " " << this->Sky[2] << "\n"
     << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
}
