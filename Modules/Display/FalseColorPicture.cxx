#include "FalseColorPicture.h"

#include "OffScreenWindow.h"
#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkColorTransferFunction.h"
#include "vtkContourFilter.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLookupTable.h"
#include "vtkMapper.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRadiosityArrays.h"
#include "vtkRenderer.h"
#include "vtkScalarBarActor.h"
#include "vtkTextProperty.h"
#include "vtkTriangleMeshAdapter.h"

namespace lambert {
namespace {
/// Pixels of a letter's height and of a line's width.
constexpr int kLetter = 13;
constexpr float kLine = 1;

/// From dark violet to yellow, as bright as the value is large (viridis of matplotlib, CC0).
vtkSmartPointer<vtkLookupTable> Colors(const IlluminanceScale& scale) {
  constexpr int kColors[] = {0x440154, 0x46327e, 0x365c8d, 0x277f8e,
                             0x1fa187, 0x4ac16d, 0xa0da39, 0xfde725};
  constexpr int kLast = sizeof(kColors) / sizeof(*kColors) - 1;
  vtkNew<vtkColorTransferFunction> ramp;
  for (int i = 0; i <= kLast; ++i) {
    ramp->AddRGBPoint(double(i) / kLast, (kColors[i] >> 16) / 255., (kColors[i] >> 8 & 255) / 255.,
                      (kColors[i] & 255) / 255.);
  }
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(256);
  table->SetTableRange(scale.low, scale.high);
  for (int i = 0; i < 256; ++i) {
    double color[3];
    ramp->GetColor(i / 255., color);
    table->SetTableValue(i, color[0], color[1], color[2]);
  }
  return table;
}

/// The faces that show their front to the eye, with illuminance as scalars at the points: lines of
/// a back side must not shine through.
vtkSmartPointer<vtkPolyData> FacesBeforeTheEye(vtkPolyData* mesh, const Vec3f& eye,
                                               IlluminanceUnit unit) {
  // Illuminance.
  vtkDataArray* irradiance = mesh->GetPointData()->GetArray(vtkRadiosityArrays::Irradiance());
  vtkNew<vtkFloatArray> illuminance;
  illuminance->SetName("Illuminance");
  illuminance->SetNumberOfTuples(mesh->GetNumberOfPoints());
  for (vtkIdType point = 0; point < mesh->GetNumberOfPoints(); ++point) {
    double bands[3];
    irradiance->GetTuple(point, bands);
    illuminance->SetValue(point,
                          Illuminance({float(bands[0]), float(bands[1]), float(bands[2])}, unit));
  }

  // Faces.
  const TriangleMesh triangles = TriangleMeshFromPolyData(mesh);
  vtkNew<vtkCellArray> faces;
  for (int64_t face = 0; face < triangles.FaceCount(); ++face) {
    if (Dot(triangles.VectorArea(face), eye - triangles.Corner(face, 0)) <= 0) {
      continue;
    }
    const auto& t = triangles.triangles[static_cast<size_t>(face)];
    faces->InsertNextCell({t[0], t[1], t[2]});
  }
  auto shown = vtkSmartPointer<vtkPolyData>::New();
  shown->SetPoints(mesh->GetPoints());
  shown->SetPolys(faces);
  shown->GetPointData()->SetScalars(illuminance);
  return shown;
}

/// Light as it is: no shading, colours by the value between the points.
vtkSmartPointer<vtkActor> Surfaces(vtkPolyData* shown, vtkLookupTable* colors) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(shown);
  mapper->SetLookupTable(colors);
  mapper->UseLookupTableScalarRangeOn();
  mapper->InterpolateScalarsBeforeMappingOn();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  return actor;
}

vtkSmartPointer<vtkActor> Isolines(vtkPolyData* shown, const FalseColorOptions& options) {
  vtkNew<vtkContourFilter> contour;
  contour->SetInputData(shown);
  const std::vector<double>& levels = options.scale.levels;
  for (size_t level = 1; level < levels.size(); ++level) {
    contour->SetValue(static_cast<int>(level) - 1, levels[level]);
  }
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(contour->GetOutputPort());
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(1, 1, 1);
  actor->GetProperty()->SetLineWidth(kLine * static_cast<float>(options.samples));
  return actor;
}

vtkSmartPointer<vtkScalarBarActor> Scale(const FalseColorOptions& options, vtkLookupTable* colors) {
  auto bar = vtkSmartPointer<vtkScalarBarActor>::New();
  bar->SetLookupTable(colors);
  bar->SetTitle(options.unit == IlluminanceUnit::Lux ? "lux" : "W/m2");
  bar->SetNumberOfLabels(static_cast<int>(options.scale.levels.size()));
  bar->SetLabelFormat("%g");
  bar->SetMaximumNumberOfColors(256);
  bar->UnconstrainedFontSizeOn();
  for (vtkTextProperty* letters : {bar->GetTitleTextProperty(), bar->GetLabelTextProperty()}) {
    letters->SetFontSize(kLetter * options.samples);
    letters->ItalicOff();
    letters->BoldOff();
    letters->ShadowOff();
  }
  bar->SetPosition(0.1, 0.1);
  bar->SetWidth(0.8);
  bar->SetHeight(0.8);
  bar->SetBarRatio(0.3);
  return bar;
}

/// While it lives, surfaces stand back behind the lines on them. VTK has one switch for all.
class SurfacesBehindLines {
 public:
  SurfacesBehindLines() { vtkMapper::SetResolveCoincidentTopologyToPolygonOffset(); }
  ~SurfacesBehindLines() { vtkMapper::SetResolveCoincidentTopology(this->Before); }
  SurfacesBehindLines(const SurfacesBehindLines&) = delete;
  void operator=(const SurfacesBehindLines&) = delete;

 private:
  int Before = vtkMapper::GetResolveCoincidentTopology();
};
}  // namespace

vtkSmartPointer<vtkImageData> DrawFalseColors(vtkPolyData* mesh, vtkCamera* camera,
                                              const FalseColorOptions& options, int width,
                                              int height) {
  // The light.
  double eye[3];
  camera->GetPosition(eye);
  const auto colors = Colors(options.scale);
  const auto shown =
      FacesBeforeTheEye(mesh, {float(eye[0]), float(eye[1]), float(eye[2])}, options.unit);
  vtkNew<vtkRenderer> light;
  light->SetViewport(0, 0, 1 - kScaleStrip, 1);
  light->AddActor(Surfaces(shown, colors));
  if (options.isolines) {
    light->AddActor(Isolines(shown, options));
  }
  light->SetActiveCamera(camera);
  light->ResetCameraClippingRange();

  // The scale, in a strip of its own.
  vtkNew<vtkRenderer> strip;
  strip->SetViewport(1 - kScaleStrip, 0, 1, 1);
  strip->AddActor2D(Scale(options, colors));
  const auto window = OffScreenWindow(width, height);
  window->AddRenderer(light);
  window->AddRenderer(strip);
  const SurfacesBehindLines guard;
  return RenderAndGrab(window);
}
}  // namespace lambert
