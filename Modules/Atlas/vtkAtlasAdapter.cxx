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
void PolyDataFromAtlas(const RadiosityAtlas& atlas, Scene scene, vtkPolyData* output) {
  const std::vector<Vec2f> coordinates = SplitAtCharts(atlas, &scene.mesh);
  PolyDataFromScene(scene, output);

  vtkNew<vtkFloatArray> textureCoords;
  textureCoords->SetName(vtkRadiosityArrays::LightMapTCoords());
  textureCoords->SetNumberOfComponents(2);
  textureCoords->SetNumberOfTuples(static_cast<vtkIdType>(coordinates.size()));
  for (size_t i = 0; i < coordinates.size(); ++i) {
    textureCoords->SetTuple2(static_cast<vtkIdType>(i), coordinates[i].x, coordinates[i].y);
  }
  output->GetPointData()->AddArray(textureCoords);

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
