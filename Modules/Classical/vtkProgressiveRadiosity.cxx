#include "vtkProgressiveRadiosity.h"

#include "Classical/Core/ProgressiveRadiosity.h"
#include "vtkCommand.h"
#include "vtkCoreShell.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMethodPorts.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

vtkStandardNewMacro(vtkProgressiveRadiosity);

vtkProgressiveRadiosity::vtkProgressiveRadiosity()
    : Options(new lambert::ProgressiveRadiosityOptions) {}

vtkProgressiveRadiosity::~vtkProgressiveRadiosity() = default;

lambertOptionMacro(vtkProgressiveRadiosity, ElementSize, double, elementSize);
lambertOptionMacro(vtkProgressiveRadiosity, PatchSize, double, patchSize);
lambertOptionMacro(vtkProgressiveRadiosity, Unshot, double, unshot);
lambertOptionMacro(vtkProgressiveRadiosity, Shots, vtkTypeInt64, shots);
lambertOptionMacro(vtkProgressiveRadiosity, SkyRays, int, skyRays);

int vtkProgressiveRadiosity::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                         vtkInformationVector* outputs) {
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* refined = vtkPolyData::GetData(outputs, 0);
  vtkPolyData* lit = vtkPolyData::GetData(outputs, 2);
  lit->ShallowCopy(input);
  return this->Guard([&](const Progress& progress) {
    const lambert::MethodScene methodScene = lambert::MethodSceneFromPolyData(input, this->Sky);
    this->WarnOfDarkness(methodScene.scene);

    // Shoot; whoever observes gets a solution after every iteration.
    lambert::ProgressiveRadiosity solver(methodScene.scene, *this->Options);
    solver.Run(progress, [&](const lambert::IterationRecord&) {
      if (this->HasObserver(vtkCommand::UpdateDataEvent)) {
        lambert::FillRefinedMesh(this->Ambient ? solver.SolutionWithAmbient() : solver.Solution(),
                                 methodScene, refined);
        this->InvokeEvent(vtkCommand::UpdateDataEvent);
      }
      return !this->GetAbortExecute();
    });
    this->StoppedBy = solver.Statistics().stoppedBy;

    // Deliver.
    const lambert::RadiositySolution solution = solver.Solution();
    lambert::FillRefinedMesh(solution, methodScene, refined);
    lambert::FillHistory(solver.Statistics(), vtkTable::GetData(outputs, 1));
    lambert::FillInputMesh(solution, methodScene, lit);
  });
}

void vtkProgressiveRadiosity::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ElementSize: " << this->GetElementSize() << "\n"
     << indent << "PatchSize: " << this->GetPatchSize() << "\n"
     << indent << "Unshot: " << this->GetUnshot() << "\n"
     << indent << "Shots: " << this->GetShots() << "\n"
     << indent << "SkyRays: " << this->GetSkyRays() << "\n"
     << indent << "Ambient: " << (this->Ambient ? "On" : "Off") << "\n";
}
