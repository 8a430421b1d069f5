#include "vtkTriangleMeshAdapter.h"

#include "Common/Core/Error.h"
#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkCellData.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRadiosityArrays.h"
#include "vtkUnsignedCharArray.h"
#include "vtkValueArrays.h"

#include <algorithm>
#include <limits>

namespace lambert {
namespace {
template <class Array, class T>
void WriteScalars(vtkDataSetAttributes* data, const char* name, const std::vector<T>& values) {
  if (values.empty()) {
    return;
  }
  data->AddArray(ArrayFromNumbers<Array>(name, values));
}

/// Reflectance is clamped to [0, 0.98]; emittance that makes no sense is an error.
void BringIntoRange(TriangleMesh* mesh) {
  for (size_t face = 0; face < mesh->reflectance.size(); ++face) {
    Spectrum& reflectance = mesh->reflectance[face];
    if (!reflectance.IsFinite()) {
      throw Error("Cell " + std::to_string(face) +
                  " has a reflectance that is not a finite number; repair the input.");
    }
    for (int band = 0; band < 3; ++band) {
      reflectance[band] = std::min(kMaximumReflectance, std::max(0.f, reflectance[band]));
    }
  }
  for (size_t face = 0; face < mesh->emittance.size(); ++face) {
    const Spectrum& emittance = mesh->emittance[face];
    if (!emittance.IsFinite() || std::min({emittance.r, emittance.g, emittance.b}) < 0) {
      throw Error("Cell " + std::to_string(face) +
                  " has an emittance that is negative or not a finite number; repair the input.");
    }
  }
}
}  // namespace

TriangleMesh TriangleMeshFromPolyData(vtkPolyData* input) {
  TriangleMesh mesh;
  if (!input || !input->GetPoints()) {
    return mesh;
  }

  // Points.
  vtkPointData* pointData = input->GetPointData();
  if (input->GetNumberOfPoints() > std::numeric_limits<int32_t>::max()) {
    throw Error("The data has more than 2^31 points; split it.");
  }
  mesh.positions = TuplesFromArray<Vec3f>(input->GetPoints()->GetData(), "Points");
  mesh.normals = TuplesFromArray<Vec3f>(pointData->GetNormals(), "Normals");
  mesh.uvs = TuplesFromArray<Vec2f>(pointData->GetTCoords(), "TCoords");

  // Faces.
  vtkCellArray* polys = input->GetPolys();
  if (input->GetNumberOfCells() != polys->GetNumberOfCells()) {
    throw Error(
        "The data holds vertices, lines or strips beside its polygons; run vtkTriangleFilter "
        "and keep its polygons only.");
  }
  mesh.triangles.reserve(static_cast<size_t>(polys->GetNumberOfCells()));
  auto cell = vtk::TakeSmartPointer(polys->NewIterator());
  for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell()) {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    cell->GetCurrentCell(count, ids);
    if (count != 3) {
      throw Error("Cell " + std::to_string(cell->GetCurrentCellId()) + " has " +
                  std::to_string(count) + " points; run vtkTriangleFilter first.");
    }
    mesh.triangles.push_back(
        {static_cast<int32_t>(ids[0]), static_cast<int32_t>(ids[1]), static_cast<int32_t>(ids[2])});
  }
  vtkCellData* cellData = input->GetCellData();
  using Names = vtkRadiosityArrays;
  mesh.reflectance =
      TuplesFromArray<Spectrum>(cellData->GetArray(Names::Reflectance()), Names::Reflectance());
  mesh.emittance =
      TuplesFromArray<Spectrum>(cellData->GetArray(Names::Emittance()), Names::Emittance());
  mesh.faceFlags = NumbersFromArray<uint8_t>(cellData->GetArray(Names::FaceFlags()));
  mesh.materialId = NumbersFromArray<int32_t>(cellData->GetArray(Names::MaterialId()));
  mesh.partId = NumbersFromArray<int32_t>(cellData->GetArray(Names::PartId()));
  mesh.surfaceId = NumbersFromArray<int32_t>(cellData->GetArray(Names::SurfaceId()));
  mesh.sourceCellId = NumbersFromArray<int64_t>(cellData->GetArray(Names::SourceCellId()));
  BringIntoRange(&mesh);
  mesh.Complete();
  return mesh;
}

void PolyDataFromTriangleMesh(const TriangleMesh& mesh, vtkPolyData* output) {
  output->Initialize();

  // Points.
  vtkNew<vtkPoints> points;
  points->SetData(ArrayFromTuples("Points", mesh.positions));
  output->SetPoints(points);
  if (!mesh.normals.empty()) {
    output->GetPointData()->SetNormals(ArrayFromTuples("Normals", mesh.normals));
  }
  if (!mesh.uvs.empty()) {
    output->GetPointData()->SetTCoords(ArrayFromTuples("TCoords", mesh.uvs));
  }

  // Faces.
  vtkNew<vtkIdTypeArray> offsets, connectivity;
  const vtkIdType faces = mesh.FaceCount();
  offsets->SetNumberOfValues(faces + 1);
  connectivity->SetNumberOfValues(3 * faces);
  for (vtkIdType face = 0; face <= faces; ++face) {
    offsets->SetValue(face, 3 * face);
  }
  for (vtkIdType face = 0; face < faces; ++face) {
    for (int corner = 0; corner < 3; ++corner) {
      connectivity->SetValue(
          3 * face + corner,
          mesh.triangles[static_cast<size_t>(face)][static_cast<size_t>(corner)]);
    }
  }
  vtkNew<vtkCellArray> polys;
  polys->SetData(offsets, connectivity);
  output->SetPolys(polys);

  // What light needs to know of each face.
  vtkCellData* cellData = output->GetCellData();
  using Names = vtkRadiosityArrays;
  if (!mesh.reflectance.empty()) {
    cellData->AddArray(ArrayFromTuples(Names::Reflectance(), mesh.reflectance));
  }
  if (!mesh.emittance.empty()) {
    cellData->AddArray(ArrayFromTuples(Names::Emittance(), mesh.emittance));
  }
  WriteScalars<vtkUnsignedCharArray>(cellData, Names::FaceFlags(), mesh.faceFlags);
  WriteScalars<vtkIntArray>(cellData, Names::MaterialId(), mesh.materialId);
  WriteScalars<vtkIntArray>(cellData, Names::PartId(), mesh.partId);
  WriteScalars<vtkIntArray>(cellData, Names::SurfaceId(), mesh.surfaceId);
  WriteScalars<vtkIdTypeArray>(cellData, Names::SourceCellId(), mesh.sourceCellId);
}
}  // namespace lambert
