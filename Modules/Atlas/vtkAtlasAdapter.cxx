#include "vtkAtlasAdapter.h"

#include "vtkCellData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRadiosityArrays.h"
#include "vtkSceneAdapter.h"
#include "vtkValueArrays.h"

#include <algorithm>

namespace lambert {
void PolyDataFromRepresentedScene(const RepresentedScene& represented, Scene scene,
                                  vtkPolyData* output) {
  RepresentedMesh joined = JoinRepresentations(represented);
  scene.mesh = std::move(joined.mesh);
  PolyDataFromScene(scene, output);
  using Names = vtkRadiosityArrays;
  vtkPointData* points = output->GetPointData();
  points->AddArray(ArrayFromTuples(Names::LightMapTCoords(), joined.lightMapCoords));
  points->AddArray(ArrayFromTuples(Names::Irradiance(), joined.irradiance));
  output->GetCellData()->AddArray(ArrayFromNumbers<vtkIntArray>(Names::PageId(), joined.page));
}

void PolyDataFromAtlas(const RadiosityAtlas& atlas, Scene scene, vtkPolyData* output) {
  const std::vector<Vec2f> coordinates = SplitAtCharts(atlas, &scene.mesh);
  PolyDataFromScene(scene, output);
  output->GetPointData()->AddArray(
      ArrayFromTuples(vtkRadiosityArrays::LightMapTCoords(), coordinates));

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
