#include "vtkHierarchicalRadiosity.h"

#include "Clustering/vtkClusterTreeAdapter.h"
#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Radiosity/Core/HierarchicalRadiosity.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRadiosityArrays.h"
#include "vtkSceneAdapter.h"
#include "vtkTable.h"

#include <algorithm>
#include <numeric>

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
lambertOptionMacro(Iterations, int, iterations);
#undef lambertOptionMacro

const char* vtkHierarchicalRadiosity::GetStoppedBy() { return this->StoppedBy.c_str(); }

namespace {
/// The scene in tree order with its tree, and the way back to the faces as they came in.
struct ClusteredScene {
  lambert::Scene scene;
  lambert::ClusterTree tree;
  std::vector<int64_t> inputFace;  ///< per face of the scene: cell of the input
};

ClusteredScene ClusterScene(vtkPolyData* input, vtkTable* tree,
                            const lambert::ProgressCallback& progress) {
  ClusteredScene clustered;
  clustered.scene = lambert::SceneFromPolyData(input);
  lambert::TriangleMesh& mesh = clustered.scene.mesh;
  clustered.inputFace.resize(mesh.triangles.size());
  std::iota(clustered.inputFace.begin(), clustered.inputFace.end(), 0);
  if (tree && tree->GetNumberOfRows() > 0) {
    clustered.tree = lambert::ClusterTreeFromTable(tree);
    return clustered;
  }

  // Let the numbers of the input's cells ride along in place of the source's.
  const std::vector<int64_t> source = mesh.sourceCellId;
  mesh.sourceCellId = clustered.inputFace;
  clustered.tree = lambert::ClusterFaces(&mesh, clustered.scene.parts, {}, nullptr, progress);
  clustered.inputFace = mesh.sourceCellId;
  for (size_t face = 0; face < clustered.inputFace.size(); ++face) {
    mesh.sourceCellId[face] = source[static_cast<size_t>(clustered.inputFace[face])];
  }
  return clustered;
}

void FillRefinedMesh(lambert::RadiositySolution solution, const ClusteredScene& clustered,
                     vtkPolyData* output) {
  for (int64_t& face : solution.inputFaceId) {
    face = clustered.inputFace[static_cast<size_t>(face)];
  }
  lambert::PolyDataFromSolution(solution, output);
}

void FillHistory(const lambert::SolverStatistics& statistics, vtkTable* output) {
  using Record = lambert::IterationRecord;
  const auto addColumn = [&](const char* name, auto value) {
    vtkNew<vtkDoubleArray> column;
    column->SetName(name);
    for (const Record& record : statistics.history) {
      column->InsertNextValue(static_cast<double>(value(record)));
    }
    output->AddColumn(column);
  };
  addColumn("iteration", [](const Record& r) { return r.iteration; });
  addColumn("seconds", [](const Record& r) { return r.seconds; });
  addColumn("threshold", [](const Record& r) { return r.threshold; });
  addColumn("elements", [](const Record& r) { return r.elements; });
  addColumn("links", [](const Record& r) { return r.links; });
  addColumn("rays", [](const Record& r) { return r.rays; });
  addColumn("change", [](const Record& r) { return r.change; });
}

vtkSmartPointer<vtkFloatArray> ToArray(const char* name,
                                       const std::vector<lambert::Spectrum>& values) {
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  for (size_t i = 0; i < values.size(); ++i) {
    array->SetTypedTuple(static_cast<vtkIdType>(i), &values[i].r);
  }
  return array;
}

/// The input as it came, with light at its points: radiosity by the mean reflectance and emittance
/// of a point's faces.
void FillInputMesh(const lambert::TriangleMesh& mesh,
                   const std::vector<lambert::Spectrum>& irradiance, vtkPolyData* output) {
  std::vector<lambert::Spectrum> reflectance(irradiance.size()), emittance(irradiance.size());
  std::vector<float> faces(irradiance.size(), 0);
  for (size_t face = 0; face < mesh.triangles.size(); ++face) {
    for (int32_t corner : mesh.triangles[face]) {
      const size_t point = static_cast<size_t>(corner);
      reflectance[point] += mesh.reflectance[face];
      emittance[point] += mesh.emittance[face];
      ++faces[point];
    }
  }
  std::vector<lambert::Spectrum> radiosity(irradiance.size());
  for (size_t point = 0; point < irradiance.size(); ++point) {
    const float share = 1 / std::max(1.f, faces[point]);
    radiosity[point] = (reflectance[point] * irradiance[point] + emittance[point]) * share;
  }
  output->GetPointData()->AddArray(ToArray(vtkRadiosityArrays::Irradiance(), irradiance));
  output->GetPointData()->AddArray(ToArray(vtkRadiosityArrays::Radiosity(), radiosity));
}
}  // namespace

int vtkHierarchicalRadiosity::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                          vtkInformationVector* outputs) {
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* refined = vtkPolyData::GetData(outputs, 0);
  vtkPolyData* lit = vtkPolyData::GetData(outputs, 2);
  lit->ShallowCopy(input);
  this->StoppedBy.clear();
  try {
    // Scene and clusters.
    lambert::SetThreadCount(this->NumberOfThreads);
    const auto progress = [this](double fraction, const char* stage) {
      this->SetProgressText(stage);
      this->UpdateProgress(fraction);
      return !this->GetAbortExecute();
    };
    const ClusteredScene clustered = ClusterScene(input, vtkTable::GetData(inputs[1]), progress);

    // Solve; whoever observes gets a solution after every iteration.
    lambert::HierarchicalRadiosity solver(clustered.scene, clustered.tree, *this->Options);
    solver.Run(progress, [&](const lambert::IterationRecord&) {
      if (this->HasObserver(vtkCommand::UpdateDataEvent)) {
        FillRefinedMesh(solver.Solution(), clustered, refined);
        this->InvokeEvent(vtkCommand::UpdateDataEvent);
      }
      return !this->GetAbortExecute();
    });
    this->StoppedBy = solver.Statistics().stoppedBy;

    // Deliver.
    const lambert::RadiositySolution solution = solver.Solution();
    FillInputMesh(clustered.scene.mesh, solution.inputIrradiance, lit);
    FillHistory(solver.Statistics(), vtkTable::GetData(outputs, 1));
    FillRefinedMesh(solution, clustered, refined);
    return 1;
  } catch (const std::exception& error) {
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

void vtkHierarchicalRadiosity::PrintSelf(ostream& os, vtkIndent indent) {
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Error: " << this->GetError() << "\n"
     << indent << "TimeLimit: " << this->GetTimeLimit() << "\n"
     << indent << "Iterations: " << this->GetIterations() << "\n"
     << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n"
     << indent << "StoppedBy: " << this->StoppedBy << "\n";
}
