#include "vtkRadiosityLightMap.h"

#include "Atlas/Core/LightMap.h"
#include "Common/Core/Error.h"
#include "vtkAtlasAdapter.h"
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
  const auto progress = [this](double fraction, const char* stage) {
    this->SetProgressText(stage);
    this->UpdateProgress(fraction);
    return !this->GetAbortExecute();
  };
  try {
    lambert::TriangleMesh mesh;
    const lambert::RadiosityAtlas atlas =
        lambert::AtlasFromPolyData(vtkPolyData::GetData(inputs[0]), &mesh);
    const lambert::RadiositySolution solution =
        lambert::SolutionFromPolyData(vtkPolyData::GetData(inputs[1]));
    const lambert::LightMap map = lambert::MakeLightMap(mesh, atlas, solution, progress);
    ++this->NumberOfDrawings;
    this->CoveredTexels = map.coveredTexels;
    this->SeamPoints = map.seamPoints;
    this->SeamRmsBefore = map.before.rms;
    this->SeamRmsAfter = map.after.rms;
    this->LargestSeamBefore = map.before.largest;
    this->LargestSeamAfter = map.after.largest;
    lambert::PagesFromLightMap(map, vtkMultiBlockDataSet::GetData(outputs));
    return 1;
  } catch (const lambert::Cancelled&) {
    return 1;  // An abort is no error; nothing is delivered.
  } catch (const std::exception& error) {
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

void vtkRadiosityLightMap::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "CoveredTexels: " << this->CoveredTexels << "\n"
     << indent << "SeamPoints: " << this->SeamPoints << "\n"
     << indent << "SeamRmsBefore: " << this->SeamRmsBefore << "\n"
     << indent << "SeamRmsAfter: " << this->SeamRmsAfter << "\n"
     << indent << "NumberOfDrawings: " << this->NumberOfDrawings << "\n";
}
