#include "vtkRadiosityImageWriter.h"

#include "Common/Core/Error.h"
#include "Display/Core/DefaultCamera.h"
#include "Display/Core/ToneMapping.h"
#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkImageShrink3D.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRadiosityArrays.h"
#include "vtkRadiosityToneMapping.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTriangleMeshAdapter.h"
#include "vtkUnsignedCharArray.h"
#include "vtkWindowToImageFilter.h"

#include <X11/Xlib.h>

#include <algorithm>
#include <cmath>
#include <fstream>

vtkStandardNewMacro(vtkRadiosityImageWriter);

namespace {
/// Samples a pixel along each axis.
constexpr int kSupersampling = 2;
constexpr int kMaximumSize = 8192;

std::vector<lambert::Spectrum> ReadLight(vtkPolyData* data) {
  std::vector<lambert::Spectrum> light(static_cast<size_t>(data->GetNumberOfPoints()));
  vtkDataArray* array = data->GetPointData()->GetArray(vtkRadiosityArrays::Radiosity());
  if (!array || array->GetNumberOfComponents() != 3) {
    throw lambert::Error(
        "The data has no point array Radiosity of three components; run a radiosity method first.");
  }
  for (size_t point = 0; point < light.size(); ++point) {
    double tuple[3];
    array->GetTuple(static_cast<vtkIdType>(point), tuple);
    light[point] = {float(tuple[0]), float(tuple[1]), float(tuple[2])};
  }
  return light;
}

/// Metering: luminance as an 8-bit logarithm, 0 for black and for lamps, drawn small.
constexpr const char* kLogCodes = "LogLuminance";
constexpr double kStops = 24,
                 kLowestStop = -12;  ///< of the mean luminance; a code is a tenth of a stop
constexpr int kMeteringShrink = 4;

vtkSmartPointer<vtkUnsignedCharArray> PointColors(const char* name, vtkIdType points) {
  auto colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colors->SetName(name);
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(points);
  return colors;
}

/// Adds the codes and returns the mean luminance that they are relative to.
double AddLogCodes(vtkPolyData* data) {
  const std::vector<lambert::LuminanceSample> samples =
      lambert::LuminanceSamples(lambert::TriangleMeshFromPolyData(data), ReadLight(data));
  double sum = 0, weight = 0;
  for (const lambert::LuminanceSample& s : samples) {
    sum += double(s.weight) * s.luminance;
    weight += s.weight;
  }
  const auto codes = PointColors(kLogCodes, data->GetNumberOfPoints());
  for (size_t point = 0; point < samples.size(); ++point) {
    const lambert::LuminanceSample& s = samples[point];
    const bool counts = s.weight > 0 && s.luminance > 0;
    const double stop = counts ? std::log2(s.luminance * weight / sum) : kLowestStop;
    const double code = counts ? 1 + 254 * (stop - kLowestStop) / kStops : 0;
    const auto byte = static_cast<unsigned char>(std::clamp(code, 0., 255.));
    const unsigned char tuple[3] = {byte, byte, byte};
    codes->SetTypedTuple(static_cast<vtkIdType>(point), tuple);
  }
  data->GetPointData()->AddArray(codes);
  return weight > 0 ? sum / weight : 0;
}

/// A sample a pixel that shows a lit surface.
std::vector<lambert::LuminanceSample> SamplesFromLogCodes(vtkImageData* image, double mean) {
  std::vector<lambert::LuminanceSample> samples;
  const auto* codes = static_cast<const unsigned char*>(image->GetScalarPointer());
  for (vtkIdType pixel = 0; pixel < image->GetNumberOfPoints(); ++pixel) {
    const unsigned char code = codes[pixel * image->GetNumberOfScalarComponents()];
    if (code > 0) {
      const double stop = kLowestStop + kStops * (code - 1) / 254;
      samples.push_back({static_cast<float>(mean * std::exp2(stop)), 1});
    }
  }
  return samples;
}

void AddColors(vtkPolyData* data, const lambert::ToneMapping& toneMapping) {
  const char* name = vtkRadiosityToneMapping::ColorsArrayName();
  const auto colors = PointColors(name, data->GetNumberOfPoints());
  const std::vector<lambert::Spectrum> light = ReadLight(data);
  for (size_t point = 0; point < light.size(); ++point) {
    colors->SetTypedTuple(static_cast<vtkIdType>(point),
                          toneMapping.ApplyToBytes(light[point]).data());
  }
  data->GetPointData()->AddArray(colors);
}
}  // namespace

vtkRadiosityImageWriter::vtkRadiosityImageWriter() : ToneMapping(vtkRadiosityToneMapping::New()) {}

vtkRadiosityImageWriter::~vtkRadiosityImageWriter() {
  this->SetFileName(nullptr);
  this->ToneMapping->Delete();
}

void vtkRadiosityImageWriter::SetExposure(double exposure) {
  this->ToneMapping->SetExposure(exposure);
  this->Modified();
}

double vtkRadiosityImageWriter::GetExposure() { return this->ToneMapping->GetExposure(); }

bool vtkRadiosityImageWriter::IsDisplayAvailable() {
  // The connection stays open: an X server resets, and refuses for a moment, when its last client
  // leaves.
  static Display* display = nullptr;
  display = display ? display : XOpenDisplay(nullptr);
  return display != nullptr;
}

