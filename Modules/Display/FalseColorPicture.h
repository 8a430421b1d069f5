// Pictures of illuminance in false colours, with the scale to read them by. C++ only.
#ifndef FalseColorPicture_h
#define FalseColorPicture_h

#include "Display/Core/IlluminanceScale.h"
#include "vtkSmartPointer.h"

class vtkCamera;
class vtkImageData;
class vtkPolyData;

namespace lambert {
/// Of the width of the picture that the scale takes.
constexpr double kScaleStrip = 0.15;

struct FalseColorOptions {
  IlluminanceUnit unit = IlluminanceUnit::Lux;
  IlluminanceScale scale;
  bool isolines = false;  ///< lines of equal illuminance at the levels above the lowest
  int samples = 1;        ///< pixels that become one, along each axis: letters are as much larger
};

/// Draws the irradiance of a solved mesh off-screen, and its scale in a strip at the right.
vtkSmartPointer<vtkImageData> DrawFalseColors(vtkPolyData* mesh, vtkCamera* camera,
                                              const FalseColorOptions& options, int width,
                                              int height);
}  // namespace lambert

#endif
