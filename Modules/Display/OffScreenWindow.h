// Drawing without a window on a screen. C++ only.
#ifndef OffScreenWindow_h
#define OffScreenWindow_h

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkRenderWindow.h"
#include "vtkSmartPointer.h"
#include "vtkWindowToImageFilter.h"

namespace lambert {
/// A window of `width` x `height` pixels, one sample each, that shows nowhere.
inline vtkSmartPointer<vtkRenderWindow> OffScreenWindow(int width, int height) {
  auto window = vtkSmartPointer<vtkRenderWindow>::New();
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(width, height);
  return window;
}

/// Draws it; what it then shows.
inline vtkSmartPointer<vtkImageData> RenderAndGrab(vtkRenderWindow* window) {
  window->Render();
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(window);
  grab->ReadFrontBufferOff();
  grab->Update();
  return grab->GetOutput();
}
}  // namespace lambert

#endif
