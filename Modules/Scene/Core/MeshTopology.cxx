#include "Scene/Core/MeshTopology.h"

#include <algorithm>

#include "Scene/Core/FirstEqual.h"

namespace lambert {

namespace {

/// A half-edge seen from the lower of its two positions.
struct EdgeUse {
  int32_t otherPosition;
  int32_t halfEdge;
  bool operator<(const EdgeUse& use) const {
    return otherPosition != use.otherPosition ? otherPosition < use.otherPosition
                                              : halfEdge < use.halfEdge;
  }
};

std::array<int32_t, 3> PositionCorners(const TriangleMesh& mesh, const MeshTopology& topology,
                                       int64_t face) {
  const std::array<int32_t, 3>& t = mesh.triangles[size_t(face)];
  return {topology.positionId[size_t(t[0])], topology.positionId[size_t(t[1])],
          topology.positionId[size_t(t[2])]};
}

/// The half-edges, sorted by the two positions that they join.
void CollectEdgeUses(const TriangleMesh& mesh, const MeshTopology& topology,
                     std::vector<int64_t>* begin, std::vector<EdgeUse>* uses) {
  const auto forEachUse = [&](const auto& use) {
    for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
      const std::array<int32_t, 3> p = PositionCorners(mesh, topology, face);
      if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;
      for (int c = 0; c < 3; ++c) {
        const int32_t a = p[size_t(c)], b = p[size_t((c + 1) % 3)];
        use(std::min(a, b), std::max(a, b), int32_t(3 * face + c));
      }
    }
  };
  begin->assign(mesh.positions.size() + 1, 0);
  forEachUse([&](int32_t low, int32_t, int32_t) { ++(*begin)[size_t(low) + 1]; });
  for (size_t i = 1; i < begin->size(); ++i) (*begin)[i] += (*begin)[i - 1];
  uses->resize(size_t(begin->back()));
  std::vector<int64_t> next(begin->begin(), begin->end() - 1);
  forEachUse([&](int32_t low, int32_t high, int32_t halfEdge) {
    (*uses)[size_t(next[size_t(low)]++)] = {high, halfEdge};
  });
  for (size_t low = 0; low + 1 < begin->size(); ++low) {
    std::sort(uses->begin() + (*begin)[low], uses->begin() + (*begin)[low + 1]);
  }
}

/// Joins the two half-edges of every manifold edge; counts the others.
void JoinManifoldEdges(const TriangleMesh& mesh, MeshTopology* topology) {
  std::vector<int64_t> begin;
  std::vector<EdgeUse> uses;
  CollectEdgeUses(mesh, *topology, &begin, &uses);
  topology->neighbor.assign(3 * mesh.triangles.size(), -1);
  for (size_t low = 0; low + 1 < begin.size(); ++low) {
    for (int64_t i = begin[low], end = i; i < begin[low + 1]; i = end) {
      while (end < begin[low + 1] &&
             uses[size_t(end)].otherPosition == uses[size_t(i)].otherPosition) {
        ++end;
      }
      if (end - i == 1) ++topology->openEdges;
      if (end - i > 2) ++topology->nonManifoldEdges;
      if (end - i != 2) continue;
      const int32_t a = uses[size_t(i)].halfEdge, b = uses[size_t(i) + 1].halfEdge;
      topology->neighbor[size_t(a)] = b;
      topology->neighbor[size_t(b)] = a;
    }
  }
}

/// True where two faces run along their common edge in opposite directions, as consistent winding
/// has it.
bool WoundAlike(const TriangleMesh& mesh, const MeshTopology& topology, int32_t a, int32_t b) {
  const int32_t startA = mesh.triangles[size_t(a / 3)][size_t(a % 3)];
  const int32_t startB = mesh.triangles[size_t(b / 3)][size_t(b % 3)];
  return topology.positionId[size_t(startA)] != topology.positionId[size_t(startB)];
}

/// Walks the piece of `seed`; what contradicts the winding found so far is cut. Leaves the faces
/// walked in `walk`.
void WalkPiece(const TriangleMesh& mesh, int64_t seed, int32_t piece, MeshTopology* topology,
               std::vector<int64_t>* walk) {
  bool orientable = true;
  walk->assign(1, seed);
  topology->piece[size_t(seed)] = piece;
  for (size_t i = 0; i < walk->size(); ++i) {
    const int64_t face = (*walk)[i];
    for (int32_t edge = int32_t(3 * face); edge < 3 * face + 3; ++edge) {
      const int32_t across = topology->neighbor[size_t(edge)];
      if (across < 0) continue;
      const size_t other = size_t(across / 3);
      const uint8_t against =
          topology->against[size_t(face)] ^ uint8_t(!WoundAlike(mesh, *topology, edge, across));
      if (topology->piece[other] < 0) {
        topology->piece[other] = piece;
        topology->against[other] = against;
        walk->push_back(int64_t(other));
      } else if (topology->against[other] != against) {
        orientable = false;
        topology->neighbor[size_t(edge)] = topology->neighbor[size_t(across)] = -1;
      }
    }
  }
  if (!orientable) ++topology->nonOrientablePieces;
}

/// The winding that most of the area has stands; equal halves keep that of the piece's first face.
void FavourTheMajority(const TriangleMesh& mesh, const std::vector<int64_t>& walk,
                       MeshTopology* topology) {
  double balance = 0;
  for (const int64_t face : walk) {
    const double area = mesh.Area(face);
    balance += topology->against[size_t(face)] ? -area : area;
  }
  if (balance >= 0) return;
  for (const int64_t face : walk) topology->against[size_t(face)] ^= 1;
}

}  // namespace

