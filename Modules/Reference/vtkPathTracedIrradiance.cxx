#include "vtkPathTracedIrradiance.h"

#include "Common/Core/Error.h"
#include "Reference/Core/PathTracedBake.h"
#include "Reference/Core/PathTracedIrradiance.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMethodPorts.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRadiosityArrays.h"

vtkStandardNewMacro(vtkPathTracedIrradiance);

namespace {
constexpr int kPointsPort = 2;

lambert::Vec3f Tuple(vtkDataArray* array, vtkIdType row) {
  double tuple[3];
  array->GetTuple(row, tuple);
  return lambert::Vec3f(lambert::Vec3d(tuple[0], tuple[1], tuple[2]));
}

std::vector<lambert::ReceiverPoint> ReceiversOf(vtkPolyData* points) {
  vtkDataArray* normals = points->GetPointData()->GetNormals();
  vtkDataArray* geometric =
      points->GetPointData()->GetArray(vtkRadiosityArrays::GeometricNormals());
  const vtkIdType count = points->GetNumberOfPoints();
  if (count > 0 && !normals) {
    throw lambert::Error(
        "The points have no normals, which their irradiance is for; set the active Normals.");
  }
  if (geometric && geometric->GetNumberOfComponents() != 3) {
    throw lambert::Error("The array GeometricNormals needs 3 components.");
  }
  std::vector<lambert::ReceiverPoint> receivers;
  for (vtkIdType i = 0; i < count; ++i) {
    const lambert::Vec3f normal = Tuple(normals, i);
    receivers.push_back({Tuple(points->GetPoints()->GetData(), i), normal,
                         geometric ? Tuple(geometric, i) : normal});
  }
  return receivers;
}

template <class Value>
void AddPointSpectra(const char* name, const std::vector<lambert::IrradianceEstimate>& estimates,
                     const Value& value, vtkPolyData* output) {
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(estimates.size()));
  for (size_t i = 0; i < estimates.size(); ++i) {
    array->SetTypedTuple(static_cast<vtkIdType>(i), &value(estimates[i]).r);
  }
  output->GetPointData()->AddArray(array);
}
}  // namespace

vtkPathTracedIrradiance::vtkPathTracedIrradiance()
    : Samples(lambert::PathTracedBakeOptions().samples),
      Seed(lambert::PathTracedBakeOptions().seed) {
  this->SetNumberOfInputPorts(3);
}

int vtkPathTracedIrradiance::FillInputPortInformation(int port, vtkInformation* information) {
  if (port != kPointsPort) {
    return this->Superclass::FillInputPortInformation(port, information);
  }
  information->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  information->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

void vtkPathTracedIrradiance::SetPointsConnection(vtkAlgorithmOutput* output) {
  this->SetInputConnection(kPointsPort, output);
}

void vtkPathTracedIrradiance::SetPointsData(vtkDataObject* points) {
  this->SetInputData(kPointsPort, points);
}

int vtkPathTracedIrradiance::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                         vtkInformationVector* outputs) {
  if (vtkPolyData::GetData(inputs[kPointsPort])) {
    return this->EstimateAtPoints(inputs, outputs);
  }
  return this->RequestSolution(
      inputs, outputs,
      [this](const lambert::Scene& scene, lambert::SolverStatistics* statistics,
             const Progress& progress) {
        lambert::PathTracedBakeOptions options;
        options.samples = this->Samples;
        options.seed = this->Seed;
        return BakePathTraced(scene, options, statistics, progress);
      });
}

int vtkPathTracedIrradiance::EstimateAtPoints(vtkInformationVector** inputs,
                                              vtkInformationVector* outputs) {
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* points = vtkPolyData::GetData(inputs[kPointsPort]);
  vtkPolyData::GetData(outputs, 2)->ShallowCopy(input);
  return this->Guard([&](const Progress& progress) {
    // The light at the points.
    const lambert::Scene scene = lambert::MethodSceneFromPolyData(input, this->Sky).scene;
    this->WarnOfDarkness(scene);
    lambert::PathTracedIrradianceOptions options;
    options.samples = this->Samples;
    options.seed = this->Seed;
    const auto estimates =
        lambert::PathTracedIrradiance(scene).Estimate(ReceiversOf(points), options, progress);
    this->StoppedBy = "error";

    // Beside what they carried.
    using Estimate = lambert::IrradianceEstimate;
    vtkPolyData* output = vtkPolyData::GetData(outputs, 0);
    output->ShallowCopy(points);
    AddPointSpectra(
        vtkRadiosityArrays::Irradiance(), estimates,
        [](const Estimate& e) -> const auto& { return e.irradiance; }, output);
    AddPointSpectra(
        vtkRadiosityArrays::StandardError(), estimates,
        [](const Estimate& e) -> const auto& { return e.standardError; }, output);
  });
}

void vtkPathTracedIrradiance::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Samples: " << this->Samples << "\n" << indent << "Seed: " << this->Seed << "\n";
}
