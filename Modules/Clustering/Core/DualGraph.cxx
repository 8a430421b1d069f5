#include "Clustering/Core/DualGraph.h"

#include <algorithm>
#include <cstring>

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"

namespace lambert {

namespace {

/// Numbers the positions of each part: corners at bitwise the same place of the same part get the
/// same number.
class PositionIndex {
 public:
  explicit PositionIndex(const TriangleMesh& mesh)
      : mesh_(mesh),
        vertexOfPoint_(mesh.positions.size(), -1),
        partOfPoint_(mesh.positions.size(), -1) {
    Resize(1024);
  }

  int32_t Vertex(int32_t point, int32_t part) {
    if (partOfPoint_[size_t(point)] != part) {
      partOfPoint_[size_t(point)] = part;
      vertexOfPoint_[size_t(point)] = FindOrAdd(mesh_.positions[size_t(point)], part);
    }
    return vertexOfPoint_[size_t(point)];
  }
  int32_t Count() const { return int32_t(vertices_.size()); }

 private:
  struct Place {
    Vec3f position;
    int32_t part;
  };

  static uint64_t Hash(const Place& place) {
    uint32_t bits[3];
    std::memcpy(bits, &place.position, sizeof bits);
    return HashBits((uint64_t(bits[0]) << 32 | bits[1]) ^
                    HashBits(uint64_t(bits[2]) << 32 | uint32_t(place.part)));
  }

  int32_t FindOrAdd(const Vec3f& position, int32_t part) {
    if (2 * vertices_.size() >= table_.size()) Resize(2 * table_.size());
    const Place place{position + Vec3f(), part};  // -0 + 0 = 0
    for (uint64_t entry = Hash(place) & mask_;; entry = (entry + 1) & mask_) {
      const int32_t vertex = table_[entry];
      if (vertex < 0) {
        vertices_.push_back(place);
        return table_[entry] = int32_t(vertices_.size()) - 1;
      }
      const Place& other = vertices_[size_t(vertex)];
      if (other.position == place.position && other.part == part) return vertex;
    }
  }

  void Resize(size_t size) {
    table_.assign(size, -1);
    mask_ = size - 1;
    for (size_t vertex = 0; vertex < vertices_.size(); ++vertex) {
      uint64_t entry = Hash(vertices_[vertex]) & mask_;
      while (table_[entry] >= 0) entry = (entry + 1) & mask_;
      table_[entry] = int32_t(vertex);
    }
  }

  const TriangleMesh& mesh_;
  std::vector<int32_t> vertexOfPoint_, partOfPoint_;
  std::vector<Place> vertices_;
  std::vector<int32_t> table_;
  uint64_t mask_ = 0;
};

/// The edge of one face, filed under its lower vertex.
struct HalfEdge {
  int32_t high;   ///< the other vertex
  uint32_t code;  ///< 2 (3 slot + corner) + (1 where it runs from high to low)

