#include "vtkMethodPorts.h"

#include "Common/Core/Error.h"
#include "Scene/Core/EnvironmentImage.h"
#include "Scene/Core/SceneCleaning.h"
#include "Scene/Core/SceneLimits.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRadiosityArrays.h"
#include "vtkSceneAdapter.h"
#include "vtkTable.h"
#include "vtkValueArrays.h"

#include <algorithm>
#include <numeric>

namespace lambert {
namespace {
void AddSky(const double radiance[3], Scene* scene) {
  Light sky;
  sky.type = LightType::Sky;
  sky.name = "sky";
  for (int band = 0; band < 3; ++band) {
    sky.intensity[band] = static_cast<float>(radiance[band]);
  }
  if (!sky.intensity.IsFinite() || std::min({radiance[0], radiance[1], radiance[2]}) < 0) {
    throw Error("The sky's radiance is negative or not a finite number.");
  }
  if (!sky.intensity.IsBlack()) {
    scene->lights.push_back(sky);
  }
}
}  // namespace

MethodScene MethodSceneFromPolyData(vtkPolyData* input, const double sky[3]) {
  MethodScene methodScene;
  methodScene.scene =
      SceneFromPolyData(input, CleaningOptions().featureAngle, &methodScene.inputTriangles);
  RequireSolvableMesh(methodScene.scene.mesh);
  ReadEnvironmentImages(&methodScene.scene.lights);
  methodScene.inputFace.resize(methodScene.scene.mesh.triangles.size());
  std::iota(methodScene.inputFace.begin(), methodScene.inputFace.end(), 0);
  AddSky(sky, &methodScene.scene);
  return methodScene;
}

void FillRefinedMesh(const RadiositySolution& solution, const MethodScene& methodScene,
                     vtkPolyData* output) {
  RadiositySolution delivered = solution;
  for (int64_t& face : delivered.inputFaceId) {
    face = methodScene.inputFace[static_cast<size_t>(face)];
  }
  PolyDataFromSolution(delivered, methodScene.scene, output);
}

void FillHistory(const SolverStatistics& statistics, vtkTable* output) {
  using Record = IterationRecord;
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
  addColumn("error", [](const Record& r) { return r.error; });
}

void FillInputMesh(const RadiositySolution& solution, const MethodScene& methodScene,
                   vtkPolyData* output) {
  constexpr float kLeastWeight =
      1e-12f;  // m2, so that faces without area have a say of last resort
  const TriangleMesh& mesh = methodScene.scene.mesh;
  const size_t points = static_cast<size_t>(output->GetNumberOfPoints());
  std::vector<Spectrum> irradiance(points), radiosity(points);
  std::vector<float> weights(points, 0);
  for (size_t face = 0; face < mesh.triangles.size(); ++face) {
    const auto& own = methodScene.inputTriangles[static_cast<size_t>(methodScene.inputFace[face])];
    const float weight = std::max(kLeastWeight, mesh.Area(static_cast<int64_t>(face)));
    for (size_t corner = 0; corner < 3; ++corner) {
      const Spectrum& arriving =
          solution.inputIrradiance[static_cast<size_t>(mesh.triangles[face][corner])];
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
  output->GetPointData()->AddArray(ArrayFromTuples(vtkRadiosityArrays::Irradiance(), irradiance));
  output->GetPointData()->AddArray(ArrayFromTuples(vtkRadiosityArrays::Radiosity(), radiosity));
}
}  // namespace lambert
