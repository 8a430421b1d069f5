#include "vtkScenePieces.h"

#include "Common/Core/Error.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRadiosityArrays.h"
#include "vtkStringArray.h"
#include "vtkValueArrays.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace lambert {
namespace {
using Names = vtkRadiosityArrays;

size_t RowsOf(vtkPolyData* scene, const char* column) {
  vtkAbstractArray* array = scene->GetFieldData()->GetAbstractArray(column);
  return array ? static_cast<size_t>(array->GetNumberOfTuples()) : 0;
}

/// The rows of a table that the cells name.
std::vector<int> RowsOfCells(vtkPolyData* scene, const char* name, size_t rows) {
  std::vector<int> ids = NumbersFromArray<int>(
      RequireArray(scene->GetCellData(), name, 1, static_cast<size_t>(scene->GetNumberOfCells()),
                   "scene", "a solved scene as it is"));
  for (const int id : ids) {
    if (id < 0 || static_cast<size_t>(id) >= rows) {
      throw Error(std::string("The array ") + name + " has the entry " + std::to_string(id) +
                  ", and its table " + std::to_string(rows) + " rows.");
    }
  }
  return ids;
}

vtkSmartPointer<vtkIdList> ListOf(const std::vector<vtkIdType>& ids) {
  auto list = vtkSmartPointer<vtkIdList>::New();
  list->SetNumberOfIds(static_cast<vtkIdType>(ids.size()));
  std::copy(ids.begin(), ids.end(), list->GetPointer(0));
  return list;
}

void TakeTuples(vtkDataSetAttributes* from, const std::vector<vtkIdType>& ids,
                vtkDataSetAttributes* to) {
  to->CopyAllOn();
  to->CopyAllocate(from, static_cast<vtkIdType>(ids.size()));
  std::vector<vtkIdType> places(ids.size());
  std::iota(places.begin(), places.end(), 0);
  to->CopyData(from, ListOf(ids), ListOf(places));
}

bool IsColumnOf(const std::string& table, vtkAbstractArray* array) {
  return array->GetName() && std::string(array->GetName()).rfind(table, 0) == 0;
}

/// Some rows of the table whose columns begin with `table`, and which they are.
void TakeRows(vtkFieldData* from, const std::string& table, const std::vector<int>& rows,
              const char* rowColumn, vtkFieldData* to) {
  for (int column = 0; column < from->GetNumberOfArrays(); ++column) {
    vtkAbstractArray* all = from->GetAbstractArray(column);
    if (!IsColumnOf(table, all)) continue;
    auto some = vtk::TakeSmartPointer(all->NewInstance());
    some->SetName(all->GetName());
    some->SetNumberOfComponents(all->GetNumberOfComponents());
    some->SetNumberOfTuples(static_cast<vtkIdType>(rows.size()));
    for (size_t row = 0; row < rows.size(); ++row) {
      some->SetTuple(static_cast<vtkIdType>(row), rows[row], all);
    }
    to->AddArray(some);
  }
  to->AddArray(ArrayFromNumbers<vtkIntArray>(rowColumn, rows));
}

constexpr const char* kMaterials = "Material.";
constexpr const char* kParts = "Part.";
}  // namespace

ScenePieces::ScenePieces(vtkPolyData* scene)
    : scene_(scene),
      cells_(RowsOf(scene, Names::PartName())),
      materialOfCell_(
          RowsOfCells(scene, Names::MaterialId(), RowsOf(scene, Names::MaterialName()))),
      isUsed_(RowsOf(scene, Names::MaterialName())),
      pointOfPiece_(static_cast<size_t>(scene->GetNumberOfPoints()), -1) {
  const std::vector<int> parts = RowsOfCells(scene, Names::PartId(), this->cells_.size());
  for (size_t cell = 0; cell < parts.size(); ++cell) {
    this->cells_[static_cast<size_t>(parts[cell])].push_back(static_cast<vtkIdType>(cell));
    this->isUsed_[static_cast<size_t>(this->materialOfCell_[cell])] = true;
  }
}

