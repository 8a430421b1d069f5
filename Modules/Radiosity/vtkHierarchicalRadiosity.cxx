#include "vtkHierarchicalRadiosity.h"

#include "Clustering/vtkClusterTreeAdapter.h"
#include "Common/Core/Error.h"
#include "Radiosity/Core/HierarchicalRadiosity.h"
#include "vtkCommand.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMethodPorts.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

vtkStandardNewMacro(vtkHierarchicalRadiosity);

vtkHierarchicalRadiosity::vtkHierarchicalRadiosity()
    : Options(new lambert::HierarchicalRadiosityOptions) {}

vtkHierarchicalRadiosity::~vtkHierarchicalRadiosity() = default;

#define lambertOptionMacro(name, type, member)           \
  void vtkHierarchicalRadiosity::Set##name(type value) { \
    if (this->Options->member != value) {                \
      this->Options->member = value;                     \
      this->Modified();                                  \
    }                                                    \
  }                                                      \
  type vtkHierarchicalRadiosity::Get##name() { return this->Options->member; }
lambertOptionMacro(Error, double, error);
lambertOptionMacro(TimeLimit, double, timeLimit);
lambertOptionMacro(MemoryLimit, double, memoryLimit);
lambertOptionMacro(Iterations, int, iterations);
lambertOptionMacro(VerificationPoints, int, verificationPoints);
lambertOptionMacro(FinalGather, bool, finalGather);
#undef lambertOptionMacro

#define lambertFileNameMacro(name, member)                     \
  void vtkHierarchicalRadiosity::Set##name(const char* file) { \
    const std::string text = file ? file : "";                 \
    if (this->Options->member != text) {                       \
      this->Options->member = text;                            \
      this->Modified();                                        \
    }                                                          \
  }                                                            \
  const char* vtkHierarchicalRadiosity::Get##name() { return this->Options->member.c_str(); }
lambertFileNameMacro(StateFileName, saveState);
lambertFileNameMacro(ResumeFileName, resume);
#undef lambertFileNameMacro

namespace {
/// The tree of `methodScene`: the given one, else one of its own, which brings the faces into its
/// order.
lambert::ClusterTree ClusterScene(vtkTable* given, const lambert::ProgressCallback& progress,
                                  lambert::MethodScene* methodScene) {
  if (given && given->GetNumberOfRows() > 0) {
    return lambert::ClusterTreeFromTable(given);
  }
  // Let the numbers of the input's cells ride along in place of the source's.
  lambert::TriangleMesh& mesh = methodScene->scene.mesh;
  const std::vector<int64_t> source = mesh.sourceCellId;
  mesh.sourceCellId = methodScene->inputFace;
  lambert::ClusterTree tree =
      lambert::ClusterFaces(&mesh, methodScene->scene.parts, {}, nullptr, progress);
  methodScene->inputFace = mesh.sourceCellId;
  for (size_t face = 0; face < source.size(); ++face) {
    mesh.sourceCellId[face] = source[static_cast<size_t>(methodScene->inputFace[face])];
  }
  return tree;
}

void RequireOptions(const lambert::HierarchicalRadiosityOptions& options) {
  if (!(options.error > 0 && options.error <= 1)) {
    throw lambert::Error("The error is " + std::to_string(options.error) +
                         "; it must lie in (0, 1].");
  }
  if (!(options.memoryLimit >= 0)) {
    throw lambert::Error("The memory limit is " + std::to_string(options.memoryLimit) +
                         " MB; it must not be negative.");
  }
  if (options.verificationPoints < 0) {
    throw lambert::Error("The error is verified at 0 points or more, not at " +
                         std::to_string(options.verificationPoints) + ".");
  }
}
}  // namespace

int vtkHierarchicalRadiosity::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                          vtkInformationVector* outputs) {
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* refined = vtkPolyData::GetData(outputs, 0);
  vtkPolyData* lit = vtkPolyData::GetData(outputs, 2);
  lit->ShallowCopy(input);
  return this->Guard([&](const lambert::ProgressCallback& progress) {
    // Scene and clusters.
    RequireOptions(*this->Options);
    lambert::MethodScene methodScene = lambert::MethodSceneFromPolyData(input, this->Sky);
    this->WarnOfDarkness(methodScene.scene);
    const lambert::ClusterTree tree =
        ClusterScene(vtkTable::GetData(inputs[1]), progress, &methodScene);

    // Solve; whoever observes gets a solution after every iteration.
    lambert::HierarchicalRadiosity solver(methodScene.scene, tree, *this->Options);
    solver.Run(progress, [&](const lambert::IterationRecord&) {
      if (this->HasObserver(vtkCommand::UpdateDataEvent)) {
        lambert::FillRefinedMesh(solver.Solution(), methodScene, refined);
        this->InvokeEvent(vtkCommand::UpdateDataEvent);
      }
      return !this->GetAbortExecute();
    });
    this->StoppedBy = solver.Statistics().stoppedBy;

    // Deliver.
    const lambert::RadiositySolution solution = solver.Solution();
    lambert::FillInputMesh(solution, methodScene, lit);
    lambert::FillHistory(solver.Statistics(), vtkTable::GetData(outputs, 1));
    lambert::FillRefinedMesh(solution, methodScene, refined);
  });
}

void vtkHierarchicalRadiosity::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Error: " << this->GetError() << "\n"
     << indent << "TimeLimit: " << this->GetTimeLimit() << "\n"
     << indent << "MemoryLimit: " << this->GetMemoryLimit() << "\n"
     << indent << "Iterations: " << this->GetIterations() << "\n"
     << indent << "VerificationPoints: " << this->GetVerificationPoints() << "\n"
     << indent << "FinalGather: " << this->GetFinalGather() << "\n"
     << indent << "StateFileName: " << this->GetStateFileName() << "\n"
     << indent << "ResumeFileName: " << this->GetResumeFileName() << "\n";
}
