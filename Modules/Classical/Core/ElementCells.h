// Pieces of surface about as large as the element size, each of which keeps one irradiance a side.
#pragma once

#include <cstdint>
#include <vector>

#include "Common/Core/Random.h"
#include "Common/Core/TriangleMesh.h"

namespace lambert {

/// A place on one side of a face.
struct SurfacePlace {
  int32_t face = -1;
  Side side = kFront;
  Vec3f position;  ///< world space, m
  Vec3f normal;    ///< unit geometric normal of that side
};

/// Cuts every face into a grid of fragments no larger than the element size. Fragments that are
/// much smaller than an element and lie together on connected faces of one part that face alike
/// share a cell, so that a finely tessellated surface has no more cells than a plain one.
class ElementCells {
 public:
  /// Keeps a reference to `mesh`. `elementSize` in m, above 0. Throws Error where it asks for more
  /// than 50 million fragments.
  ElementCells(const TriangleMesh& mesh, double elementSize);

  int32_t Size() const { return int32_t(cellArea_.size()); }
  /// Cell at a place of a face, given by the weights of its corners 1 and 2.
  int32_t At(int64_t face, const Vec2f& barycentric) const {
    return cellOfFragment_[size_t(FragmentAt(grids_[size_t(face)], barycentric))];
  }
  /// True where the cell has fragments of other faces, or several of one.
  bool IsShared(int32_t cell) const {
    return firstOfCell_[size_t(cell) + 1] - firstOfCell_[size_t(cell)] > 1;
  }
  float Area(int32_t cell) const { return cellArea_[size_t(cell)]; }  ///< m2, of one side
  /// Mean over the cell by area.
  const Spectrum& Reflectance(int32_t cell) const { return cellReflectance_[size_t(cell)]; }
  /// Mean exitance of one side by area, W/m2.
  const Spectrum& Emittance(int32_t cell, Side side) const {
    return cellEmittance_[size_t(cell) * 2 + size_t(side)];
  }
  /// A place uniform over one side of the cell.
  SurfacePlace Sample(int32_t cell, Side side, Random* random) const;
  Vec3f Center(int32_t cell) const;  ///< of its largest fragment, m
  Vec3f Normal(int32_t cell) const;  ///< front normal of the face of its largest fragment

  /// Cells of a face, each named once or more; the sides of a face are lit where one of these is.
  template <class Visit>
  void ForEachCell(int64_t face, const Visit& visit) const {
    const Grid& grid = grids_[size_t(face)];
    for (int32_t i = 0; i < grid.columns * grid.rows; ++i) {
      const int32_t cell = cellOfFragment_[size_t(grid.first + i)];
      if (cell >= 0) visit(cell);
    }
  }

 private:
  /// Corner `origin` has the shortest edge to its second neighbour; columns run along the edge to
  /// the first, rows to the second. Fragments beyond the third edge do not exist.
  struct Grid {
    int32_t first = 0, columns = 1, rows = 1;
    uint8_t origin = 0;
  };
  struct Fragment {
    int32_t face, column, row;
  };

  Grid MakeGrid(int64_t face, double elementSize) const;
  static int32_t FragmentAt(const Grid& grid, const Vec2f& barycentric);
  static double ShareOfFace(const Grid& grid, int32_t column, int32_t row);
  Vec3f PointAt(int64_t face, double a, double b) const;
  Vec3f FragmentCenter(const Fragment& fragment) const;
  void GroupFragments(double elementSize, const std::vector<float>& areas);
  void ListFragments(const std::vector<float>& areas);

  const TriangleMesh& mesh_;
  std::vector<Grid> grids_;              ///< per face
  std::vector<Fragment> fragments_;      ///< of all faces, row by row
  std::vector<int32_t> cellOfFragment_;  ///< -1: does not exist
  std::vector<float> cellArea_;
  std::vector<Spectrum> cellReflectance_;
  std::vector<Spectrum> cellEmittance_;                 ///< front, back
  std::vector<int32_t> firstOfCell_, fragmentsOfCell_;  ///< the largest first
  std::vector<float> areaUpTo_;                         ///< over the fragments of each cell
};

}  // namespace lambert