ScenePieces::~ScenePieces() = default;

std::vector<std::string> ScenePieces::PartNames() const {
  auto* array = vtkStringArray::SafeDownCast(
      this->scene_->GetFieldData()->GetAbstractArray(vtkRadiosityArrays::PartName()));
  std::vector<std::string> names(this->Count());
  for (size_t part = 0; array && part < names.size(); ++part) {
    names[part] = array->GetValue(static_cast<vtkIdType>(part));
  }
  return names;
}

std::vector<vtkIdType> ScenePieces::TakeFaces(size_t part, vtkPolyData* piece) {
  // Points that the faces use.
  const std::vector<vtkIdType>& cells = this->cells_[part];
  vtkCellArray* faces = this->scene_->GetPolys();
  vtkNew<vtkIdList> corners;
  std::vector<vtkIdType> points;
  for (const vtkIdType cell : cells) {
    faces->GetCellAtId(cell, corners);
    for (const vtkIdType point : *corners) {
      vtkIdType& number = this->pointOfPiece_[static_cast<size_t>(point)];
      if (number < 0) points.push_back(point);
      number = 0;
    }
  }
  std::sort(points.begin(), points.end());
  for (size_t number = 0; number < points.size(); ++number) {
    this->pointOfPiece_[static_cast<size_t>(points[number])] = static_cast<vtkIdType>(number);
  }

  // Faces on them.
  vtkNew<vtkCellArray> polys;
  polys->AllocateEstimate(static_cast<vtkIdType>(cells.size()), 3);
  for (const vtkIdType cell : cells) {
    faces->GetCellAtId(cell, corners);
    for (vtkIdType& point : *corners) {
      point = this->pointOfPiece_[static_cast<size_t>(point)];
    }
    polys->InsertNextCell(corners);
  }
  for (const vtkIdType point : points) {
    this->pointOfPiece_[static_cast<size_t>(point)] = -1;
  }
  piece->SetPolys(polys);
  return points;
}

std::vector<int> ScenePieces::MaterialsOf(size_t part) const {
  std::set<int> materials;
  for (const vtkIdType cell : this->cells_[part]) {
    materials.insert(this->materialOfCell_[static_cast<size_t>(cell)]);
  }
  for (size_t material = 0; part == 0 && material < this->isUsed_.size(); ++material) {
    if (!this->isUsed_[material]) materials.insert(static_cast<int>(material));
  }
  return std::vector<int>(materials.begin(), materials.end());
}

void ScenePieces::Take(size_t part, vtkPolyData* piece) {
  piece->Initialize();

  // Faces and the points that they use, with what these carry.
  const std::vector<vtkIdType> points = this->TakeFaces(part, piece);
  vtkNew<vtkPoints> positions;
  positions->SetDataType(this->scene_->GetPoints()->GetDataType());
  this->scene_->GetPoints()->GetPoints(ListOf(points), positions);
  piece->SetPoints(positions);
  TakeTuples(this->scene_->GetPointData(), points, piece->GetPointData());
  TakeTuples(this->scene_->GetCellData(), this->cells_[part], piece->GetCellData());

  // Tables.
  vtkFieldData *all = this->scene_->GetFieldData(), *own = piece->GetFieldData();
  TakeRows(all, kMaterials, this->MaterialsOf(part), vtkRadiosityArrays::MaterialRow(), own);
  TakeRows(all, kParts, {static_cast<int>(part)}, vtkRadiosityArrays::PartRow(), own);
  for (int column = 0; column < all->GetNumberOfArrays(); ++column) {
    vtkAbstractArray* array = all->GetAbstractArray(column);
    if (!IsColumnOf(kMaterials, array) && !IsColumnOf(kParts, array)) own->AddArray(array);
  }
}
}  // namespace lambert
