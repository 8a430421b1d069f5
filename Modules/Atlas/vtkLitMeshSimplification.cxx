#include "vtkLitMeshSimplification.h"

#include "Atlas/Core/LitMeshSimplification.h"
#include "vtkCoreShell.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSceneAdapter.h"

vtkStandardNewMacro(vtkLitMeshSimplification);

vtkLitMeshSimplification::vtkLitMeshSimplification()
    : Options(new lambert::LitMeshSimplificationOptions) {}

vtkLitMeshSimplification::~vtkLitMeshSimplification() = default;

void vtkLitMeshSimplification::SetTolerance(double tolerance) {
  if (this->Options->tolerance != tolerance) {
    this->Options->tolerance = tolerance;
    this->Modified();
  }
}

double vtkLitMeshSimplification::GetTolerance() { return this->Options->tolerance; }

int vtkLitMeshSimplification::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                          vtkInformationVector* outputs) {
  return lambert::RunCore(this, [&](const lambert::ProgressCallback& progress) {
    vtkPolyData* solved = vtkPolyData::GetData(inputs[0]);
    const lambert::RadiositySolution simplified = lambert::SimplifyLitMesh(
        lambert::SolutionFromPolyData(solved), *this->Options, nullptr, progress);
    lambert::PolyDataFromSolution(simplified, lambert::SceneAsStoredInPolyData(solved),
                                  vtkPolyData::GetData(outputs));
  });
}

void vtkLitMeshSimplification::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << this->GetTolerance() << "\n";
}
