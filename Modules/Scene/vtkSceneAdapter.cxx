#include "vtkSceneAdapter.h"

#include "Common/Core/Error.h"
#include "Scene/Core/PointNormals.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRadiosityArrays.h"
#include "vtkSceneTables.h"
#include "vtkTriangleFilter.h"
#include "vtkTriangleMeshAdapter.h"
#include "vtkUnsignedCharArray.h"
#include "vtkValueArrays.h"

#include <algorithm>
#include <map>

namespace lambert {
namespace {
using Names = vtkRadiosityArrays;

bool IsAllTriangles(vtkPolyData* input) {
  return input->GetNumberOfCells() == input->GetNumberOfPolys() &&
         (input->GetNumberOfPolys() == 0 || input->GetPolys()->IsHomogeneous() == 3);
}

/// The polygons and strips of `input` as triangles that know the cell they came from.
vtkSmartPointer<vtkPolyData> Triangulate(vtkPolyData* input) {
  vtkNew<vtkPolyData> numbered;
  numbered->ShallowCopy(input);
  if (!numbered->GetCellData()->GetArray(Names::SourceCellId())) {
    vtkNew<vtkIdTypeArray> ids;
    ids->SetName(Names::SourceCellId());
    ids->SetNumberOfValues(input->GetNumberOfCells());
    for (vtkIdType cell = 0; cell < input->GetNumberOfCells(); ++cell) {
      ids->SetValue(cell, cell);
    }
    numbered->GetCellData()->AddArray(ids);
  }
  vtkNew<vtkTriangleFilter> triangulation;
  triangulation->SetInputData(numbered);
  triangulation->PassVertsOff();
  triangulation->PassLinesOff();
  triangulation->Update();
  return triangulation->GetOutput();
}

/// Gives `table` as many default rows as `ids` name, at least one. Throws Error for a negative id.
template <class Row>
void CoverIds(const std::vector<int32_t>& ids, const char* name, std::vector<Row>* table) {
  const auto [low, high] = std::minmax_element(ids.begin(), ids.end());
  if (low != ids.end() && *low < 0) {
    throw Error(std::string("The array ") + name + " has the entry " + std::to_string(*low) +
                "; rows are numbered from 0.");
  }
  const size_t rows = high != ids.end() ? static_cast<size_t>(*high) + 1 : 1;
  table->resize(std::max({table->size(), rows, size_t{1}}));
}

/// Numbers rows of the scene's table as they stand in that of a piece, whose `rowArray` names them.
/// Throws Error where a row is not there.
void NumberAsInPiece(vtkFieldData* fields, const char* rowArray, const char* idArray, size_t rows,
                     std::vector<int32_t>* ids) {
  vtkDataArray* array = fields->GetArray(rowArray);
  if (!array) {
    return;
  }
  lambert::RequireArray(fields, rowArray, 1, rows, "piece", "a piece of a VTPC file as it is");
  const std::vector<int32_t> ofScene = NumbersFromArray<int32_t>(array);
  std::map<int32_t, int32_t> ofPiece;
  for (size_t row = 0; row < ofScene.size(); ++row) {
    ofPiece.emplace(ofScene[row], static_cast<int32_t>(row));
  }
  for (int32_t& id : *ids) {
    const auto row = ofPiece.find(id);
    if (row == ofPiece.end()) {
      throw Error(std::string("The array ") + idArray + " has the entry " + std::to_string(id) +
                  ", which no row of " + rowArray + " has; take the piece as it was written.");
    }
    id = row->second;
  }
}

vtkDataArray* RequireArray(vtkFieldData* data, const char* name, int components, size_t count) {
  return lambert::RequireArray(data, name, components, count, "solution",
                               "output port 0 of a radiosity method");
}
}  // namespace

Scene SceneAsStoredInPolyData(vtkPolyData* input) {
  Scene scene;
  if (!input) {
    return scene;
  }
  scene.mesh = TriangleMeshFromPolyData(IsAllTriangles(input) ? input : Triangulate(input).Get());
  vtkFieldData* fields = input->GetFieldData();
  ReadSceneTables(fields, &scene);
  NumberAsInPiece(fields, Names::MaterialRow(), Names::MaterialId(), scene.materials.size(),
                  &scene.mesh.materialId);
  NumberAsInPiece(fields, Names::PartRow(), Names::PartId(), scene.parts.size(),
                  &scene.mesh.partId);
  CoverIds(scene.mesh.materialId, Names::MaterialId(), &scene.materials);
  CoverIds(scene.mesh.partId, Names::PartId(), &scene.parts);
  return scene;
}

Scene SceneFromPolyData(vtkPolyData* input, double featureAngle,
                        std::vector<std::array<int32_t, 3>>* storedTriangles) {
  Scene scene = SceneAsStoredInPolyData(input);
  if (storedTriangles) {
    *storedTriangles = scene.mesh.triangles;
  }
  if (!HasUnitNormals(scene.mesh)) {
    MeshTopology topology = ConnectFaces(scene.mesh);
    CompletePointNormals(featureAngle, &scene.mesh, &topology);
  }
  return scene;
}

void PolyDataFromScene(const Scene& scene, vtkPolyData* output) {
  PolyDataFromTriangleMesh(scene.mesh, output);
  WriteSceneTables(scene, output->GetFieldData());
}

void PolyDataFromSolution(const RadiositySolution& solution, const Scene& scene,
                          vtkPolyData* output) {
  PolyDataFromTriangleMesh(solution.mesh, output);
  vtkCellData* cells = output->GetCellData();
  cells->AddArray(ArrayFromNumbers<vtkIdTypeArray>(Names::InputFaceId(), solution.inputFaceId));
  cells->AddArray(ArrayFromNumbers<vtkUnsignedCharArray>(Names::Side(), solution.side));
  if (!solution.leafId.empty()) {
    cells->AddArray(ArrayFromNumbers<vtkIdTypeArray>(Names::LeafId(), solution.leafId));
  }
  output->GetPointData()->AddArray(ArrayFromTuples(Names::Irradiance(), solution.irradiance));
  output->GetPointData()->AddArray(ArrayFromTuples(Names::Radiosity(), solution.radiosity));
  WriteSceneTables(scene, output->GetFieldData());
}

std::vector<uint8_t> SidesFromArray(vtkDataArray* array) {
  const std::vector<int> numbers = NumbersFromArray<int>(array);
  for (const int side : numbers) {
    if (side != kFront && side != kBack) {
      throw Error(std::string("The array ") + Names::Side() + " has the entry " +
                  std::to_string(side) + "; a side is 0, the front, or 1, the back.");
    }
  }
  return std::vector<uint8_t>(numbers.begin(), numbers.end());
}

RadiositySolution SolutionFromPolyData(vtkPolyData* input) {
  RadiositySolution solution;
  solution.mesh = TriangleMeshFromPolyData(input);
  const size_t faces = solution.mesh.triangles.size(), points = solution.mesh.positions.size();
  vtkCellData* cells = input->GetCellData();
  vtkPointData* pointData = input->GetPointData();
  solution.inputFaceId =
      NumbersFromArray<int64_t>(RequireArray(cells, Names::InputFaceId(), 1, faces));
  solution.side = SidesFromArray(RequireArray(cells, Names::Side(), 1, faces));
  solution.irradiance = TuplesFromArray<Spectrum>(
      RequireArray(pointData, Names::Irradiance(), 3, points), Names::Irradiance());
  solution.radiosity = TuplesFromArray<Spectrum>(
      RequireArray(pointData, Names::Radiosity(), 3, points), Names::Radiosity());
  for (const int64_t face : solution.inputFaceId) {
    if (face < 0) throw Error("The solution names a face below 0; it takes a method's output.");
  }
  for (size_t point = 0; point < points; ++point) {
    if (solution.irradiance[point].IsFinite() && solution.radiosity[point].IsFinite()) continue;
    throw Error("The light at point " + std::to_string(point) +
                " of the solution is not a finite number; repair it.");
  }
  return solution;
}
}  // namespace lambert
