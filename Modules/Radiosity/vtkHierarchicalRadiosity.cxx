#include "vtkHierarchicalRadiosity.h"

#include "Clustering/vtkClusterTreeAdapter.h"
#include "Common/Core/ContentHash.h"
#include "Common/Core/Error.h"
#include "Radiosity/Core/HierarchicalRadiosity.h"
#include "Scene/Core/SceneKey.h"
#include "Scene/Core/SceneMaterials.h"
#include "vtkCommand.h"
#include "vtkCoreShell.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMethodPorts.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

vtkStandardNewMacro(vtkHierarchicalRadiosity);

/// A solver and what it refers to.
struct vtkHierarchicalRadiosity::Solver {
  lambert::MethodScene methodScene;
  lambert::ClusterTree tree;
  bool hasGivenTree = false;  ///< from port 1
  uint64_t lights = 0;        ///< of the key of the scene
  std::unique_ptr<lambert::HierarchicalRadiosity> solver;
};

vtkHierarchicalRadiosity::vtkHierarchicalRadiosity()
    : Options(new lambert::HierarchicalRadiosityOptions) {}

vtkHierarchicalRadiosity::~vtkHierarchicalRadiosity() = default;

// Links that were made with another option do not count.
template <class T>
void vtkHierarchicalRadiosity::SetOption(T* option, const T& value) {
  if (*option == value) {
    return;
  }
  *option = value;
  this->Kept.reset();
  this->Modified();
}

#define lambertOptionOfRunMacro(name, type, member)      \
  void vtkHierarchicalRadiosity::Set##name(type value) { \
    this->SetOption(&this->Options->member, value);      \
  }                                                      \
  type vtkHierarchicalRadiosity::Get##name() { return this->Options->member; }
lambertOptionOfRunMacro(Error, double, error);
lambertOptionOfRunMacro(TimeLimit, double, timeLimit);
lambertOptionOfRunMacro(MemoryLimit, double, memoryLimit);
lambertOptionOfRunMacro(Iterations, int, iterations);
lambertOptionOfRunMacro(VerificationPoints, int, verificationPoints);
lambertOptionOfRunMacro(FinalGather, bool, finalGather);
lambertOptionOfRunMacro(SnapTolerance, float, leafMesh.snapTolerance);
#undef lambertOptionOfRunMacro

// The choices of the core, in the order of the enumerations here.
#define lambertChoiceOfRunMacro(name, type, last, member, expected)    \
  void vtkHierarchicalRadiosity::Set##name(int value) {                \
    lambertRequireChoiceMacro(value, last, expected);                  \
    this->SetOption(&this->Options->member, static_cast<type>(value)); \
  }                                                                    \
  int vtkHierarchicalRadiosity::Get##name() { return static_cast<int>(this->Options->member); }
lambertChoiceOfRunMacro(Refinement, lambert::PatchRefinement, QUADTREE, leafMesh.refinement,
                        "The refinement is RECTANGLE or QUADTREE");
lambertChoiceOfRunMacro(Oracle, lambert::OracleKind, PERCEPTUAL, oracle,
                        "The oracle is DOUBT, GEOMETRIC, BFA, VISIBILITY or PERCEPTUAL");
lambertChoiceOfRunMacro(Schedule, lambert::Schedule, INTERLEAVED, schedule,
                        "The schedule is SCHEDULED or INTERLEAVED");
#undef lambertChoiceOfRunMacro

#define lambertFileNameMacro(name, member)                                  \
  void vtkHierarchicalRadiosity::Set##name(const char* file) {              \
    this->SetOption(&this->Options->member, std::string(file ? file : "")); \
  }                                                                         \
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
  if (!(options.timeLimit >= 0)) {
    throw lambert::Error("The time limit is " + std::to_string(options.timeLimit) +
                         " s; it must not be negative.");
  }
  if (options.iterations < 0) {
    throw lambert::Error("The iterations are " + std::to_string(options.iterations) +
                         "; there are 0 (as many as it takes) or more.");
  }
  if (options.verificationPoints < 0) {
    throw lambert::Error("The error is verified at 0 points or more, not at " +
                         std::to_string(options.verificationPoints) + ".");
  }
}
}  // namespace

