#include "Scene/Core/InvertedEmitters.h"

#include <algorithm>

#include "Common/Core/Parallel.h"

namespace lambert {

namespace {

/// A connected piece of one part, in the world.
struct Piece {
  std::vector<int64_t> faces;
  Box3f bounds;
  double volume = 0;  ///< that its winding encloses, m3; negative where it is wound inward
};

bool EmitsAtAll(const TriangleMesh& mesh, int64_t face) {
  return (mesh.Emits(face, kFront) || mesh.Emits(face, kBack)) &&
         !mesh.emittance[size_t(face)].IsBlack();
}

bool Contains(const Box3f& box, const Vec3f& p) {
  return p.x >= box.low.x && p.y >= box.low.y && p.z >= box.low.z && p.x <= box.high.x &&
         p.y <= box.high.y && p.z <= box.high.z;
}

/// Signed solid angle of triangle abc seen from the origin (van Oosterom and Strackee 1983).
double SolidAngle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const double la = Length(a), lb = Length(b), lc = Length(c);
  const double denominator = la * lb * lc + Dot(a, b) * lc + Dot(b, c) * la + Dot(c, a) * lb;
  return 2 * std::atan2(Dot(a, Cross(b, c)), denominator);
}

/// The closed pieces most of whose area emits, with the faces of each.
class EmittingPieces {
 public:
  EmittingPieces(const std::vector<CleanedMesh>& meshes, const PartRanges& ranges,
                 const Scene& scene)
      : scene_(scene), mesh_(scene.mesh) {
    FindPieces(meshes, ranges);
    CollectCandidates(meshes, ranges);
  }

  const std::vector<Piece>& Candidates() const { return candidates_; }

  /// +1 where the front of `face` looks out of its closed piece, -1 where it looks in.
  int OutwardSign(const Piece& piece, int64_t face) const {
    return (piece.volume > 0) != bool(against_[size_t(face)]) ? 1 : -1;
  }

  bool IsEmpty(const Piece& piece) const {
    std::vector<Vec3f> points;
    const int32_t own = pieceOfFace_[size_t(piece.faces.front())];
    for (size_t other = 0; other < sample_.size(); ++other) {
      if (int32_t(other) == own || sample_[other] < 0) continue;
      const Vec3f point = Centroid(sample_[other]);
      if (Contains(piece.bounds, point)) points.push_back(Vec3f(point));
    }
    constexpr size_t kMostPoints = 1000;
    const size_t stride = points.size() / kMostPoints + 1;
    for (size_t i = 0; i < points.size(); i += stride) {
      if (IsInside(piece, points[i])) return false;
    }
    for (const Light& light : scene_.lights) {
      if (light.IsPlaced() && IsInside(piece, light.position)) return false;
    }
    return !scene_.camera || !IsInside(piece, Vec3f(scene_.camera->position));
  }

 private:
  void FindPieces(const std::vector<CleanedMesh>& meshes, const PartRanges& ranges) {
    pieceOfFace_.resize(mesh_.triangles.size());
    against_.resize(mesh_.triangles.size());
    sample_.assign(size_t(ranges.pieceBegin.back()), -1);
    emittingArea_.resize(sample_.size());
    for (int64_t face = 0; face < mesh_.FaceCount(); ++face) {
      const size_t part = size_t(mesh_.partId[size_t(face)]);
      const MeshTopology& topology = meshes[size_t(scene_.parts[part].meshId)].topology;
      const size_t inMesh = size_t(face - ranges.faceBegin[part]);
      const size_t piece = size_t(ranges.pieceBegin[part]) + size_t(topology.piece[inMesh]);
      pieceOfFace_[size_t(face)] = int32_t(piece);
      against_[size_t(face)] = topology.against[inMesh];
      if (sample_[piece] < 0) sample_[piece] = face;
      const double area = mesh_.Area(face);
      emittingArea_[piece] += EmitsAtAll(mesh_, face) ? area : -area;
    }
  }

