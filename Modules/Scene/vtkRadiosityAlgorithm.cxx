#include "vtkRadiosityAlgorithm.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
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

void vtkRadiosityAlgorithm::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Sky: " << this->Sky[0] << " " << this->Sky[1] << " " << this->Sky[2] << "\n";
}
