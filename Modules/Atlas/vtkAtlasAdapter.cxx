#include "vtkAtlasAdapter.h"

#include "vtkCellData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRadiosityArrays.h"
#include "vtkSceneAdapter.h"

#include <algorithm>

namespace lambert {
namespace {
vtkSmartPointer<vtkFloatArray> TextureCoordsArray(const std::vector<Vec2f>& coordinates) {
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(vtkRadiosityArrays::LightMapTCoords());
  array->SetNumberOfComponents(2);
  array->SetNumberOfTuples(static_cast<vtkIdType>(coordinates.size()));
  for (size_t i = 0; i < coordinates.size(); ++i) {
    array->SetTuple2(static_cast<vtkIdType>(i), coordinates[i].x, coordinates[i].y);
  }
  return array;
}

template <class T>
void Append(const std::vector<T>& values, std::vector<T>* to) {
  to->insert(to->end(), values.begin(), values.end());
}

/// Faces and points of `other` behind those of `mesh`; what either lacks, both lack.
void AppendMesh(const TriangleMesh& other, TriangleMesh* mesh) {
  const auto first = static_cast<int32_t>(mesh->positions.size());
  const bool haveNormals = !mesh->normals.empty() && !other.normals.empty();
  const bool haveUvs = !mesh->uvs.empty() && !other.uvs.empty();
  Append(other.positions, &mesh->positions);
  Append(other.normals, &mesh->normals);
  Append(other.uvs, &mesh->uvs);
  if (first > 0 && !other.positions.empty()) {
    if (!haveNormals) mesh->normals.clear();
    if (!haveUvs) mesh->uvs.clear();
  }
  for (const auto& t : other.triangles) {
    mesh->triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  Append(other.reflectance, &mesh->reflectance);
  Append(other.emittance, &mesh->emittance);
  Append(other.faceFlags, &mesh->faceFlags);
  Append(other.materialId, &mesh->materialId);
  Append(other.partId, &mesh->partId);
  Append(other.sourceCellId, &mesh->sourceCellId);
  mesh->surfaceId.clear();  // Those of the two are not the same.
}
}  // namespace

void PolyDataFromRepresentedScene(const RepresentedScene& represented, Scene scene,
                                  vtkPolyData* output) {
  // What the light map takes, with the light that lookups bring to its points.
  scene.mesh = represented.mapped.mesh;
  std::vector<Vec2f> coordinates = SplitAtCharts(represented.atlas, &scene.mesh);
  std::vector<Spectrum> irradiance(coordinates.size());
  std::vector<int32_t> pages;
  for (const int32_t chart : ChartOfFace(represented.atlas.set)) {
    pages.push_back(represented.atlas.pageOfChart[static_cast<size_t>(chart)]);
    for (const int32_t point : scene.mesh.triangles[pages.size() - 1]) {
      const auto p = static_cast<size_t>(point);
      irradiance[p] = Lookup(represented.map, pages.back(), coordinates[p]);
    }
  }

  // What its points light.
  const RadiositySolution& points = represented.points;
  AppendMesh(points.mesh, &scene.mesh);
  coordinates.resize(scene.mesh.positions.size(), Vec2f(-1, -1));
  pages.resize(scene.mesh.triangles.size(), 0);
  Append(points.irradiance, &irradiance);

  // As arrays.
  PolyDataFromScene(scene, output);
  output->GetPointData()->AddArray(TextureCoordsArray(coordinates));
  vtkNew<vtkFloatArray> light;
  light->SetName(vtkRadiosityArrays::Irradiance());
  light->SetNumberOfComponents(3);
  light->SetNumberOfTuples(static_cast<vtkIdType>(irradiance.size()));
  for (size_t i = 0; i < irradiance.size(); ++i) {
    light->SetTuple3(static_cast<vtkIdType>(i), irradiance[i].r, irradiance[i].g, irradiance[i].b);
  }
  output->GetPointData()->AddArray(light);
  vtkNew<vtkIntArray> pageId;
  pageId->SetName(vtkRadiosityArrays::PageId());
  pageId->SetNumberOfValues(static_cast<vtkIdType>(pages.size()));
  std::copy(pages.begin(), pages.end(), pageId->GetPointer(0));
  output->GetCellData()->AddArray(pageId);
}

void PolyDataFromAtlas(const RadiosityAtlas& atlas, Scene scene, vtkPolyData* output) {
  const std::vector<Vec2f> coordinates = SplitAtCharts(atlas, &scene.mesh);
  PolyDataFromScene(scene, output);
  output->GetPointData()->AddArray(TextureCoordsArray(coordinates));

  vtkNew<vtkIntArray> charts, pages;
  charts->SetName(vtkRadiosityArrays::ChartId());
  pages->SetName(vtkRadiosityArrays::PageId());
  charts->SetNumberOfValues(scene.mesh.FaceCount());
  pages->SetNumberOfValues(scene.mesh.FaceCount());
  for (size_t i = 0; i < atlas.set.charts.size(); ++i) {
    const Chart& chart = atlas.set.charts[i];
    std::fill_n(charts->GetPointer(chart.firstFace), chart.faceCount, static_cast<int>(i));
    std::fill_n(pages->GetPointer(chart.firstFace), chart.faceCount, atlas.pageOfChart[i]);
  }
  output->GetCellData()->AddArray(charts);
  output->GetCellData()->AddArray(pages);
}
}  // namespace lambert
