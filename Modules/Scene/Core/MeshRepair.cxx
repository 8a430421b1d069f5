#include "Scene/Core/MeshRepair.h"

#include <algorithm>

#include "Scene/Core/FirstEqual.h"
#include "Scene/Core/MeshTopology.h"

namespace lambert {

namespace {

template <class T>
void Keep(const std::vector<uint8_t>& keep, std::vector<T>* values) {
  if (values->empty()) return;
  size_t kept = 0;
  for (size_t i = 0; i < keep.size(); ++i) {
    if (keep[i]) (*values)[kept++] = T((*values)[i]);
  }
  values->resize(kept);
}

/// What the outline of a polygon is told by.
struct Outline {
  std::vector<int32_t> corners;  ///< its positions, sorted, each once
  Vec3d vectorArea;              ///< whichever way it was cut into triangles
  double area = 0;
};

/// Faces as the file has them: the triangles of one source cell, or each triangle by itself.
class Polygons {
 public:
  Polygons(const TriangleMesh& mesh, bool bySourceCell)
      : mesh_(mesh), positionId_(PositionIds(mesh)) {
    for (size_t face = 0; face < mesh.triangles.size(); ++face) {
      const bool isNext =
          bySourceCell && face > 0 && mesh.sourceCellId[face] == mesh.sourceCellId[face - 1];
      if (!isNext) begin_.push_back(int32_t(face));
    }
    begin_.push_back(int32_t(mesh.triangles.size()));
  }

  size_t Size() const { return begin_.size() - 1; }
  /// Its faces.
  size_t Begin(size_t polygon) const { return size_t(begin_[polygon]); }
  size_t End(size_t polygon) const { return size_t(begin_[polygon + 1]); }

  void GetOutline(size_t polygon, Outline* outline) const {
    outline->corners.clear();
    outline->vectorArea = Vec3d();
    outline->area = 0;
    for (size_t face = this->Begin(polygon); face < this->End(polygon); ++face) {
      const Vec3d p(mesh_.Corner(int64_t(face), 0));
      const Vec3d area = Cross(Vec3d(mesh_.Corner(int64_t(face), 1)) - p,
                               Vec3d(mesh_.Corner(int64_t(face), 2)) - p) *
                         0.5;
      outline->vectorArea += area;
      outline->area += Length(area);
      for (const int32_t point : mesh_.triangles[face]) {
        outline->corners.push_back(int32_t(positionId_[size_t(point)]));
      }
    }
    std::sort(outline->corners.begin(), outline->corners.end());
    outline->corners.erase(std::unique(outline->corners.begin(), outline->corners.end()),
                           outline->corners.end());
  }
  Vec3d VectorArea(size_t polygon) const {
    Outline outline;
    this->GetOutline(polygon, &outline);
    return outline.vectorArea;
  }

