#include "vtkLitMeshSimplification.h"

#include "Atlas/Core/LitMeshSimplification.h"
#include "Common/Core/Error.h"
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
  const auto progress = [this](double fraction, const char* stage) {
    this->SetProgressText(stage);
    this->UpdateProgress(fraction);
    return !this->GetAbortExecute();
  };
  try {
    vtkPolyData* solved = vtkPolyData::GetData(inputs[0]);
    const lambert::RadiositySolution simplified = lambert::SimplifyLitMesh(
        lambert::SolutionFromPolyData(solved), *this->Options, nullptr, progress);
    lambert::PolyDataFromSolution(simplified, lambert::SceneAsStoredInPolyData(solved),
                                  vtkPolyData::GetData(outputs));
    return 1;
  } catch (const lambert::Cancelled&) {
    return 1;  // An abort is no error; nothing is delivered.
  } catch (const std::exception& error) {
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

void vtkLitMeshSimplification::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << this->GetTolerance() << "\n";
}
