// What drawing a lit scene costs: prints the frame time of a model as VTK lights it, lit by the
// points of its refined mesh, and lit by its light map, on the OpenGL that is there.
//   lambert solve SCENE -o LIT.vtp --lightmap MAP.vtp
//   lambert-drawing-benchmark LIT.vtp MAP.vtp [FRAMES [WIDTH]]
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkHDRReader.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkWindowToImageFilter.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "Common/Core/Error.h"
#include "Common/Core/Timer.h"
#include "Display/vtkRadiosityActor.h"
#include "Engine/LightMapFile.h"

namespace lambert {
namespace {

vtkSmartPointer<vtkPolyData> Read(const std::string& fileName) {
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(fileName.c_str());
  reader->Update();
  if (reader->GetErrorCode() != 0) throw Error("The file " + fileName + " could not be read.");
  return reader->GetOutput();
}

/// The pages beside a light map, as many as there are.
void AddPages(const std::string& fileName, vtkRadiosityActor* actor) {
  for (int pages = 1;
       std::filesystem::exists(LightMapPageNames(fileName, pages, PageFormat::Hdr).back());
       ++pages) {
    vtkNew<vtkHDRReader> reader;
    reader->SetFileName(LightMapPageNames(fileName, pages, PageFormat::Hdr).back().c_str());
    reader->Update();
    actor->AddLightMapPage(reader->GetOutput());
  }
}

/// Median milliseconds of a frame that goes once around the actor.
double FrameTime(vtkActor* actor, int frames, int width) {
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(width, width * 3 / 4);
  window->AddRenderer(renderer);
  renderer->ResetCamera();
  window->Render();  // Shaders and buffers.
  std::vector<double> times;
  for (int frame = 0; frame < frames; ++frame) {
    renderer->GetActiveCamera()->Azimuth(360. / frames);
    renderer->ResetCameraClippingRange();
    const Timer timer;
    window->Render();
    window->WaitForCompletion();
    times.push_back(1e3 * timer.Seconds());
  }
  std::nth_element(times.begin(), times.begin() + frames / 2, times.end());
  return times[size_t(frames / 2)];
}

void Measure(const std::string& lit, const std::string& mapped, int frames, int width) {
  // The three of them.
  const auto refined = Read(lit), input = Read(mapped);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(input);
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> unlit;
  unlit->SetMapper(mapper);
  vtkNew<vtkRadiosityActor> byPoints, byMap;
  byPoints->SetInputData(refined);
  byMap->SetInputData(input);
  AddPages(mapped, byMap);

  // Their times.
  const double plain = FrameTime(unlit, frames, width);
  std::printf("as VTK lights it: %lld triangles, %.2f ms\n",
              static_cast<long long>(input->GetNumberOfCells()), plain);
  const double points = FrameTime(byPoints, frames, width);
  std::printf("lit by points:    %lld triangles, %.2f ms, %.2f times\n",
              static_cast<long long>(refined->GetNumberOfCells()), points, points / plain);
  const double map = FrameTime(byMap, frames, width);
  std::printf("lit by light map: %lld triangles, %d page(s), %.2f ms, %.2f times\n",
              static_cast<long long>(input->GetNumberOfCells()), byMap->GetNumberOfLightMapPages(),
              map, map / plain);
}

}  // namespace
}  // namespace lambert

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "lambert-drawing-benchmark LIT.vtp MAP.vtp [FRAMES [WIDTH]]\n");
    return 2;
  }
  try {
    const int frames = argc > 3 ? std::stoi(argv[3]) : 60,
              width = argc > 4 ? std::stoi(argv[4]) : 960;
    if (frames < 1 || width < 4) throw lambert::Error("A frame or more, of 4 pixels or more.");
    lambert::Measure(argv[1], argv[2], frames, width);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