// The solver of the last run where its links still count, else a new one; true for the first.
bool vtkHierarchicalRadiosity::PrepareSolver(vtkPolyData* input, vtkTable* clusters,
                                             const Progress& progress) {
  lambert::MethodScene next = lambert::MethodSceneFromPolyData(input, this->Sky);
  this->WarnOfDarkness(next.scene);
  const uint64_t lights = lambert::KeyOf(next.scene).lights;
  const auto isSameTree = [&] {
    if (!clusters || clusters->GetNumberOfRows() == 0) return !this->Kept->hasGivenTree;
    return this->Kept->hasGivenTree &&
           lambert::HashOf(lambert::ClusterTreeFromTable(clusters).nodes, 0) ==
               lambert::HashOf(this->Kept->tree.nodes, 0);
  };
  const auto takesMaterials = [&] {
    lambert::MethodScene& kept = this->Kept->methodScene;
    return lambert::TakeMaterials(next.scene, kept.inputFace, &kept.scene);
  };
  if (this->Kept && this->Kept->lights == lights && isSameTree() && takesMaterials() &&
      this->Kept->solver->Relight()) {
    return true;
  }

  // What stood before goes first: there is no room for two.
  this->Kept.reset();
  auto made = std::make_unique<Solver>();
  made->lights = lights;
  made->hasGivenTree = clusters && clusters->GetNumberOfRows() > 0;
  made->methodScene = std::move(next);
  made->tree = ClusterScene(clusters, progress, &made->methodScene);
  lambert::HierarchicalRadiosityOptions options = *this->Options;
  options.keepsTransfers = this->KeepLinks;
  made->solver = std::make_unique<lambert::HierarchicalRadiosity>(made->methodScene.scene,
                                                                  made->tree, options);
  this->Kept = std::move(made);
  return false;
}

int vtkHierarchicalRadiosity::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                          vtkInformationVector* outputs) {
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* refined = vtkPolyData::GetData(outputs, 0);
  vtkPolyData* lit = vtkPolyData::GetData(outputs, 2);
  lit->ShallowCopy(input);
  const int succeeded = this->Guard([&](const lambert::ProgressCallback& progress) {
    RequireOptions(*this->Options);
    const bool isRelit = this->PrepareSolver(input, vtkTable::GetData(inputs[1]), progress);
    lambert::HierarchicalRadiosity& solver = *this->Kept->solver;
    const lambert::MethodScene& methodScene = this->Kept->methodScene;

    // Solve; whoever observes gets a solution at once where there is one, and after every
    // iteration.
    const auto show = [&] {
      if (this->HasObserver(vtkCommand::UpdateDataEvent)) {
        lambert::FillRefinedMesh(solver.Solution(), methodScene, refined);
        this->InvokeEvent(vtkCommand::UpdateDataEvent);
      }
      return !this->GetAbortExecute();
    };
    if (isRelit) show();
    solver.Run(progress, [&](const lambert::IterationRecord&) { return show(); });
    this->StoppedBy = solver.Statistics().stoppedBy;
    const std::string& failure = solver.Statistics().stateFailure;
    if (!failure.empty()) vtkWarningMacro(<< failure);

    // Deliver.
    const lambert::RadiositySolution solution = solver.Solution();
    lambert::FillInputMesh(solution, methodScene, lit);
    lambert::FillHistory(solver.Statistics(), vtkTable::GetData(outputs, 1));
    lambert::FillRefinedMesh(solution, methodScene, refined);
  });
  if (!succeeded || !this->KeepLinks || this->StoppedBy == "interrupt") this->Kept.reset();
  return succeeded;
}

void vtkHierarchicalRadiosity::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Error: " << this->GetError() << "\n"
     << indent << "TimeLimit: " << this->GetTimeLimit() << "\n"
     << indent << "MemoryLimit: " << this->GetMemoryLimit() << "\n"
     << indent << "Iterations: " << this->GetIterations() << "\n"
     << indent << "VerificationPoints: " << this->GetVerificationPoints() << "\n"
     << indent << "FinalGather: " << this->GetFinalGather() << "\n"
     << indent << "Refinement: " << lambert::RefinementName(this->Options->leafMesh.refinement)
     << "\n"
     << indent << "SnapTolerance: " << this->GetSnapTolerance() << "\n"
     << indent << "Schedule: " << lambert::ScheduleName(this->Options->schedule) << "\n"
     << indent << "Oracle: " << lambert::OracleName(this->Options->oracle) << "\n"
     << indent << "KeepLinks: " << this->KeepLinks << "\n"
     << indent << "StateFileName: " << this->GetStateFileName() << "\n"
     << indent << "ResumeFileName: " << this->GetResumeFileName() << "\n";
}
