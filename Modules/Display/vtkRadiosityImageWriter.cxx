#include "vtkRadiosityImageWriter.h"

#include "Common/Core/Error.h"
#include "Display/Core/DefaultCamera.h"
#include "Display/Core/ToneMapping.h"
#include "FalseColorPicture.h"
#include "LightPicture.h"
#include "OffScreenWindow.h"
#include "PictureFile.h"
#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkImageShrink3D.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRadiosityArrays.h"
#include "vtkRadiosityToneMapping.h"
#include "vtkRenderer.h"
#include "vtkTriangleMeshAdapter.h"
#include "vtkValueArrays.h"

#include <X11/Xlib.h>

#include <algorithm>
#include <string>

vtkStandardNewMacro(vtkRadiosityImageWriter);

namespace {
/// Samples a pixel along each axis.
constexpr int kSupersampling = 2;
constexpr int kMaximumSize = 8192;

std::vector<lambert::Spectrum> ReadLight(vtkPolyData* data, const char* name) {
  vtkDataArray* array = data->GetPointData()->GetArray(name);
  if (!array || array->GetNumberOfComponents() != 3) {
    throw lambert::Error("The data has no point array " + std::string(name) +
                         " of three components; run a radiosity method first.");
  }
  return lambert::TuplesFromArray<lambert::Spectrum>(array, name);
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

    // Draw.
    vtkPolyData* scene = vtkPolyData::SafeDownCast(this->GetInput());
    vtkNew<vtkCamera> camera;
    this->PlaceCamera(scene, camera);
    if (this->FalseColors != NO_FALSE_COLORS) {
      this->WriteImage(this->DrawFalseColors(scene, camera));
    } else if (scene->GetPointData()->HasArray(vtkRadiosityToneMapping::ColorsArrayName())) {
      this->WriteImage(this->DrawColors(scene, camera));
    } else {
      this->WriteImage(this->DrawLight(scene, camera));
    }
  } catch (const std::exception& error) {
    if (this->GetErrorCode() == vtkErrorCode::NoError) {
      this->SetErrorCode(vtkErrorCode::UnknownError);
    }
    vtkErrorMacro(<< error.what());
  }
}

void vtkRadiosityImageWriter::PlaceCamera(vtkPolyData* scene, vtkCamera* camera) {
  if (this->AutomaticCamera) {
    const lambert::TriangleMesh mesh = lambert::TriangleMeshFromPolyData(scene);
    const lambert::UpAxis up = this->UpAxis == UP_GUESSED
                                   ? lambert::GuessUpAxis(mesh)
                                   : static_cast<lambert::UpAxis>(this->UpAxis);
    const double shown = this->FalseColors == NO_FALSE_COLORS ? 1 : 1 - lambert::kScaleStrip;
    const lambert::Camera chosen =
        lambert::DefaultCamera(mesh, ReadLight(scene, vtkRadiosityArrays::Radiosity()),
                               shown * this->Size[0] / this->Size[1], up);
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
}

vtkSmartPointer<vtkImageData> vtkRadiosityImageWriter::DrawLight(vtkPolyData* scene,
                                                                 vtkCamera* camera) {
  if (this->DodgingAndBurning &&
      this->ToneMapping->GetCurve() != vtkRadiosityToneMapping::PHOTOGRAPHIC) {
    throw lambert::Error("Dodging and burning belongs to the photographic curve.");
  }

  // Expose for what the picture shows.
  ReadLight(scene, vtkRadiosityArrays::Radiosity());
  const lambert::ToneMapping toneMapping =
      this->ToneMapping->Adapt(lambert::MeterLight(scene, camera, this->Size[0], this->Size[1]));

  // Draw the light, and develop it.
  const lambert::LightImage light = lambert::DrawLight(
      scene, camera, kSupersampling * this->Size[0], kSupersampling * this->Size[1]);
  return lambert::Develop(light, toneMapping, this->ToneMapping->GetKey(), this->DodgingAndBurning,
                          kSupersampling);
}

vtkSmartPointer<vtkImageData> vtkRadiosityImageWriter::DrawFalseColors(vtkPolyData* scene,
                                                                       vtkCamera* camera) {
  // The scale: as wanted, or as the light is.
  const auto irradiance = ReadLight(scene, vtkRadiosityArrays::Irradiance());
  const auto& [low, high] = this->FalseColorRange;
  lambert::FalseColorOptions options;
  options.unit = this->FalseColors == LUX ? lambert::IlluminanceUnit::Lux
                                          : lambert::IlluminanceUnit::WattsPerSquareMetre;
  options.scale = low == 0 && high == 0
                      ? lambert::ScaleOf(lambert::TriangleMeshFromPolyData(scene), irradiance,
                                         options.unit, this->FalseColorSteps)
                      : lambert::MakeIlluminanceScale(low, high, this->FalseColorSteps);

  // The picture.
  options.isolines = this->Isolines;
  options.samples = kSupersampling;
  return lambert::DrawFalseColors(scene, camera, options, kSupersampling * this->Size[0],
                                  kSupersampling * this->Size[1]);
}

vtkSmartPointer<vtkImageData> vtkRadiosityImageWriter::DrawColors(vtkPolyData* scene,
                                                                  vtkCamera* camera) {
  // Colours as they are: no shading, front faces only.
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(scene);
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray(vtkRadiosityToneMapping::ColorsArrayName());
  mapper->SetColorModeToDirectScalars();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->BackfaceCullingOn();

  // Off-screen, on black: where there is nothing, there is no light.
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  const auto window =
      lambert::OffScreenWindow(kSupersampling * this->Size[0], kSupersampling * this->Size[1]);
  window->AddRenderer(renderer);
  renderer->SetActiveCamera(camera);
  renderer->ResetCameraClippingRange();
  return lambert::RenderAndGrab(window);
}

void vtkRadiosityImageWriter::WriteImage(vtkImageData* image) {
  vtkNew<vtkImageShrink3D> average;
  average->SetInputData(image);
  average->SetShrinkFactors(kSupersampling, kSupersampling, 1);
  average->AveragingOn();
  average->Update();
  try {
    lambert::WritePicture(average->GetOutput(), this->FileName);
  } catch (const lambert::Error&) {
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
    throw;
  }
}

void vtkRadiosityImageWriter::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n"
     << indent << "Size: " << this->Size[0] << " x " << this->Size[1] << "\n"
     << indent << "AutomaticCamera: " << this->AutomaticCamera << "\n"
     << indent << "UpAxis: " << this->UpAxis << "\n"
     << indent << "ViewAngle: " << this->ViewAngle << "\n"
     << indent << "DodgingAndBurning: " << this->DodgingAndBurning << "\n"
     << indent << "FalseColors: " << this->FalseColors << "\n"
     << indent << "FalseColorRange: " << this->FalseColorRange[0] << " to "
     << this->FalseColorRange[1] << "\n"
     << indent << "FalseColorSteps: " << this->FalseColorSteps << "\n"
     << indent << "Isolines: " << this->Isolines << "\n"
     << indent << "Exposure: " << this->GetExposure() << "\n";
}