void vtkRadiosityImageWriter::SetCamera(double x, double y, double z, double focalX, double focalY,
                                        double focalZ) {
  const double position[3] = {x, y, z}, focalPoint[3] = {focalX, focalY, focalZ};
  std::copy_n(position, 3, this->Position);
  std::copy_n(focalPoint, 3, this->FocalPoint);
  this->AutomaticCamera = false;
  this->Modified();
}

void vtkRadiosityImageWriter::SetViewUp(double x, double y, double z) {
  const double viewUp[3] = {x, y, z};
  std::copy_n(viewUp, 3, this->ViewUp);
  this->AutomaticCamera = false;
  this->Modified();
}

int vtkRadiosityImageWriter::FillInputPortInformation(int, vtkInformation* information) {
  information->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

void vtkRadiosityImageWriter::WriteData() {
  try {
    // Refuse before VTK would abort.
    if (!this->FileName || !*this->FileName) {
      this->SetErrorCode(vtkErrorCode::NoFileNameError);
      throw lambert::Error("The picture has no file name.");
    }
    for (int size : this->Size) {
      if (size < 1 || size > kMaximumSize) {
        throw lambert::Error("A picture is 1 to 8192 pixels wide and high.");
      }
    }
    if (!IsDisplayAvailable()) {
      throw lambert::Error(
          "Drawing a picture needs an X display and none answers: run under xvfb-run.");
    }

    // Expose for what the picture shows, unless the points are coloured already.
    vtkNew<vtkPolyData> colored;
    colored->ShallowCopy(vtkPolyData::SafeDownCast(this->GetInput()));
    if (!colored->GetPointData()->GetArray(vtkRadiosityToneMapping::ColorsArrayName())) {
      const double mean = AddLogCodes(colored);
      const auto metered =
          this->Draw(colored, kLogCodes, std::max(1, this->Size[0] / kMeteringShrink),
                     std::max(1, this->Size[1] / kMeteringShrink));
      AddColors(colored, lambert::ToneMapping(SamplesFromLogCodes(metered, mean),
                                              this->ToneMapping->GetOptions()));
    }

    // Draw.
    this->WriteImage(this->Draw(colored, vtkRadiosityToneMapping::ColorsArrayName(),
                                kSupersampling * this->Size[0], kSupersampling * this->Size[1]));
  } catch (const std::exception& error) {
    if (this->GetErrorCode() == vtkErrorCode::NoError) {
      this->SetErrorCode(vtkErrorCode::UnknownError);
    }
    vtkErrorMacro(<< error.what());
  }
}

void vtkRadiosityImageWriter::PlaceCamera(vtkRenderer* renderer, vtkPolyData* colored) {
  vtkCamera* camera = renderer->GetActiveCamera();
  if (this->AutomaticCamera) {
    const lambert::Camera chosen =
        lambert::DefaultCamera(lambert::TriangleMeshFromPolyData(colored), ReadLight(colored),
                               static_cast<double>(this->Size[0]) / this->Size[1]);
    camera->SetPosition(chosen.position.x, chosen.position.y, chosen.position.z);
    camera->SetFocalPoint(chosen.focalPoint.x, chosen.focalPoint.y, chosen.focalPoint.z);
    camera->SetViewUp(chosen.viewUp.x, chosen.viewUp.y, chosen.viewUp.z);
    camera->SetViewAngle(chosen.verticalFieldOfView);
  } else {
    camera->SetPosition(this->Position);
    camera->SetFocalPoint(this->FocalPoint);
    camera->SetViewUp(this->ViewUp);
    camera->SetViewAngle(this->ViewAngle);
  }
  renderer->ResetCameraClippingRange();
}

vtkSmartPointer<vtkImageData> vtkRadiosityImageWriter::Draw(vtkPolyData* data, const char* colors,
                                                            int width, int height) {
  // The light as it is: vertex colours, no shading, front faces only.
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray(colors);
  mapper->SetColorModeToDirectScalars();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->BackfaceCullingOn();

  // Off-screen, on black: where there is nothing, there is no light.
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(width, height);
  window->AddRenderer(renderer);
  this->PlaceCamera(renderer, data);
  window->Render();
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(window);
  grab->ReadFrontBufferOff();
  grab->Update();
  return grab->GetOutput();
}

void vtkRadiosityImageWriter::WriteImage(vtkImageData* image) {
  vtkNew<vtkImageShrink3D> average;
  average->SetInputData(image);
  average->SetShrinkFactors(kSupersampling, kSupersampling, 1);
  average->AveragingOn();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(average->GetOutputPort());
  // Into memory first: libpng prints what a file refuses.
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* png = writer->GetResult();
  std::ofstream file(this->FileName, std::ios::binary);
  file.write(reinterpret_cast<const char*>(png->GetPointer(0)), png->GetNumberOfValues());
  if (!file.flush()) {
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
    throw lambert::Error(std::string("The picture ") + this->FileName + " could not be written.");
  }
}

void vtkRadiosityImageWriter::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n"
     << indent << "Size: " << this->Size[0] << " x " << this->Size[1] << "\n"
     << indent << "AutomaticCamera: " << this->AutomaticCamera << "\n"
     << indent << "ViewAngle: " << this->ViewAngle << "\n"
     << indent << "Exposure: " << this->GetExposure() << "\n";
}