 private:
  const TriangleMesh& mesh_;
  std::vector<int32_t> positionId_, begin_;
};

/// The same positions and, up to the winding, the same vector area.
bool SameOutline(const Outline& a, const Outline& b) {
  if (a.corners != b.corners) return false;
  // Both are sums over the same coordinates in double; far more than their rounding, far less than
  // a corner.
  const double tolerance = 1e-6 * std::max(a.area, b.area);
  return Length(a.vectorArea - b.vectorArea) <= tolerance ||
         Length(a.vectorArea + b.vectorArea) <= tolerance;
}

bool Emits(const TriangleMesh& mesh, size_t face) {
  return (mesh.faceFlags[face] & (kEmitsFront | kEmitsBack)) && !mesh.emittance[face].IsBlack();
}

/// Emission bits of `face` as seen from the front of a copy with the same or the reverse winding.
uint8_t EmissionSeenFrom(const TriangleMesh& mesh, size_t face, bool sameWinding) {
  const uint8_t bits = mesh.faceFlags[face] & (kEmitsFront | kEmitsBack);
  return sameWinding ? bits : uint8_t((bits >> 1) | ((bits & 1) << 1));
}

/// For each polygon the first with the same outline.
std::vector<int32_t> FirstCopies(const Polygons& polygons) {
  Outline a, b;
  return FirstEqual(
      int64_t(polygons.Size()),
      [&](int64_t i) {
        polygons.GetOutline(size_t(i), &a);
        uint64_t hash = 0;
        for (const int32_t corner : a.corners) hash = HashBits(hash, uint64_t(corner));
        return hash;
      },
      [&](int64_t i, int64_t j) {
        polygons.GetOutline(size_t(i), &a);
        polygons.GetOutline(size_t(j), &b);
        return SameOutline(a, b);
      });
}

RepeatCounts RemoveRepeatedPolygons(const Polygons& polygons, TriangleMesh* mesh) {
  // The first copy that emits stays, else the first.
  const std::vector<int32_t> first = FirstCopies(polygons);
  std::vector<int32_t> staying(first);
  for (size_t i = 0; i < polygons.Size(); ++i) {
    int32_t& stays = staying[size_t(first[i])];
    const bool staysDark = !Emits(*mesh, polygons.Begin(size_t(stays)));
    if (staysDark && Emits(*mesh, polygons.Begin(i))) stays = int32_t(i);
  }

  // What the other copies emit must not be lost.
  RepeatCounts counts;
  std::vector<uint8_t> keep(mesh->triangles.size(), 1), otherSideKept(polygons.Size(), 0);
  for (size_t i = 0; i < polygons.Size(); ++i) {
    const size_t stays = size_t(staying[size_t(first[i])]);
    if (i == stays) continue;
    const size_t copy = polygons.Begin(i), kept = polygons.Begin(stays);
    if (Emits(*mesh, copy)) {
      const bool sameWinding = Dot(polygons.VectorArea(i), polygons.VectorArea(stays)) > 0;
      const uint8_t emission = EmissionSeenFrom(*mesh, copy, sameWinding);
      const bool otherSide = (emission & ~mesh->faceFlags[kept]) != 0;
      if (mesh->emittance[copy] == mesh->emittance[kept]) {
        for (size_t face = kept; face < polygons.End(stays); ++face) {
          mesh->faceFlags[face] |= emission;
        }
      } else if (otherSide && !otherSideKept[stays]) {
        otherSideKept[stays] = 1;
        continue;
      }
    }
    for (size_t face = copy; face < polygons.End(i); ++face) {
      keep[face] = 0;
      ++counts.removed;
      counts.otherMaterial += mesh->materialId[face] != mesh->materialId[kept];
    }
  }
  if (counts.removed > 0) KeepFaces(keep, mesh);
  return counts;
}

}  // namespace

void KeepFaces(const std::vector<uint8_t>& keep, TriangleMesh* mesh) {
  Keep(keep, &mesh->triangles);
  Keep(keep, &mesh->reflectance);
  Keep(keep, &mesh->emittance);
  Keep(keep, &mesh->faceFlags);
  Keep(keep, &mesh->materialId);
  Keep(keep, &mesh->partId);
  Keep(keep, &mesh->surfaceId);
  Keep(keep, &mesh->sourceCellId);
}

int64_t RemoveUnusedPoints(TriangleMesh* mesh) {
  std::vector<uint8_t> used(mesh->positions.size(), 0);
  for (const auto& triangle : mesh->triangles) {
    for (const int32_t point : triangle) used[size_t(point)] = 1;
  }
  std::vector<int32_t> newIndex(used.size());
  int32_t count = 0;
  for (size_t i = 0; i < used.size(); ++i) newIndex[i] = used[i] ? count++ : -1;
  if (size_t(count) == used.size()) return 0;
  for (auto& triangle : mesh->triangles) {
    for (int32_t& point : triangle) point = newIndex[size_t(point)];
  }
  Keep(used, &mesh->positions);
  Keep(used, &mesh->normals);
  Keep(used, &mesh->uvs);
  return int64_t(used.size()) - count;
}

WeldCounts WeldPoints(TriangleMesh* mesh) {
  WeldCounts counts;
  counts.unused = RemoveUnusedPoints(mesh);
  const bool normals = !mesh->normals.empty(), uvs = !mesh->uvs.empty();
  const auto uv = [&](int64_t i) {
    return Vec3f(mesh->uvs[size_t(i)].x, mesh->uvs[size_t(i)].y, 0);
  };
  const std::vector<int32_t> first = FirstEqual(
      mesh->PointCount(),
      [&](int64_t i) {
        uint64_t hash = HashPoint(mesh->positions[size_t(i)]);
        if (normals) hash = HashBits(hash, HashPoint(mesh->normals[size_t(i)]));
        return uvs ? HashBits(hash, HashPoint(uv(i))) : hash;
      },
      [&](int64_t i, int64_t j) {
        return SameBits(mesh->positions[size_t(i)], mesh->positions[size_t(j)]) &&
               (!normals || SameBits(mesh->normals[size_t(i)], mesh->normals[size_t(j)])) &&
               (!uvs || SameBits(uv(i), uv(j)));
      });
  for (auto& triangle : mesh->triangles) {
    for (int32_t& point : triangle) point = first[size_t(point)];
  }
  counts.welded = RemoveUnusedPoints(mesh);
  return counts;
}

bool HasNoArea(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const Vec3d u = Vec3d(b) - Vec3d(a), v = Vec3d(c) - Vec3d(a), w = v - u;
  const double longest = std::max({LengthSquared(u), LengthSquared(v), LengthSquared(w)});
  return !(Length(Cross(u, v)) > 1e-7 * longest);
}

int64_t RemoveZeroAreaFaces(TriangleMesh* mesh) {
  std::vector<uint8_t> keep(mesh->triangles.size());
  int64_t removed = 0;
  for (int64_t face = 0; face < mesh->FaceCount(); ++face) {
    keep[size_t(face)] =
        !HasNoArea(mesh->Corner(face, 0), mesh->Corner(face, 1), mesh->Corner(face, 2));
    removed += !keep[size_t(face)];
  }
  if (removed > 0) KeepFaces(keep, mesh);
  return removed;
}

RepeatCounts RemoveRepeatedFaces(TriangleMesh* mesh) {
  // Whole polygons first: two copies of one may be cut into triangles along other diagonals.
  RepeatCounts counts;
  const Polygons polygons(*mesh, true);
  if (polygons.Size() == mesh->triangles.size()) return RemoveRepeatedPolygons(polygons, mesh);
  counts = RemoveRepeatedPolygons(polygons, mesh);
  const RepeatCounts single = RemoveRepeatedPolygons(Polygons(*mesh, false), mesh);
  counts.removed += single.removed;
  counts.otherMaterial += single.otherMaterial;
  return counts;
}

}  // namespace lambert