  int32_t Slot() const { return int32_t(code / 6); }
  int32_t Corner() const { return int32_t(code / 2 % 3); }
  bool Downward() const { return code & 1; }
  bool operator<(const HalfEdge& other) const {
    return high != other.high ? high < other.high : code < other.code;
  }
};

/// All half-edges, by lower vertex.
struct HalfEdges {
  std::vector<HalfEdge> edges;
  std::vector<int32_t> begin;
};

HalfEdges FileHalfEdges(const TriangleMesh& mesh, const PartFaces& parts,
                        const std::vector<uint8_t>& clustered) {
  // Vertices of every face; a face that names a place twice has no edges.
  std::vector<std::array<int32_t, 3>> corners(parts.faces.size(), {-1, -1, -1});
  PositionIndex index(mesh);
  for (int32_t part = 0; part < parts.PartCount(); ++part) {
    if (!clustered[size_t(part)]) continue;
    for (int32_t slot = parts.begin[size_t(part)]; slot < parts.begin[size_t(part) + 1]; ++slot) {
      const auto& triangle = mesh.triangles[size_t(parts.faces[size_t(slot)])];
      std::array<int32_t, 3> vertices;
      for (size_t k = 0; k < 3; ++k) vertices[k] = index.Vertex(triangle[k], part);
      const bool folded =
          vertices[0] == vertices[1] || vertices[1] == vertices[2] || vertices[2] == vertices[0];
      if (!folded) corners[size_t(slot)] = vertices;
    }
  }

  // Counting sort by the lower vertex.
  HalfEdges filed;
  filed.begin.assign(size_t(index.Count()) + 1, 0);
  for (const auto& c : corners) {
    if (c[0] < 0) continue;
    for (size_t k = 0; k < 3; ++k) ++filed.begin[size_t(std::min(c[k], c[(k + 1) % 3])) + 1];
  }
  for (size_t v = 1; v < filed.begin.size(); ++v) filed.begin[v] += filed.begin[v - 1];
  filed.edges.resize(size_t(filed.begin.back()));
  std::vector<int32_t> next(filed.begin.begin(), filed.begin.end() - 1);
  for (size_t slot = 0; slot < corners.size(); ++slot) {
    const auto& c = corners[slot];
    if (c[0] < 0) continue;
    for (size_t k = 0; k < 3; ++k) {
      const int32_t from = c[k], to = c[(k + 1) % 3];
      const uint32_t code = uint32_t(2 * (3 * slot + k)) + (from > to ? 1 : 0);
      filed.edges[size_t(next[size_t(std::min(from, to))]++)] = {std::max(from, to), code};
    }
  }
  return filed;
}

struct CutEdges {
  int64_t nonManifold = 0, inconsistent = 0;
  void operator+=(const CutEdges& other) {
    nonManifold += other.nonManifold;
    inconsistent += other.inconsistent;
  }
};

}  // namespace

PartFaces GroupFacesByPart(const TriangleMesh& mesh, int32_t partCount) {
  for (const int32_t part : mesh.partId) {
    if (part < 0) throw Error("A face names the negative part " + std::to_string(part) + ".");
    partCount = std::max(partCount, part + 1);
  }
  PartFaces parts;
  parts.begin.assign(size_t(partCount) + 1, 0);
  for (const int32_t part : mesh.partId) ++parts.begin[size_t(part) + 1];
  for (size_t part = 1; part < parts.begin.size(); ++part)
    parts.begin[part] += parts.begin[part - 1];
  std::vector<int32_t> next(parts.begin.begin(), parts.begin.end() - 1);
  parts.faces.resize(mesh.partId.size());
  for (size_t face = 0; face < mesh.partId.size(); ++face) {
    parts.faces[size_t(next[size_t(mesh.partId[face])]++)] = int32_t(face);
  }
  return parts;
}

DualGraph BuildDualGraph(const TriangleMesh& mesh, const PartFaces& parts,
                         const std::vector<uint8_t>& clustered) {
  HalfEdges filed = FileHalfEdges(mesh, parts, clustered);
  DualGraph graph;
  graph.neighbours.assign(parts.faces.size(), {-1, -1, -1});
  const auto material = [&](const HalfEdge& edge) {
    return mesh.materialId[size_t(parts.faces[size_t(edge.Slot())])];
  };

  // Edges of a vertex, sorted by their other end: a run is an edge of the mesh, a pair of its own
  // may join.
  const auto joinEdgesOf = [&](int64_t vertex) {
    CutEdges cut;
    HalfEdge* edge = filed.edges.data() + filed.begin[size_t(vertex)];
    HalfEdge* const end = filed.edges.data() + filed.begin[size_t(vertex) + 1];
    std::sort(edge, end);
    while (edge < end) {
      const HalfEdge* const first = edge;
      while (edge < end && edge->high == first->high) ++edge;
      if (edge - first > 2) ++cut.nonManifold;
      if (edge - first != 2 || material(first[0]) != material(first[1])) continue;
      if (first[0].Downward() == first[1].Downward()) {
        ++cut.inconsistent;
        continue;
      }
      graph.neighbours[size_t(first[0].Slot())][size_t(first[0].Corner())] = first[1].Slot();
      graph.neighbours[size_t(first[1].Slot())][size_t(first[1].Corner())] = first[0].Slot();
    }
    return cut;
  };
  const CutEdges cut = OrderedSum<CutEdges>(int64_t(filed.begin.size()) - 1, joinEdgesOf);
  graph.nonManifoldEdges = cut.nonManifold;
  graph.inconsistentEdges = cut.inconsistent;
  return graph;
}

Surfaces FindSurfaces(const DualGraph& graph, const PartFaces& parts,
                      const std::vector<uint8_t>& clustered) {
  // Flood the graph from the first slot that no surface has yet.
  std::vector<int32_t> surfaceOf(parts.faces.size(), -1);
  std::vector<int32_t> stack;
  Surfaces surfaces;
  surfaces.begin.assign(1, 0);
  for (int32_t part = 0; part < parts.PartCount(); ++part) {
    surfaces.firstOfPart.push_back(surfaces.Count());
    if (!clustered[size_t(part)]) continue;
    for (int32_t seed = parts.begin[size_t(part)]; seed < parts.begin[size_t(part) + 1]; ++seed) {
      if (surfaceOf[size_t(seed)] >= 0) continue;
      const int32_t surface = surfaces.Count();
      int32_t count = 0;
      surfaceOf[size_t(seed)] = surface;
      stack.push_back(seed);
      while (!stack.empty()) {
        const int32_t slot = stack.back();
        stack.pop_back();
        ++count;
        for (const int32_t neighbour : graph.neighbours[size_t(slot)]) {
          if (neighbour < 0 || surfaceOf[size_t(neighbour)] >= 0) continue;
          surfaceOf[size_t(neighbour)] = surface;
          stack.push_back(neighbour);
        }
      }
      surfaces.begin.push_back(surfaces.begin.back() + count);
    }
  }
  surfaces.firstOfPart.push_back(surfaces.Count());

  std::vector<int32_t> next(surfaces.begin.begin(), surfaces.begin.end() - 1);
  surfaces.slots.resize(size_t(surfaces.begin.back()));
  for (size_t slot = 0; slot < surfaceOf.size(); ++slot) {
    if (surfaceOf[slot] < 0) continue;
    surfaces.slots[size_t(next[size_t(surfaceOf[slot])]++)] = int32_t(slot);
  }
  return surfaces;
}

}  // namespace lambert
