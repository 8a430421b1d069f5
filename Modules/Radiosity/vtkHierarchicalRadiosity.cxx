#include "vtkHierarchicalRadiosity.h"

#include "Clustering/vtkClusterTreeAdapter.h"
#include "Common/Core/ContentHash.h"
#include "Common/Core/Error.h"
#include "Radiosity/Core/HierarchicalRadiosity.h"
#include "Scene/Core/SceneKey.h"
#include "vtkCommand.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMethodPorts.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>

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

#define lambertOptionMacro(name, type, member)           \
  void vtkHierarchicalRadiosity::Set##name(type value) { \
    if (this->Options->member != value) {                \
      this->Options->member = value;                     \
      this->Kept.reset();                                \
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
lambertOptionMacro(SnapTolerance, float, leafMesh.snapTolerance);
#undef lambertOptionMacro

// The choices of the core, in the order of the enumerations here.
#define lambertChoiceMacro(name, type, last, member)                        \
  void vtkHierarchicalRadiosity::Set##name(int value) {                     \
    const auto choice = static_cast<type>(std::clamp<int>(value, 0, last)); \
    if (this->Options->member != choice) {                                  \
      this->Options->member = choice;                                       \
      this->Kept.reset();                                                   \
      this->Modified();                                                     \
    }                                                                       \
  }                                                                         \
  int vtkHierarchicalRadiosity::Get##name() { return static_cast<int>(this->Options->member); }
lambertChoiceMacro(Refinement, lambert::PatchRefinement, QUADTREE, leafMesh.refinement);
lambertChoiceMacro(Oracle, lambert::OracleKind, VISIBILITY, oracle);
lambertChoiceMacro(Schedule, lambert::Schedule, INTERLEAVED, schedule);
#undef lambertChoiceMacro

#define lambertFileNameMacro(name, member)                     \
  void vtkHierarchicalRadiosity::Set##name(const char* file) { \
    const std::string text = file ? file : "";                 \
    if (this->Options->member != text) {                       \
      this->Options->member = text;                            \
      this->Kept.reset();                                      \
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

/// The values of the faces of an input, in the order of the kept scene.
template <class T>
std::vector<T> InOrder(const std::vector<int64_t>& inputFace, const std::vector<T>& values) {
  std::vector<T> ordered(values.size());
  for (size_t face = 0; face < ordered.size(); ++face) {
    ordered[face] = values[static_cast<size_t>(inputFace[face])];
  }
  return ordered;
}

/// Gives the kept scene the materials of `next`; false, with nothing changed, where these are what
/// it has, or where more than materials differs.
bool TakeMaterials(const lambert::MethodScene& next, lambert::MethodScene* kept) {
  // Points, faces, parts, and which faces share a material.
  const lambert::TriangleMesh& mesh = next.scene.mesh;
  lambert::TriangleMesh& own = kept->scene.mesh;
  const std::vector<int64_t>& order = kept->inputFace;
  if (mesh.triangles.size() != own.triangles.size() || mesh.positions != own.positions ||
      mesh.normals != own.normals || mesh.uvs != own.uvs ||
      InOrder(order, mesh.triangles) != own.triangles ||
      InOrder(order, mesh.materialId) != own.materialId ||
      InOrder(order, mesh.partId) != own.partId) {
    return false;
  }

  // What they reflect and emit.
  std::vector<lambert::Spectrum> reflectance = InOrder(order, mesh.reflectance);
  std::vector<lambert::Spectrum> emittance = InOrder(order, mesh.emittance);
  std::vector<uint8_t> flags = InOrder(order, mesh.faceFlags);
  if (reflectance == own.reflectance && emittance == own.emittance && flags == own.faceFlags) {
    return false;
  }
  own.reflectance = std::move(reflectance);
  own.emittance = std::move(emittance);
  own.faceFlags = std::move(flags);
  kept->scene.materials = next.scene.materials;
  return true;
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
  if (this->Kept && this->Kept->lights == lights && isSameTree() &&
      TakeMaterials(next, &this->Kept->methodScene) && this->Kept->solver->Relight()) {
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
