// The dual graph of the faces of every part: a node a face, an edge where two faces may join a
// cluster.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "Common/Core/TriangleMesh.h"

namespace lambert {

/// Faces grouped by part, in their old order within a part. A slot is a place in `faces`.
struct PartFaces {
  std::vector<int32_t> faces;  ///< by slot
  std::vector<int32_t> begin;  ///< first slot of each part, and one past the last

  int32_t PartCount() const { return int32_t(begin.size()) - 1; }
  int32_t Count(int32_t part) const { return begin[size_t(part) + 1] - begin[size_t(part)]; }
};

/// Groups the faces; at least `partCount` parts. Throws Error for a negative part.
PartFaces GroupFacesByPart(const TriangleMesh& mesh, int32_t partCount);

struct DualGraph {
  std::vector<std::array<int32_t, 3>>
      neighbours;                ///< per slot and edge (corner e to e + 1): a slot, or -1
  int64_t nonManifoldEdges = 0;  ///< edges of three faces or more
  int64_t inconsistentEdges =
      0;  ///< edges of two faces of one material that wind against each other
};

/// Joins two faces where they alone of their part share an edge, wind alike and have the same
/// material. Edges are found through positions, so that seams of normals and texture coordinates do
/// not cut. Parts with `clustered[part] == 0` are left without edges.
DualGraph BuildDualGraph(const TriangleMesh& mesh, const PartFaces& parts,
                         const std::vector<uint8_t>& clustered);

/// Connected components of the clustered parts, in the order of their first slots.
struct Surfaces {
  std::vector<int32_t> slots;  ///< of all surfaces, one after the other, ascending within each
  std::vector<int32_t> begin;  ///< first entry of each surface, and one past the last
  std::vector<int32_t> firstOfPart;  ///< first surface of each part, and one past the last

  int32_t Count() const { return int32_t(begin.size()) - 1; }
};
Surfaces FindSurfaces(const DualGraph& graph, const PartFaces& parts,
                      const std::vector<uint8_t>& clustered);

}  // namespace lambert
