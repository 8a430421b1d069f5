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

/// An edge whose two faces share its points. Corner `from` of either lies where corner `from` of
/// the other does, and so does `to`.
struct SharedEdge {
  std::array<size_t, 2> faces, from, to;
};

/// Calls `visit(SharedEdge)` once for every edge within a surface whose faces share its points: no
/// crease lies there. `neighbours` as FindNeighbours gives them.
template <class Visit>
void ForEachSharedEdge(const TriangleMesh& mesh, const std::vector<int32_t>& neighbours,
                       const Visit& visit) {
  for (size_t corner = 0; corner < neighbours.size(); ++corner) {
    if (neighbours[corner] <= int32_t(corner)) continue;
    const size_t other = size_t(neighbours[corner]);
    const SharedEdge edge = {
        {corner / 3, other / 3}, {corner % 3, (other + 1) % 3}, {(corner + 1) % 3, other % 3}};
    const auto point = [&](size_t side, size_t c) { return mesh.triangles[edge.faces[side]][c]; };
    if (point(0, edge.from[0]) != point(1, edge.from[1])) continue;
    if (point(0, edge.to[0]) != point(1, edge.to[1])) continue;
    visit(edge);
  }
}

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

/// Where the corners of a chart of one face lie in the plane, m; that it has no area does no harm.
std::vector<Vec2d> MapOfFace(const ChartMesh& chart);

/// Of all triangles, each with its normal, m2.
Vec3d VectorAreaOf(const ChartMesh& mesh);
/// m2.
double AreaOf(const ChartMesh& mesh);

}  // namespace lambert
