#include "vtkCachedRadiosity.h"

#include "Classical/Core/CachedRadiosity.h"
#include "vtkCoreShell.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkCachedRadiosity);

vtkCachedRadiosity::vtkCachedRadiosity() : Options(new lambert::CachedRadiosityOptions) {}

vtkCachedRadiosity::~vtkCachedRadiosity() = default;

lambertOptionMacro(vtkCachedRadiosity, ElementSize, double, elementSize);
lambertOptionMacro(vtkCachedRadiosity, OutputSize, double, outputSize);
lambertOptionMacro(vtkCachedRadiosity, Paths, int, paths);
lambertOptionMacro(vtkCachedRadiosity, GatherRays, int, gatherRays);
lambertOptionMacro(vtkCachedRadiosity, EmitterRays, int, emitterRays);
lambertOptionMacro(vtkCachedRadiosity, Seed, vtkTypeUInt64, seed);

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
