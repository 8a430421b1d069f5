#include "vtkRadiosityAlgorithm.h"

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "vtkCoreShell.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMethodPorts.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

vtkRadiosityAlgorithm::vtkRadiosityAlgorithm() {
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
}

int vtkRadiosityAlgorithm::FillInputPortInformation(int port, vtkInformation* information) {
  if (port == 0) {
    return this->Superclass::FillInputPortInformation(port, information);
  }
  information->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  information->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

int vtkRadiosityAlgorithm::FillOutputPortInformation(int port, vtkInformation* information) {
  information->Set(vtkDataObject::DATA_TYPE_NAME(), port == 1 ? "vtkTable" : "vtkPolyData");
  return 1;
}

const char* vtkRadiosityAlgorithm::GetStoppedBy() { return this->StoppedBy.c_str(); }

int vtkRadiosityAlgorithm::Guard(const std::function<void(const Progress&)>& work) {
  this->StoppedBy.clear();
  try {
    lambert::SetThreadCount(this->NumberOfThreads);
    work(lambert::ProgressOf(this));
    return 1;
  } catch (const lambert::Cancelled&) {
    this->StoppedBy = "interrupt";  // There is nothing to deliver.
    return 1;
  } catch (const std::exception& error) {
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

int vtkRadiosityAlgorithm::RequestSolution(vtkInformationVector** inputs,
                                           vtkInformationVector* outputs, const Method& method) {
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* lit = vtkPolyData::GetData(outputs, 2);
  lit->ShallowCopy(input);
  return this->Guard([&](const Progress& progress) {
    const lambert::MethodScene methodScene = lambert::MethodSceneFromPolyData(input, this->Sky);
    this->WarnOfDarkness(methodScene.scene);
    lambert::SolverStatistics statistics;
    const lambert::RadiositySolution solution = method(methodScene.scene, &statistics, progress);
    this->StoppedBy = statistics.stoppedBy;
    lambert::FillRefinedMesh(solution, methodScene, vtkPolyData::GetData(outputs, 0));
    lambert::FillHistory(statistics, vtkTable::GetData(outputs, 1));
    lambert::FillInputMesh(solution, methodScene, lit);
  });
}

void vtkRadiosityAlgorithm::WarnOfDarkness(const lambert::Scene& scene) {
  if (!scene.HasLight()) {
    vtkWarningMacro("The scene has no light: no face emits, no lamp is given, the sky is black.");
  }
}

void vtkRadiosityAlgorithm::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Sky: " << this->Sky[0] << " " << this->Sky[1] << " " << this->Sky[2] << "\n"
     << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n"
     << indent << "StoppedBy: " << this->StoppedBy << "\n";
}
