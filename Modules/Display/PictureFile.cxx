#include "PictureFile.h"

#include "Common/Core/OutputFile.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkUnsignedCharArray.h"

namespace lambert {
void WritePicture(vtkImageData* picture, const std::string& fileName) {
  // Into memory first: libpng prints what a file refuses.
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(picture);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* png = writer->GetResult();
  WriteOutput(fileName, std::string(reinterpret_cast<const char*>(png->GetPointer(0)),
                                    static_cast<size_t>(png->GetNumberOfValues())));
}
}  // namespace lambert
