#include "vtkRadiosityImageWriter.h"

#include "Common/Core/Error.h"
#include "Display/Core/DefaultCamera.h"
#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkErrorCode.h"
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
#include "vtkWindowToImageFilter.h"

#include <X11/Xlib.h>

#include <fstream>

vtkStandardNewMacro(vtkRadiosityImageWriter);

namespace {
/// Samples a pixel along each axis.
constexpr int kSupersampling = 2;
constexpr int kMaximumSize = 8192;

std::vector<lambert::Spectrum> ReadLight(vtkPolyData* data) {
  std::vector<lambert::Spectrum> light(static_cast<size_t>(data->GetNumberOfPoints()));
  vtkDataArray* array = data->GetPointData()->GetArray(vtkRadiosityArrays::Radiosity());
  for (size_t point = 0; array && point < light.size(); ++point) {
    double tuple[9] = {0, 0, 0};
    array->GetTuple(static_cast<vtkIdType>(point), tuple);
    light[point] = {float(tuple[0]), float(tuple[1]), float(tuple[2])};
  }
  return light;
}
}  // namespace

vtkRadiosityImageWriter::vtkRadiosityImageWriter() = default;

vtkRadiosityImageWriter::~vtkRadiosityImageWriter() { this->SetFileName(nullptr); }

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

    // Colour the points where they are not coloured yet, then draw.
    vtkPolyData* input = vtkPolyData::SafeDownCast(this->GetInput());
    vtkNew<vtkRadiosityToneMapping> toneMapping;
    toneMapping->SetInputData(input);
    toneMapping->SetExposure(this->Exposure);
    if (input->GetPointData()->GetArray(vtkRadiosityToneMapping::ColorsArrayName())) {
      this->Draw(input);
      return;
    }
    toneMapping->Update();
    this->Draw(toneMapping->GetOutput());
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

void vtkRadiosityImageWriter::Draw(vtkPolyData* colored) {
  // The light as it is: vertex colours, no shading, front faces only.
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(colored);
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray(vtkRadiosityToneMapping::ColorsArrayName());
  mapper->SetColorModeToDirectScalars();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->BackfaceCullingOn();

  // Off-screen, several samples a pixel.
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.08, 0.08, 0.09);
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(kSupersampling * this->Size[0], kSupersampling * this->Size[1]);
  window->AddRenderer(renderer);
  this->PlaceCamera(renderer, colored);
  window->Render();
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(window);
  grab->ReadFrontBufferOff();
  vtkNew<vtkImageShrink3D> average;
  average->SetInputConnection(grab->GetOutputPort());
  average->SetShrinkFactors(kSupersampling, kSupersampling, 1);
  average->AveragingOn();

  // Write.
  if (!std::ofstream(this->FileName, std::ios::app)) {
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
    throw lambert::Error(std::string("The picture ") + this->FileName + " cannot be written.");
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(average->GetOutputPort());
  writer->SetFileName(this->FileName);
  writer->Write();
  if (writer->GetErrorCode() != vtkErrorCode::NoError) {
    this->SetErrorCode(writer->GetErrorCode());
    throw lambert::Error(std::string("The picture ") + this->FileName + " could not be written.");
  }
}

void vtkRadiosityImageWriter::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n"
     << indent << "Size: " << this->Size[0] << " x " << this->Size[1] << "\n"
     << indent << "AutomaticCamera: " << this->AutomaticCamera << "\n"
     << indent << "ViewAngle: " << this->ViewAngle << "\n"
     << indent << "Exposure: " << this->Exposure << "\n";
}
