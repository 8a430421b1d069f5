#include "PolyDataFile.h"

#include "Common/Core/OutputFile.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkXMLPolyDataWriter.h"

#include <fstream>

namespace lambert {
namespace {
bool EndsWith(const std::string& fileName, const std::string& end) {
  std::ifstream file(fileName, std::ios::binary);
  std::string tail(end.size(), ' ');
  file.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  return file.read(tail.data(), static_cast<std::streamsize>(tail.size())) && tail == end;
}
}  // namespace

void WritePolyData(vtkPolyData* mesh, const std::string& fileName) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(mesh);
  writer->SetFileName(fileName.c_str());
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToLZ4();  // zlib takes longer than many a solution.
  // A full disk is no error to VTK's writer: see whether the end arrived.
  if (!writer->Write() || writer->GetErrorCode() != 0 || !EndsWith(fileName, "</VTKFile>\n")) {
    FailToWrite(fileName);
  }
}
}  // namespace lambert
