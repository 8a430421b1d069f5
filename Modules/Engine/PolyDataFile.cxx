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
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToLZ4();  // zlib takes longer than many a solution.
  WriteOutput(fileName, [&](const std::string& place) {
    writer->SetFileName(place.c_str());
    // A full disk is no error to VTK's writer: see whether the end arrived.
    return writer->Write() && writer->GetErrorCode() == 0 && EndsWith(place, "</VTKFile>\n");
  });
}
}  // namespace lambert
