// The faces of a cluster as a surface of their own: which of them are neighbours, and where it
// ends.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "Common/Core/TriangleMesh.h"

namespace lambert {

/// By corner (corner c of face f is 3 f + c, where the edge to the next corner begins): the corner
/// of the neighbour where the same edge begins, the other way round. -1 where there is none on the
/// same surface, several, or one that winds against it. Points count as one where their positions
/// do. Throws Error for a mesh without surfaces.
std::vector<int32_t> FindNeighbours(const TriangleMesh& mesh);

/// Corners are one vertex where edges join them: where faces meet in a point alone, each has its
/// own.
struct ChartMesh {
  std::vector<Vec3d> positions;                   ///< m, by vertex
  std::vector<std::array<int32_t, 3>> triangles;  ///< by face of the chart: vertices
  /// Closed border lines: vertices in the order of the triangles' edges.
  std::vector<std::vector<int32_t>> borders;
  bool isConnected = false;
  int64_t genus = 0;  ///< handles, where it is connected

  /// It can be laid flat: one piece with a border and without handles. Holes do no harm.
  bool IsFlat() const { return isConnected && genus == 0 && !borders.empty(); }
};

/// Of `faces`, ascending; `neighbours` as FindNeighbours gives them.
ChartMesh MakeChartMesh(const TriangleMesh& mesh, const std::vector<int32_t>& neighbours,
                        const std::vector<int32_t>& faces);
/// Numbers [first, first + count).
std::vector<int32_t> FacesFrom(int32_t first, int32_t count);

/// A triangle in its own plane: its longest edge from vertex `first` along x, and the place of the
/// vertex that lies opposite.
struct FlatTriangle {
  int first = 0;
  double length = 0;  ///< of the longest edge, m
  double x = 0, height = 0;
  /// So thin that its shape tells nothing.
  bool IsSliver() const { return height < 1e-3 * length; }
};
FlatTriangle Flatten(const ChartMesh& chart, size_t triangle);

}  // namespace lambert
