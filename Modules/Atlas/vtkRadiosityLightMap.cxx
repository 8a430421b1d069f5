#include "vtkRadiosityLightMap.h"

#include "Atlas/Core/LightMap.h"
#include "vtkAtlasAdapter.h"
#include "vtkCoreShell.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSceneAdapter.h"

vtkStandardNewMacro(vtkRadiosityLightMap);

vtkRadiosityLightMap::vtkRadiosityLightMap() { this->SetNumberOfInputPorts(2); }

int vtkRadiosityLightMap::FillInputPortInformation(int, vtkInformation* information) {
  information->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

int vtkRadiosityLightMap::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                      vtkInformationVector* outputs) {
  return lambert::RunCore(this, [&](const lambert::ProgressCallback& progress) {
    lambert::TriangleMesh mesh;
    lambert::RadiositySolution solution =
        lambert::SolutionFromPolyData(vtkPolyData::GetData(inputs[1]));
    const lambert::RadiosityAtlas atlas =
        lambert::AtlasFromPolyData(vtkPolyData::GetData(inputs[0]), &mesh, &solution);
    const lambert::LightMap map = lambert::MakeLightMap(mesh, atlas, solution, progress);
    ++this->NumberOfDrawings;
    this->CoveredTexels = map.coveredTexels;
    this->SeamPoints = map.seamPoints;
    this->SeamRmsBefore = map.before.rms;
    this->SeamRmsAfter = map.after.rms;
    this->LargestSeamBefore = map.before.largest;
    this->LargestSeamAfter = map.after.largest;
    lambert::PagesFromLightMap(map, vtkMultiBlockDataSet::GetData(outputs));
  });
}

void vtkRadiosityLightMap::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "CoveredTexels: " << this->CoveredTexels << "\n"
     << indent << "SeamPoints: " << this->SeamPoints << "\n"
     << indent << "SeamRmsBefore: " << this->SeamRmsBefore << "\n"
     << indent << "SeamRmsAfter: " << this->SeamRmsAfter << "\n"
     << indent << "LargestSeamBefore: " << this->LargestSeamBefore << "\n"
     << indent << "LargestSeamAfter: " << this->LargestSeamAfter << "\n"
     << indent << "NumberOfDrawings: " << this->NumberOfDrawings << "\n";
}
