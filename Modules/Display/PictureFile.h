// Pictures as PNG files. C++ only.
#ifndef PictureFile_h
#define PictureFile_h

#include "lambertDisplayModule.h"

#include <string>

class vtkImageData;

namespace lambert {
/// Writes `picture`, codes of 8 bits, as PNG, whole or not at all. Throws Error where it cannot.
LAMBERTDISPLAY_EXPORT void WritePicture(vtkImageData* picture, const std::string& fileName);
}  // namespace lambert

#endif
