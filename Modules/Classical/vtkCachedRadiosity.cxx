#include "vtkCachedRadiosity.h"

#include "Classical/Core/CachedRadiosity.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkCachedRadiosity);

vtkCachedRadiosity::vtkCachedRadiosity() : Options(new lambert::CachedRadiosityOptions) {}

vtkCachedRadiosity::~vtkCachedRadiosity() = default;

#define lambertOptionMacro(name, type, member)     \
  void vtkCachedRadiosity::Set##name(type value) { \
    if (this->Options->member != value) {          \
      this->Options->member = value;               \
      this->Modified();                            \
    }                                              \
  }                                                \
  type vtkCachedRadiosity::Get##name() { return this->Options->member; }
lambertOptionMacro(ElementSize, double, elementSize);
lambertOptionMacro(OutputSize, double, outputSize);
lambertOptionMacro(Paths, int, paths);
lambertOptionMacro(GatherRays, int, gatherRays);
lambertOptionMacro(EmitterRays, int, emitterRays);
lambertOptionMacro(Seed, vtkTypeUInt64, seed);
#undef lambertOptionMacro

int vtkCachedRadiosity::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                    vtkInformationVector* outputs) {
  return this->RequestSolution(
      inputs, outputs,
      [this](const lambert::Scene& scene, lambert::SolverStatistics* statistics,
             const Progress& progress) {
        return lambert::SolveCachedRadiosity(scene, *this->Options, statistics, progress);
      });
}

void vtkCachedRadiosity::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ElementSize: " << this->GetElementSize() << "\n"
     << indent << "OutputSize: " << this->GetOutputSize() << "\n"
     << indent << "Paths: " << this->GetPaths() << "\n"
     << indent << "GatherRays: " << this->GetGatherRays() << "\n"
     << indent << "EmitterRays: " << this->GetEmitterRays() << "\n"
     << indent << "Seed: " << this->GetSeed() << "\n";
}
