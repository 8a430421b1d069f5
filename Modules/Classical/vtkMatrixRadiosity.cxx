#include "vtkMatrixRadiosity.h"

#include "Classical/Core/MatrixRadiosity.h"
#include "vtkCoreShell.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkMatrixRadiosity);

vtkMatrixRadiosity::vtkMatrixRadiosity() : Options(new lambert::MatrixRadiosityOptions) {}

vtkMatrixRadiosity::~vtkMatrixRadiosity() = default;

lambertOptionMacro(vtkMatrixRadiosity, ElementSize, double, elementSize);
lambertOptionMacro(vtkMatrixRadiosity, VisibilityRays, int, visibilityRays);
lambertOptionMacro(vtkMatrixRadiosity, SkyRays, int, skyRays);
lambertOptionMacro(vtkMatrixRadiosity, Tolerance, double, tolerance);
lambertOptionMacro(vtkMatrixRadiosity, MemoryLimit, vtkTypeInt64, memoryLimit);

int vtkMatrixRadiosity::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                    vtkInformationVector* outputs) {
  return this->RequestSolution(
      inputs, outputs,
      [this](const lambert::Scene& scene, lambert::SolverStatistics* statistics,
             const Progress& progress) {
        return lambert::SolveMatrixRadiosity(scene, *this->Options, statistics, progress);
      });
}

void vtkMatrixRadiosity::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ElementSize: " << this->GetElementSize() << "\n"
     << indent << "VisibilityRays: " << this->GetVisibilityRays() << "\n"
     << indent << "SkyRays: " << this->GetSkyRays() << "\n"
     << indent << "Tolerance: " << this->GetTolerance() << "\n"
     << indent << "MemoryLimit: " << this->GetMemoryLimit() << "\n";
}
