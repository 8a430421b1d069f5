// A scene in pieces, a vtkPolyData a part, as collections hold it. C++ only.
#ifndef vtkScenePieces_h
#define vtkScenePieces_h

#include "lambertSceneModule.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkPolyData;

namespace lambert {
/// The parts of a scene that a vtkPolyData of polygons carries, in the order of the part table; one
/// that no face is of is an empty piece.
class LAMBERTSCENE_EXPORT ScenePieces {
 public:
  /// Throws Error where PartId or MaterialId names no row of its table.
  explicit ScenePieces(vtkPolyData* scene);
  ~ScenePieces();
  ScenePieces(const ScenePieces&) = delete;
  ScenePieces& operator=(const ScenePieces&) = delete;

  size_t Count() const { return this->cells_.size(); }
  std::vector<std::string> PartNames() const;

  /// Fills `piece` with the faces of a part and the points that they use, in the scene's order, and
  /// all their arrays, whose ids stay those of the scene. Of the tables it has the part's own row
  /// and the rows of its materials, with Part.Row and Material.Row, their numbers in the scene;
  /// lights, camera and atlas whole. Materials that no face has go with the first piece.
  void Take(size_t part, vtkPolyData* piece);

 private:
  /// Gives it the faces of the part, and returns the points that they use.
  std::vector<vtkIdType> TakeFaces(size_t part, vtkPolyData* piece);
  /// Rows of the materials that go with the part.
  std::vector<int> MaterialsOf(size_t part) const;

  vtkSmartPointer<vtkPolyData> scene_;
  std::vector<std::vector<vtkIdType>> cells_;  ///< of each part
  std::vector<int> materialOfCell_;
  std::vector<bool> isUsed_;             ///< of each material, by a face
  std::vector<vtkIdType> pointOfPiece_;  ///< by point of the scene; -1 but while a piece is taken
};
}  // namespace lambert

#endif
