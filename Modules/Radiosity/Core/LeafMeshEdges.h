// The edges of the input mesh that have been split, each once however many faces, surfaces and
// sides meet there.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "Common/Core/TriangleMesh.h"
#include "Radiosity/Core/LeafMesh.h"

namespace lambert {

/// Vertices beyond the input points, and the split input edges that own most of them. Edges are
/// told apart by the exact positions of their ends, so that points match across surfaces, sides and
/// non-manifold edges.
class LeafMeshEdges {
 public:
  explicit LeafMeshEdges(const TriangleMesh& mesh);

  /// A corner of the face, by the number 0 to 2, begins the edge of that number.
  struct FaceEdge {
    int32_t edge = -1;  ///< -1 where no face of this edge has been split
    int32_t name = -1;  ///< pair of input points through which the face names the edge's vertices
    bool isForward = true;  ///< the face runs through the edge in its stored direction
  };

  /// The face's edge if it is stored. Quick where it is not; safe from several threads.
  FaceEdge Find(int32_t face, int corner) const;
  /// The same, stored if it was not.
  FaceEdge FindOrAdd(int32_t face, int corner);

  /// Parameters of an edge's points from its first end, ascending, in (0, 1).
  const std::vector<double>& Points(int32_t edge) const { return edges_[size_t(edge)].points; }
  /// Puts a point at `parameter` before the point of index `index`.
  void InsertPoint(int32_t edge, int32_t index, double parameter);
  /// Number of the vertex that stands for a point of an edge where faces name its ends by `name`;
  /// made when asked first. Faces on both sides of a crease have different names, hence two
  /// vertices at one position.
  int32_t VertexNumber(int32_t edge, int32_t name, int32_t index);

  /// Number of a new vertex inside a face, at barycentric weights.
  int32_t AddInnerVertex(int32_t face, const Vec3d& weights);

  Vec3f Position(int32_t number) const {
    const size_t points = mesh_.positions.size();
    return size_t(number) < points ? mesh_.positions[size_t(number)]
                                   : vertices_[size_t(number) - points].position;
  }
  const std::vector<LeafVertex>& Vertices() const { return vertices_; }

 private:
  // The vertices of one edge under one pair of input points.
  struct Name {
    std::array<int32_t, 2> ends;
    std::vector<int32_t> numbers;  // Per point of the edge; -1 until asked for.
  };
  struct Edge {
    std::vector<double> points;
    std::vector<Name> names;
  };

  std::array<int32_t, 2> Ends(int32_t face, int corner, bool* isForward) const;
  uint64_t Key(const std::array<int32_t, 2>& ends) const;

  const TriangleMesh& mesh_;
  std::vector<int32_t> place_;      // Per point: the first point at exactly this position.
  std::vector<uint8_t> isTouched_;  // Per place: an edge that ends there is stored.
  std::unordered_map<uint64_t, int32_t> edgeOfKey_;
  std::vector<Edge> edges_;
  std::vector<LeafVertex> vertices_;
};

}  // namespace lambert
