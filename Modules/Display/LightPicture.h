// Pictures of a solved scene in light as it is, and their development. C++ only.
#ifndef LightPicture_h
#define LightPicture_h

#include "Display/Core/LightImage.h"
#include "Display/Core/ToneMapping.h"
#include "vtkSmartPointer.h"

#include <vector>

class vtkCamera;
class vtkImageData;
class vtkPolyData;

namespace lambert {
/// Draws the radiosity of a solved mesh, W/m2, off-screen into a frame buffer of floats; 0 where
/// there is nothing.
LightImage DrawLight(vtkPolyData* mesh, vtkCamera* camera, int width, int height);

/// What an eye that sees the picture adapts to: draws it small, without lamps.
std::vector<LuminanceSample> MeterLight(vtkPolyData* mesh, vtkCamera* camera, int width,
                                        int height);

/// Codes of `light`, three bytes a pixel. With `local`, the photographic operator that exposes
/// every place for its surround, measured over blocks of `samples` x `samples` pixels.
vtkSmartPointer<vtkImageData> Develop(const LightImage& light, const ToneMapping& toneMapping,
                                      double key, bool local, int samples);
}  // namespace lambert

#endif
