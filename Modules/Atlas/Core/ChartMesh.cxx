#include "Atlas/Core/ChartMesh.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "Common/Core/DisjointSets.h"
#include "Common/Core/Error.h"
#include "Scene/Core/MeshTopology.h"

namespace lambert {

namespace {

int32_t NextCorner(int32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

/// Lines from vertex to vertex; `next` by vertex, -1 where it is on none.
std::vector<std::vector<int32_t>> ClosedLines(std::vector<int32_t> next) {
  std::vector<std::vector<int32_t>> lines;
  for (size_t vertex = 0; vertex < next.size(); ++vertex) {
    if (next[vertex] < 0) continue;
    std::vector<int32_t> line;
    for (int32_t v = int32_t(vertex); next[size_t(v)] >= 0;) {
      line.push_back(v);
      std::swap(v, next[size_t(v)]);
      next[size_t(line.back())] = -1;
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace

std::vector<int32_t> FindNeighbours(const TriangleMesh& mesh) {
  if (mesh.surfaceId.size() != mesh.triangles.size()) {
    throw Error("The mesh lacks surface numbers; make them with ClusterFaces.");
  }
  // Edges side by side that have the same ends.
  struct Edge {
    int32_t surface, low, high, corner;
    bool isForward;
    bool IsAlong(const Edge& other) const {
      return surface == other.surface && low == other.low && high == other.high;
    }
  };
  const std::vector<int32_t> joined = PositionIds(mesh);
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (size_t face = 0; face < mesh.triangles.size(); ++face) {
    for (size_t c = 0; c < 3; ++c) {
      const int32_t from = joined[size_t(mesh.triangles[face][c])];
      const int32_t to = joined[size_t(mesh.triangles[face][(c + 1) % 3])];
      if (from == to) continue;
      edges.push_back({mesh.surfaceId[face], std::min(from, to), std::max(from, to),
                       int32_t(3 * face + c), from < to});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::tie(a.surface, a.low, a.high, a.corner) <
           std::tie(b.surface, b.low, b.high, b.corner);
  });

  // Two that run against each other join their faces.
  std::vector<int32_t> neighbours(3 * mesh.triangles.size(), -1);
  for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end].IsAlong(edges[begin])) ++end;
    if (end - begin != 2 || edges[begin].isForward == edges[begin + 1].isForward) continue;
    neighbours[size_t(edges[begin].corner)] = edges[begin + 1].corner;
    neighbours[size_t(edges[begin + 1].corner)] = edges[begin].corner;
  }
  return neighbours;
}

ChartMesh MakeChartMesh(const TriangleMesh& mesh, const std::vector<int32_t>& neighbours,
                        const std::vector<int32_t>& faces) {
  // Corners of the mesh, by their number within the chart and back; those of its faces alone.
  ChartMesh chart;
  const int32_t faceCount = int32_t(faces.size()), corners = 3 * faceCount;
  const auto cornerOfMesh = [&](int32_t corner) {
    return size_t(3 * faces[size_t(corner / 3)] + corner % 3);
  };
  const auto neighbour = [&](int32_t corner) {
    const int32_t other = neighbours[cornerOfMesh(corner)];
    if (other < faces.front() * 3) return -1;
    // Most often they stand side by side.
    int32_t face = other / 3 - faces.front();
    if (face >= faceCount || faces[size_t(face)] != other / 3) {
      face = int32_t(std::lower_bound(faces.begin(), faces.end(), other / 3) - faces.begin());
    }
    return face < faceCount && faces[size_t(face)] == other / 3 ? face * 3 + other % 3 : -1;
  };

  // Corners at both ends of an inner edge are one vertex.
  DisjointSets vertices{size_t(corners)}, pieces{size_t(faceCount)};
  int64_t innerEdges = 0, pieceCount = faceCount;
  for (int32_t corner = 0; corner < corners; ++corner) {
    const int32_t other = neighbour(corner);
    if (other < corner) continue;
    ++innerEdges;
    vertices.Join(corner, NextCorner(other));
    vertices.Join(NextCorner(corner), other);
    if (pieces.Find(corner / 3) == pieces.Find(other / 3)) continue;
    pieces.Join(corner / 3, other / 3);
    --pieceCount;
  }
  std::vector<int32_t> vertexOfCorner(size_t(corners), -1);
  chart.triangles.resize(size_t(faceCount));
  for (int32_t corner = 0; corner < corners; ++corner) {
    const int32_t root = vertices.Find(corner);
    if (root == corner) {
      vertexOfCorner[size_t(corner)] = int32_t(chart.positions.size());
      chart.positions.push_back(Vec3d(mesh.Corner(faces[size_t(corner / 3)], corner % 3)));
    }
    vertexOfCorner[size_t(corner)] = vertexOfCorner[size_t(root)];
    chart.triangles[size_t(corner / 3)][size_t(corner % 3)] = vertexOfCorner[size_t(corner)];
  }

  // Border lines: no vertex has two edges of the border that begin there.
  std::vector<int32_t> next(chart.positions.size(), -1);
  for (int32_t corner = 0; corner < corners; ++corner) {
    if (neighbour(corner) >= 0) continue;
    next[size_t(vertexOfCorner[size_t(corner)])] = vertexOfCorner[size_t(NextCorner(corner))];
  }
  chart.borders = ClosedLines(std::move(next));

  // Vertices - edges + faces = 2 - 2 genus - borders.
  const int64_t edges = corners - innerEdges;
  const int64_t euler = int64_t(chart.positions.size()) - edges + faceCount;
  chart.isConnected = pieceCount == 1;
  chart.genus = (2 - euler - int64_t(chart.borders.size())) / 2;
  return chart;
}

std::vector<int32_t> FacesFrom(int32_t first, int32_t count) {
  std::vector<int32_t> faces(size_t(count), 0);
  std::iota(faces.begin(), faces.end(), first);
  return faces;
}

FlatTriangle Flatten(const ChartMesh& chart, size_t triangle) {
  Vec3d p[3];
  for (size_t c = 0; c < 3; ++c) {
    p[c] = chart.positions[size_t(chart.triangles[triangle][c])];
  }
  FlatTriangle flat;
  for (int c = 0; c < 3; ++c) {
    const double length = Length(p[(c + 1) % 3] - p[c]);
    if (length > flat.length) {
      flat.length = length;
      flat.first = c;
    }
  }
  if (!(flat.length > 0)) return flat;
  const Vec3d &a = p[flat.first], along = (p[(flat.first + 1) % 3] - a) / flat.length;
  const Vec3d apex = p[(flat.first + 2) % 3] - a;
  flat.x = Dot(apex, along);
  flat.height = Length(Cross(along, apex));
  return flat;
}

std::vector<Vec2d> MapOfFace(const ChartMesh& chart) {
  const FlatTriangle flat = Flatten(chart, 0);
  const Vec2d places[3] = {{0, 0}, {flat.length, 0}, {flat.x, flat.height}};
  std::vector<Vec2d> map(3);
  for (int c = 0; c < 3; ++c) {
    map[size_t(chart.triangles[0][size_t((flat.first + c) % 3)])] = places[c];
  }
  return map;
}

Vec3d VectorAreaOf(const ChartMesh& mesh) {
  Vec3d sum;
  for (const auto& t : mesh.triangles) {
    const Vec3d& a = mesh.positions[size_t(t[0])];
    sum = sum + Cross(mesh.positions[size_t(t[1])] - a, mesh.positions[size_t(t[2])] - a) * 0.5;
  }
  return sum;
}

double AreaOf(const ChartMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3d& a = mesh.positions[size_t(t[0])];
    sum += 0.5 * Length(Cross(mesh.positions[size_t(t[1])] - a, mesh.positions[size_t(t[2])] - a));
  }
  return sum;
}

}  // namespace lambert
