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
#include <array>
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
  std::vector<int64_t> inputFace;  ///< per face of the scene: triangle of the input
  std::vector<std::array<int32_t, 3>> inputTriangles;  ///< with the points of the input
};

ClusteredScene ClusterScene(vtkPolyData* input, vtkTable* tree,
                            const lambert::ProgressCallback& progress) {
  ClusteredScene clustered;
  clustered.scene = lambert::SceneFromPolyData(input);
  clustered.inputTriangles = lambert::SceneAsStoredInPolyData(input).mesh.triangles;
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
  lambert::PolyDataFromSolution(solution, clustered.scene, output);
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
/// Light at the input's own points. The scene may have split a point where its faces fall apart
/// into several normals: an input point gets the mean of its corners, weighted by their faces'
/// areas.
void FillInputMesh(const ClusteredScene& clustered, const std::vector<lambert::Spectrum>& light,
                   vtkPolyData* output) {
  constexpr float kLeastWeight =
      1e-12f;  // m2, so that faces without area have a say of last resort
  const lambert::TriangleMesh& mesh = clustered.scene.mesh;
  const size_t points = static_cast<size_t>(output->GetNumberOfPoints());
  std::vector<lambert::Spectrum> irradiance(points), radiosity(points);
  std::vector<float> weights(points, 0);
  for (size_t face = 0; face < mesh.triangles.size(); ++face) {
    const auto& own = clustered.inputTriangles[static_cast<size_t>(clustered.inputFace[face])];
    const float weight = std::max(kLeastWeight, mesh.Area(static_cast<int64_t>(face)));
    for (size_t corner = 0; corner < 3; ++corner) {
      const lambert::Spectrum& arriving = light[static_cast<size_t>(mesh.triangles[face][corner])];
      const size_t point = static_cast<size_t>(own[corner]);
      irradiance[point] += arriving * weight;
      radiosity[point] += (mesh.reflectance[face] * arriving + mesh.emittance[face]) * weight;
      weights[point] += weight;
    }
  }
  for (size_t point = 0; point < points; ++point) {
    const float share = weights[point] > 0 ? 1 / weights[point] : 0;
    irradiance[point] = irradiance[point] * share;
    radiosity[point] = radiosity[point] * share;
  }
  output->GetPointData()->AddArray(ToArray(vtkRadiosityArrays::Irradiance(), irradiance));
  output->GetPointData()->AddArray(ToArray(vtkRadiosityArrays::Radiosity(), radiosity));
}

void RequireOptions(const lambert::HierarchicalRadiosityOptions& options) {
  if (!(options.error > 0 && options.error <= 1)) {
    throw lambert::Error("The error is " + std::to_string(options.error) +
                         "; it must lie in (0, 1].");
  }
}

void AddSky(const double radiance[3], lambert::Scene* scene) {
  lambert::Light sky;
  sky.type = lambert::LightType::Sky;
  sky.name = "sky";
  for (int band = 0; band < 3; ++band) {
    sky.intensity[band] = static_cast<float>(radiance[band]);
  }
  if (!sky.intensity.IsFinite() || std::min({radiance[0], radiance[1], radiance[2]}) < 0) {
    throw lambert::Error("The sky's radiance is negative or not a finite number.");
  }
  if (!sky.intensity.IsBlack()) {
    scene->lights.push_back(sky);
  }
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
    RequireOptions(*this->Options);
    ClusteredScene clustered = ClusterScene(input, vtkTable::GetData(inputs[1]), progress);
    AddSky(this->Sky, &clustered.scene);
    if (!clustered.scene.HasLight()) {
      vtkWarningMacro("The scene has no light: no face emits, no lamp is given, the sky is black.");
    }

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
    FillInputMesh(clustered, solution.inputIrradiance, lit);
    FillHistory(solver.Statistics(), vtkTable::GetData(outputs, 1));
    FillRefinedMesh(solution, clustered, refined);
    return 1;
  } catch (const lambert::Cancelled&) {
    this->StoppedBy = "interrupt";  // Before the first iteration: there is nothing to deliver.
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
