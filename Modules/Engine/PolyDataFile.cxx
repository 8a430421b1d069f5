#include "PolyDataFile.h"

#include "Common/Core/CollectionFile.h"
#include "Common/Core/FileEnding.h"
#include "Common/Core/OutputFile.h"
#include "Scene/vtkScenePieces.h"
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

void WriteVtp(vtkPolyData* mesh, const std::string& fileName) {
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

void WriteVtpc(vtkPolyData* mesh, const std::string& fileName) {
  ScenePieces pieces(mesh);
  WriteCollection(fileName, pieces.PartNames(), [&](size_t part, const std::string& file) {
    vtkNew<vtkPolyData> piece;
    pieces.Take(part, piece);
    WriteVtp(piece, file);
  });
}
}  // namespace

bool IsPolyDataFileName(const std::string& fileName) {
  return FileEnding(fileName) == ".vtp" || IsCollectionFileName(fileName);
}

void WritePolyData(vtkPolyData* mesh, const std::string& fileName) {
  if (IsCollectionFileName(fileName)) {
    WriteVtpc(mesh, fileName);
  } else {
    WriteVtp(mesh, fileName);
  }
}
}  // namespace lambert
