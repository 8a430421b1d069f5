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
#include <numeric>

namespace lambert {
namespace {
/// Where each face of a mesh in pieces stands in the whole: surface after surface.
std::vector<vtkIdType> OrderOfFaces(vtkPolyData* mesh) {
  const size_t faces = static_cast<size_t>(mesh->GetNumberOfCells());
  const std::vector<int32_t> surfaces =
      NumbersFromArray<int32_t>(RequireArray(mesh->GetCellData(), vtkRadiosityArrays::SurfaceId(),
                                             1, faces, "mesh", "the output of lambert atlas"));
  std::vector<vtkIdType> order(faces);
  std::iota(order.begin(), order.end(), vtkIdType(0));
  std::stable_sort(order.begin(), order.end(), [&](vtkIdType a, vtkIdType b) {
    return surfaces[static_cast<size_t>(a)] < surfaces[static_cast<size_t>(b)];
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
