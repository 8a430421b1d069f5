#include "vtkRadiosityToneMapping.h"

#include "Common/Core/Error.h"
#include "Display/Core/ToneMapping.h"
#include "vtkCoreShell.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRadiosityArrays.h"
#include "vtkTriangleMeshAdapter.h"
#include "vtkUnsignedCharArray.h"
#include "vtkValueArrays.h"

#include <algorithm>
#include <cmath>
#include <optional>

vtkStandardNewMacro(vtkRadiosityToneMapping);

vtkRadiosityToneMapping::vtkRadiosityToneMapping() : Options(new lambert::ToneMappingOptions) {}

vtkRadiosityToneMapping::~vtkRadiosityToneMapping() = default;

lambertOptionMacro(vtkRadiosityToneMapping, Key, double, key);
lambertOptionMacro(vtkRadiosityToneMapping, Exposure, double, exposure);
lambertOptionMacro(vtkRadiosityToneMapping, White, double, white);
lambertChoiceMacro(vtkRadiosityToneMapping, Curve, lambert::ToneCurve, curve, FILMIC,
                   "The tone curve is PHOTOGRAPHIC, LINEAR or FILMIC");

void vtkRadiosityToneMapping::SetExposureValue(double exposureValue) {
  std::optional<double> wanted;
  if (!std::isnan(exposureValue)) {
    wanted = exposureValue;
  }
  if (this->Options->exposureValue != wanted) {
    this->Options->exposureValue = wanted;
    this->Modified();
  }
}

double vtkRadiosityToneMapping::GetExposureValue() {
  return this->Options->exposureValue.value_or(std::nan(""));
}

void vtkRadiosityToneMapping::SetOptions(const lambert::ToneMappingOptions& options) {
  *this->Options = options;
  this->Modified();
}

void vtkRadiosityToneMapping::SetSteadyStops(double stops) {
  this->SteadyStops = std::isfinite(stops) ? std::max(0., stops) : 0;
  this->Steady.reset(this->SteadyStops > 0 ? new lambert::SteadyAdaptation(this->SteadyStops)
                                           : nullptr);
  this->Modified();
}

lambert::ToneMapping vtkRadiosityToneMapping::Adapt(
    const std::vector<lambert::LuminanceSample>& samples) {
  const lambert::Adaptation measured = lambert::MeasureAdaptation(samples);
  return lambert::ToneMapping(this->Steady ? this->Steady->Follow(measured) : measured,
                              *this->Options);
}

namespace {
std::vector<lambert::Spectrum> PointLight(vtkPolyData* input) {
  using Names = vtkRadiosityArrays;
  vtkPointData* pointData = input->GetPointData();
  vtkDataArray* array = pointData->GetArray(Names::Radiosity());
  array = array ? array : pointData->GetArray(Names::Irradiance());
  if (!array || array->GetNumberOfComponents() != 3) {
    throw lambert::Error(
        "The input has no point array Radiosity or Irradiance of three components; "
        "run a radiosity method first.");
  }
  return lambert::TuplesFromArray<lambert::Spectrum>(array, array->GetName());
}
}  // namespace

int vtkRadiosityToneMapping::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                         vtkInformationVector* outputs) {
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  output->ShallowCopy(input);
  if (input->GetNumberOfPoints() == 0) {
    return 1;
  }
  return lambert::RunCore(this, [&](const lambert::ProgressCallback&) {
    // Adapt to the light that the scene reflects.
    const std::vector<lambert::Spectrum> light = PointLight(input);
    const lambert::TriangleMesh mesh = lambert::TriangleMeshFromPolyData(input);
    const lambert::ToneMapping toneMapping = this->Adapt(lambert::LuminanceSamples(mesh, light));

    // Colour every point.
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetName(ColorsArrayName());
    colors->SetNumberOfComponents(3);
    colors->SetNumberOfTuples(input->GetNumberOfPoints());
    for (size_t point = 0; point < light.size(); ++point) {
      colors->SetTypedTuple(static_cast<vtkIdType>(point),
                            toneMapping.ApplyToBytes(light[point]).data());
    }
    output->GetPointData()->SetScalars(colors);
  });
}

void vtkRadiosityToneMapping::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Key: " << this->Options->key << "\n"
     << indent << "Exposure: " << this->Options->exposure << "\n"
     << indent << "White: " << this->Options->white << "\n"
     << indent << "Curve: " << this->GetCurve() << "\n"
     << indent << "ExposureValue: " << this->GetExposureValue() << "\n"
     << indent << "SteadyStops: " << this->SteadyStops << "\n";
}
