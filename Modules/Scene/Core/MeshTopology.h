// Which faces meet where: connectivity by position alone, so that seams of normals, texture
// coordinates and materials do not part what is one surface.
#pragma once

#include <cstdint>
#include <vector>

#include "Common/Core/TriangleMesh.h"

namespace lambert {

/// Edge c of a face runs from its corner c to its corner c+1. A half-edge is numbered 3 face + c.
struct MeshTopology {
  std::vector<int32_t> positionId;  ///< per point: the first point at the same position
  std::vector<int32_t>
      neighbor;  ///< per half-edge: the one across a manifold edge; -1 at a border or a cut
  std::vector<int32_t> piece;    ///< per face: its connected piece, numbered by first face
  std::vector<uint8_t> against;  ///< per face: 1 where its winding opposes that of its piece
  std::vector<uint8_t> closed;   ///< per piece: no border, no cut
  int64_t openEdges = 0;         ///< edges of one face
  int64_t nonManifoldEdges = 0;  ///< edges of more than two faces, cut
  int64_t nonOrientablePieces =
      0;  ///< pieces that had to be cut to be wound consistently (Moebius strips)

  int64_t PieceCount() const { return int64_t(closed.size()); }
};

/// Per point: the first point at the same position.
std::vector<int32_t> PositionIds(const TriangleMesh& mesh);

/// Connects the faces, finds the pieces and the winding that most of each piece's area has in the
/// file. Faces with two corners at one position stay unconnected.
MeshTopology ConnectFaces(const TriangleMesh& mesh);

/// Winds every piece consistently: reverses the faces that lie against their piece, toggles their
/// kRewound and swaps their emission bits, so that they emit to the same side in space as before.
/// Returns how many were reversed.
int64_t RewindFaces(TriangleMesh* mesh, MeshTopology* topology);

/// Reverses one face (emission and kRewound as above).
void ReverseFace(TriangleMesh* mesh, int64_t face);

}  // namespace lambert
