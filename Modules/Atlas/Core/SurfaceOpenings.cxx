#include "Atlas/Core/SurfaceOpenings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include "Common/Core/DisjointSets.h"
#include "Scene/Core/MeshTopology.h"

namespace lambert {

namespace {

/// Of the bounds of the scene, what a solid takes up at most.
constexpr double kLargestSolid = 0.01;

struct Piece {
  double area = 0, volume = 0, holes = 0;  ///< m2, m3, m2
  bool isClosed = false;                   ///< and wound one way
  bool emitsWithin = false;
  Box3f bounds;
};

/// Vector areas of border lines: closed lines of edges that meet in points.
void AddHoles(const TriangleMesh& mesh, const MeshTopology& topology, std::vector<Piece>* pieces) {
  DisjointSets lines{mesh.positions.size()};
  std::map<int32_t, Vec3d> areas;
  std::unordered_map<int32_t, int32_t> pieceOfLine;
  const auto forEachBorder = [&](const auto& visit) {
    for (size_t edge = 0; edge < topology.neighbor.size(); ++edge) {
      if (topology.neighbor[edge] >= 0) continue;
      const auto& face = mesh.triangles[edge / 3];
      const auto at = [&](size_t c) { return topology.positionId[size_t(face[c % 3])]; };
      visit(edge / 3, at(edge), at(edge + 1));
    }
  };
  forEachBorder([&](size_t, int32_t from, int32_t to) { lines.Join(from, to); });
  forEachBorder([&](size_t face, int32_t from, int32_t to) {
    const int32_t line = lines.Find(from);
    const Vec3d origin(mesh.positions[size_t(line)]);
    areas[line] += Cross(Vec3d(mesh.positions[size_t(from)]) - origin,
                         Vec3d(mesh.positions[size_t(to)]) - origin) *
                   0.5;
    pieceOfLine[line] = topology.piece[face];
  });
  for (const auto& [line, area] : areas) {
    (*pieces)[size_t(pieceOfLine[line])].holes += Length(area);
  }
}

std::vector<Piece> FindPieces(const TriangleMesh& mesh, const MeshTopology& topology) {
  std::vector<Piece> pieces(topology.closed.size());
  for (size_t i = 0; i < pieces.size(); ++i) pieces[i].isClosed = topology.closed[i] != 0;
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    Piece& piece = pieces[size_t(topology.piece[size_t(face)])];
    const Vec3d a(mesh.Corner(face, 0)), b(mesh.Corner(face, 1)), c(mesh.Corner(face, 2));
    piece.area += double(mesh.Area(face));
    piece.volume += Dot(a, Cross(b, c)) / 6;
    piece.isClosed = piece.isClosed && !topology.against[size_t(face)];
    for (int corner = 0; corner < 3; ++corner) piece.bounds.Include(mesh.Corner(face, corner));
  }
  return pieces;
}

bool Meet(const Box3f& bounds, const Box3f& other) {
  const Vec3f low = other.low - bounds.high, high = bounds.low - other.high;
  return std::max({low.x, low.y, low.z, high.x, high.y, high.z}) <= 0;
}

/// Of closed pieces those whose bounds meet those of the emitting faces of a piece.
void FindEmission(const TriangleMesh& mesh, const MeshTopology& topology,
                  std::vector<Piece>* pieces) {
  std::map<int32_t, Box3f> emitters;
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    if (!mesh.Emits(face, kFront) && !mesh.Emits(face, kBack)) continue;
    Box3f& bounds = emitters[topology.piece[size_t(face)]];
    for (int corner = 0; corner < 3; ++corner) bounds.Include(mesh.Corner(face, corner));
  }
  for (Piece& piece : *pieces) {
    if (!piece.isClosed) continue;
    piece.emitsWithin = std::any_of(emitters.begin(), emitters.end(), [&](const auto& emitter) {
      return Meet(piece.bounds, emitter.second);
    });
  }
}

Vec3f Middle(const Piece& piece) { return (piece.bounds.low + piece.bounds.high) * 0.5f; }

/// The place that has half of all area on either side, along each axis.
Vec3f MedianPlace(const std::vector<Piece>& pieces, double whole) {
  std::vector<std::pair<float, double>> places;
  const auto median = [&](float Vec3f::*axis) {
    places.clear();
    for (const Piece& piece : pieces) places.emplace_back(Middle(piece).*axis, piece.area);
    std::sort(places.begin(), places.end());
    double before = 0;
    for (const auto& [place, area] : places) {
      before += area;
      if (before >= 0.5 * whole) return place;
    }
    return 0.f;
  };
  return {median(&Vec3f::x), median(&Vec3f::y), median(&Vec3f::z)};
}

/// Whether half of the area of all others lies within a piece, by the middles of their bounds.
bool IsRoom(const Piece& room, const std::vector<Piece>& pieces, const Vec3f& median,
            double whole) {
  const auto holds = [&](const Vec3f& place) { return Meet(room.bounds, {place, place}); };
  if (!holds(median)) return false;
  double within = -room.area;
  for (const Piece& piece : pieces) within += holds(Middle(piece)) ? piece.area : 0;
  return whole > room.area && within >= 0.5 * (whole - room.area);
}

double VolumeOf(const Box3f& box) {
  const Vec3d size = Vec3d(box.high) - Vec3d(box.low);
  return size.x * size.y * size.z;
}

}  // namespace

std::vector<SurfaceOpening> FindOpenings(const TriangleMesh& mesh) {
  const MeshTopology topology = ConnectFaces(mesh);
  std::vector<Piece> pieces = FindPieces(mesh, topology);
  AddHoles(mesh, topology, &pieces);
  FindEmission(mesh, topology, &pieces);

  const double mostVolume = kLargestSolid * VolumeOf(mesh.Bounds());
  double whole = 0;
  for (const Piece& piece : pieces) whole += piece.area;
  const Vec3f median = MedianPlace(pieces, whole);
  std::vector<SurfaceOpening> ofPiece;
  for (const Piece& piece : pieces) {
    SurfaceOpening opening;
    if (piece.area > 0) opening.holes = piece.holes / piece.area;
    opening.isRoom = !piece.isClosed && IsRoom(piece, pieces, median, whole);
    if (piece.isClosed && !piece.emitsWithin && std::abs(piece.volume) <= mostVolume) {
      opening.enclosedSide = piece.volume > 0 ? kBack : kFront;
    }
    ofPiece.push_back(opening);
  }

  std::vector<SurfaceOpening> openings;
  for (int64_t face = mesh.FaceCount(); face-- > 0;) {
    const size_t surface = size_t(mesh.surfaceId[size_t(face)]);
    if (surface >= openings.size()) openings.resize(surface + 1);
    openings[surface] = ofPiece[size_t(topology.piece[size_t(face)])];
  }
  return openings;
}

}  // namespace lambert