std::vector<int32_t> PositionIds(const TriangleMesh& mesh) {
  const std::vector<Vec3f>& p = mesh.positions;
  return FirstEqual(
      mesh.PointCount(), [&](int64_t i) { return HashPoint(p[size_t(i)]); },
      [&](int64_t i, int64_t j) { return p[size_t(i)] == p[size_t(j)]; });
}

MeshTopology ConnectFaces(const TriangleMesh& mesh) {
  MeshTopology topology;
  topology.positionId = PositionIds(mesh);
  JoinManifoldEdges(mesh, &topology);
  topology.piece.assign(mesh.triangles.size(), -1);
  topology.against.assign(mesh.triangles.size(), 0);
  std::vector<int64_t> walk;
  for (int64_t seed = 0; seed < mesh.FaceCount(); ++seed) {
    if (topology.piece[size_t(seed)] >= 0) continue;
    WalkPiece(mesh, seed, int32_t(topology.PieceCount()), &topology, &walk);
    FavourTheMajority(mesh, walk, &topology);
    const bool closed = std::all_of(walk.begin(), walk.end(), [&](int64_t face) {
      const int32_t* across = &topology.neighbor[size_t(3 * face)];
      return across[0] >= 0 && across[1] >= 0 && across[2] >= 0;
    });
    topology.closed.push_back(closed);
  }
  return topology;
}

void ReverseFace(TriangleMesh* mesh, int64_t face) {
  std::swap(mesh->triangles[size_t(face)][1], mesh->triangles[size_t(face)][2]);
  uint8_t& flags = mesh->faceFlags[size_t(face)];
  const bool front = flags & kEmitsFront, back = flags & kEmitsBack;
  flags = uint8_t((flags & ~(kEmitsFront | kEmitsBack)) ^ kRewound);
  if (front) flags |= kEmitsBack;
  if (back) flags |= kEmitsFront;
}

int64_t RewindFaces(TriangleMesh* mesh, MeshTopology* topology) {
  // Corners 1 and 2 change places, and with them edges 0 and 2.
  const std::vector<uint8_t> reversed = topology->against;
  const auto moved = [&](int32_t halfEdge) {
    const int32_t face = halfEdge / 3;
    return reversed[size_t(face)] ? 3 * face + 2 - halfEdge % 3 : halfEdge;
  };
  int64_t count = 0;
  for (int64_t face = 0; face < mesh->FaceCount(); ++face) {
    if (!reversed[size_t(face)]) continue;
    ReverseFace(mesh, face);
    std::swap(topology->neighbor[size_t(3 * face)], topology->neighbor[size_t(3 * face) + 2]);
    ++count;
  }
  for (int32_t& across : topology->neighbor) {
    if (across >= 0) across = moved(across);
  }
  topology->against.assign(reversed.size(), 0);
  return count;
}

}  // namespace lambert