  void CollectCandidates(const std::vector<CleanedMesh>& meshes, const PartRanges& ranges) {
    std::vector<int32_t> candidateOf(sample_.size(), -1);
    for (size_t part = 0; part < scene_.parts.size(); ++part) {
      const MeshTopology& topology = meshes[size_t(scene_.parts[part].meshId)].topology;
      for (size_t i = 0; i < topology.closed.size(); ++i) {
        const size_t piece = size_t(ranges.pieceBegin[part]) + i;
        if (!topology.closed[i] || emittingArea_[piece] <= 0) continue;
        candidateOf[piece] = int32_t(candidates_.size());
        candidates_.emplace_back();
      }
    }
    for (int64_t face = 0; face < mesh_.FaceCount(); ++face) {
      const int32_t candidate = candidateOf[size_t(pieceOfFace_[size_t(face)])];
      if (candidate < 0) continue;
      Piece& piece = candidates_[size_t(candidate)];
      piece.faces.push_back(face);
      for (int corner = 0; corner < 3; ++corner) piece.bounds.Include(mesh_.Corner(face, corner));
    }
    for (Piece& piece : candidates_) piece.volume = SignedVolume(piece);
  }

  /// Summed about the centre of the bounds, where rounding is least.
  double SignedVolume(const Piece& piece) const {
    return SumOverFaces(
        piece, piece.bounds.Center(),
        [](const Vec3d& a, const Vec3d& b, const Vec3d& c) { return Dot(a, Cross(b, c)) / 6; });
  }

  /// By the winding number: the solid angles of a closed piece add up to 4 pi inside and to nothing
  /// outside.
  bool IsInside(const Piece& piece, const Vec3f& point) const {
    return Contains(piece.bounds, point) &&
           std::abs(SumOverFaces(piece, point, SolidAngle)) > 2 * kPi;
  }

  template <class Term>
  double SumOverFaces(const Piece& piece, const Vec3f& origin, const Term& term) const {
    double sum = 0;
    for (const int64_t face : piece.faces) {
      const Vec3d o(origin), a = Vec3d(mesh_.Corner(face, 0)) - o,
                             b = Vec3d(mesh_.Corner(face, 1)) - o,
                             c = Vec3d(mesh_.Corner(face, 2)) - o;
      sum += against_[size_t(face)] ? -term(a, b, c) : term(a, b, c);
    }
    return sum;
  }

  Vec3f Centroid(int64_t face) const {
    return (mesh_.Corner(face, 0) + mesh_.Corner(face, 1) + mesh_.Corner(face, 2)) / 3.f;
  }

  const Scene& scene_;
  const TriangleMesh& mesh_;
  std::vector<int32_t> pieceOfFace_;
  std::vector<uint8_t> against_;
  std::vector<int64_t> sample_;       ///< per piece: one face of it
  std::vector<double> emittingArea_;  ///< per piece: area that emits less area that does not
  std::vector<Piece> candidates_;
};

bool AnythingEmits(const TriangleMesh& mesh) {
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    if (EmitsAtAll(mesh, face)) return true;
  }
  return false;
}

}  // namespace

std::vector<int64_t> TurnInvertedEmitters(const std::vector<CleanedMesh>& meshes,
                                          const PartRanges& ranges, Scene* scene) {
  TriangleMesh& mesh = scene->mesh;
  std::vector<int64_t> turnedOfMaterial(scene->materials.size(), 0);
  if (ranges.pieceBegin.back() < 2 || !AnythingEmits(mesh)) return turnedOfMaterial;

  // Faces that emit into a closed piece with nothing in it.
  const EmittingPieces pieces(meshes, ranges, *scene);
  std::vector<std::vector<int64_t>> inverted(pieces.Candidates().size());
  ParallelForEach(int64_t(inverted.size()), 1, [&](int64_t i) {
    const Piece& piece = pieces.Candidates()[size_t(i)];
    for (const int64_t face : piece.faces) {
      const uint8_t inwardBit = pieces.OutwardSign(piece, face) > 0 ? kEmitsBack : kEmitsFront;
      const uint8_t emission = mesh.faceFlags[size_t(face)] & (kEmitsFront | kEmitsBack);
      if (emission == inwardBit && EmitsAtAll(mesh, face)) inverted[size_t(i)].push_back(face);
    }
    if (!inverted[size_t(i)].empty() && !pieces.IsEmpty(piece)) inverted[size_t(i)].clear();
  });

  // They emit outward.
  for (const std::vector<int64_t>& faces : inverted) {
    std::vector<int32_t> materials;
    for (const int64_t face : faces) {
      mesh.faceFlags[size_t(face)] ^= kEmitsFront | kEmitsBack;
      const int32_t material = mesh.materialId[size_t(face)];
      if (std::find(materials.begin(), materials.end(), material) == materials.end()) {
        materials.push_back(material);
      }
    }
    for (const int32_t material : materials) ++turnedOfMaterial[size_t(material)];
  }
  return turnedOfMaterial;
}

}  // namespace lambert
