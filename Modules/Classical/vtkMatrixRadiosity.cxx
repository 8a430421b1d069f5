#include "vtkMatrixRadiosity.h"

#include "Classical/Core/MatrixRadiosity.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkMatrixRadiosity);

vtkMatrixRadiosity::vtkMatrixRadiosity() : Options(new lambert::MatrixRadiosityOptions) {}

vtkMatrixRadiosity::~vtkMatrixRadiosity() = default;

#define lambertOptionMacro(name, type, member)     \
  void vtkMatrixRadiosity::Set##name(type value) { \
    if (this->Options->member != value) {          \
      this->Options->member = value;               \
      this->Modified();                            \
    }                                              \
  }                                                \
  type vtkMatrixRadiosity::Get##name() { return this->Options->member; }
lambertOptionMacro(ElementSize, double, elementSize);
lambertOptionMacro(VisibilityRays, int, visibilityRays);
lambertOptionMacro(SkyRays, int, skyRays);
lambertOptionMacro(Tolerance, double, tolerance);
lambertOptionMacro(MemoryLimit, vtkTypeInt64, memoryLimit);
#undef lambertOptionMacro

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
