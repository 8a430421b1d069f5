#include "AtlasFile.h"

#include "Atlas/vtkAtlasAdapter.h"
#include "Common/Core/Error.h"
#include "Scene/vtkStoredPieces.h"
#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRadiosityArrays.h"
#include "vtkValueArrays.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>

namespace lambert {
namespace {
/// Where each face of a mesh in pieces stands in the whole: surface after surface, of either side,
/// by their charts; then what has none.
std::vector<vtkIdType> OrderOfFaces(vtkPolyData* mesh) {
  using Names = vtkRadiosityArrays;
  const size_t faces = static_cast<size_t>(mesh->GetNumberOfCells());
  const auto numbers = [&](const char* name) {
    return NumbersFromArray<int32_t>(
        RequireArray(mesh->GetCellData(), name, 1, faces, "mesh", "the output of lambert atlas"));
  };
  const std::vector<int32_t> surfaces = numbers(Names::SurfaceId()),
                             charts = numbers(Names::ChartId());
  const bool hasSides = mesh->GetCellData()->HasArray(Names::Side()) != 0;
  const std::vector<int32_t> sides =
      hasSides ? numbers(Names::Side()) : std::vector<int32_t>(faces, 0);

  std::map<std::array<int32_t, 2>, int32_t> firstChart;
  for (size_t face = 0; face < faces; ++face) {
    if (charts[face] < 0) continue;
    int32_t& first =
        firstChart.try_emplace({surfaces[face], sides[face]}, charts[face]).first->second;
    first = std::min(first, charts[face]);
  }
  std::vector<int32_t> rank(faces, std::numeric_limits<int32_t>::max());
  for (size_t face = 0; face < faces; ++face) {
    if (charts[face] >= 0) rank[face] = firstChart.at({surfaces[face], sides[face]});
  }
  std::vector<vtkIdType> order(faces);
  std::iota(order.begin(), order.end(), vtkIdType(0));
  std::stable_sort(order.begin(), order.end(), [&](vtkIdType a, vtkIdType b) {
    return rank[static_cast<size_t>(a)] < rank[static_cast<size_t>(b)];
  });
  return order;
}

/// The mesh that was written in pieces.
vtkSmartPointer<vtkPolyData> JoinPieces(const std::vector<vtkSmartPointer<vtkPolyData>>& pieces) {
  vtkNew<vtkAppendPolyData> append;
  for (vtkPolyData* piece : pieces) append->AddInputData(piece);
  append->Update();
  vtkPolyData* all = append->GetOutput();

  // Its faces in their order.
  vtkNew<vtkCellArray> polygons;
  auto joined = vtkSmartPointer<vtkPolyData>::New();
  joined->GetCellData()->CopyAllOn();
  joined->GetCellData()->CopyAllocate(all->GetCellData(), all->GetNumberOfCells());
  for (const vtkIdType face : OrderOfFaces(all)) {
    vtkIdType count = 0;
    const vtkIdType* points = nullptr;
    all->GetCellPoints(face, count, points);
    joined->GetCellData()->CopyData(all->GetCellData(), face,
                                    polygons->InsertNextCell(count, points));
  }
  joined->SetPolys(polygons);
  joined->SetPoints(all->GetPoints());
  joined->GetPointData()->ShallowCopy(all->GetPointData());
  joined->GetFieldData()->ShallowCopy(pieces.front()->GetFieldData());
  return joined;
}
}  // namespace

StoredAtlas ReadAtlas(const std::string& fileName, std::vector<std::string>* pieces) {
  std::vector<vtkSmartPointer<vtkPolyData>> meshes;
  for (const StoredPiece& piece : FindStoredPieces(fileName)) {
    meshes.push_back(ReadStoredPiece(piece));
    if (pieces && !piece.collection.empty()) pieces->push_back(piece.file);
  }
  try {
    return StoredAtlasFromPolyData(meshes.size() == 1 ? meshes.front() : JoinPieces(meshes));
  } catch (const Error& error) {
    throw Error("The file '" + fileName + "' holds no atlas of a scene: " + error.what());
  }
}
}  // namespace lambert
