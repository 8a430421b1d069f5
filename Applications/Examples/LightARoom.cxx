// Lights a room: reader >> face clusters >> hierarchical radiosity >> tone mapping >> file.
//
//     LightARoom SCENE OUT.vtp
#include <vtkDataArray.h>
#include <vtkFaceClustering.h>
#include <vtkHierarchicalRadiosity.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRadiositySceneReader.h>
#include <vtkRadiosityToneMapping.h>
#include <vtkTable.h>
#include <vtkXMLPolyDataWriter.h>

#include <cstdlib>
#include <iostream>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "Usage: LightARoom SCENE OUT.vtp\n";
    return EXIT_FAILURE;
  }

  // The pipeline.
  vtkNew<vtkRadiositySceneReader> reader;
  reader->SetFileName(argv[1]);
  vtkNew<vtkFaceClustering> clusters;
  clusters->SetInputConnection(reader->GetOutputPort());
  vtkNew<vtkHierarchicalRadiosity> radiosity;
  radiosity->SetInputConnection(0, clusters->GetOutputPort(0));
  radiosity->SetInputConnection(1, clusters->GetOutputPort(1));
  radiosity->SetError(0.2);
  vtkNew<vtkRadiosityToneMapping> colors;
  colors->SetInputConnection(radiosity->GetOutputPort());

  // What stays on disk.
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(colors->GetOutputPort());
  writer->SetFileName(argv[2]);
  if (!writer->Write()) {
    std::cerr << argv[2] << " could not be written.\n";
    return EXIT_FAILURE;
  }

  // What became of it.
  vtkPolyData* lit = radiosity->GetOutput();
  vtkDataArray* irradiance = lit->GetPointData()->GetArray("Irradiance");
  const double brightest = irradiance ? irradiance->GetMaxNorm() : 0;
  auto* history = vtkTable::SafeDownCast(radiosity->GetOutputDataObject(1));
  std::cout << lit->GetNumberOfCells() << " triangles after " << history->GetNumberOfRows()
            << " iterations, stopped by " << radiosity->GetStoppedBy() << ", brightest point "
            << brightest << " W/m2\n";
  return brightest > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
