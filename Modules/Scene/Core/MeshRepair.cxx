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

/// A face as the file has it: a polygon's triangles, or a single triangle.
struct Polygon {
  size_t begin, end;              ///< faces
  size_t cornerBegin, cornerEnd;  ///< its positions, sorted, each once, in the list of all
  Vec3d vectorArea;               ///< of its outline, whichever way it was cut into triangles
  double area = 0;
};

struct Polygons {
  std::vector<Polygon> list;
  std::vector<int32_t> corners;
};

/// The triangles of one source cell, or each triangle by itself.
Polygons CollectPolygons(const TriangleMesh& mesh, bool bySourceCell) {
  const std::vector<int32_t> positionId = PositionIds(mesh);
  Polygons polygons;
  for (size_t begin = 0, end = 0; begin < mesh.triangles.size(); begin = end) {
    end = begin + 1;
    while (bySourceCell && end < mesh.triangles.size() &&
           mesh.sourceCellId[end] == mesh.sourceCellId[begin]) {
      ++end;
    }
    Polygon polygon{begin, end, polygons.corners.size(), 0, {}};
    for (size_t face = begin; face < end; ++face) {
      const Vec3d p(mesh.Corner(int64_t(face), 0));
      const Vec3d area = Cross(Vec3d(mesh.Corner(int64_t(face), 1)) - p,
                               Vec3d(mesh.Corner(int64_t(face), 2)) - p) *
                         0.5;
      polygon.vectorArea += area;
      polygon.area += Length(area);
      for (const int32_t point : mesh.triangles[face]) {
        polygons.corners.push_back(int32_t(positionId[size_t(point)]));
      }
    }
    const auto first = polygons.corners.begin() + int64_t(polygon.cornerBegin);
    std::sort(first, polygons.corners.end());
    polygons.corners.erase(std::unique(first, polygons.corners.end()), polygons.corners.end());
    polygon.cornerEnd = polygons.corners.size();
    polygons.list.push_back(polygon);
  }
  return polygons;
}

/// The same positions and, up to the winding, the same vector area: the same outline.
bool SameOutline(const Polygons& polygons, const Polygon& a, const Polygon& b) {
  const int32_t* corners = polygons.corners.data();
  if (!std::equal(corners + a.cornerBegin, corners + a.cornerEnd, corners + b.cornerBegin,
                  corners + b.cornerEnd)) {
    return false;
  }
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
  return FirstEqual(
      int64_t(polygons.list.size()),
      [&](int64_t i) {
        const Polygon& polygon = polygons.list[size_t(i)];
        uint64_t hash = 0;
        for (size_t k = polygon.cornerBegin; k < polygon.cornerEnd; ++k) {
          hash = HashBits(hash, uint64_t(polygons.corners[k]));
        }
        return hash;
      },
      [&](int64_t i, int64_t j) {
        return SameOutline(polygons, polygons.list[size_t(i)], polygons.list[size_t(j)]);
      });
}

RepeatCounts RemoveRepeatedPolygons(const Polygons& polygons, TriangleMesh* mesh) {
  // The first copy that emits stays, else the first.
  const std::vector<Polygon>& list = polygons.list;
  const std::vector<int32_t> first = FirstCopies(polygons);
  std::vector<int32_t> staying(first);
  for (size_t i = 0; i < list.size(); ++i) {
    int32_t& stays = staying[size_t(first[i])];
    if (!Emits(*mesh, list[size_t(stays)].begin) && Emits(*mesh, list[i].begin)) stays = int32_t(i);
  }

  // What the other copies emit must not be lost.
  RepeatCounts counts;
  std::vector<uint8_t> keep(mesh->triangles.size(), 1), otherSideKept(list.size(), 0);
  for (size_t i = 0; i < list.size(); ++i) {
    const size_t stays = size_t(staying[size_t(first[i])]);
    const Polygon &copy = list[i], &kept = list[stays];
    if (i == stays) continue;
    if (Emits(*mesh, copy.begin)) {
      const bool sameWinding = Dot(copy.vectorArea, kept.vectorArea) > 0;
      const uint8_t emission = EmissionSeenFrom(*mesh, copy.begin, sameWinding);
      const bool otherSide = (emission & ~mesh->faceFlags[kept.begin]) != 0;
      if (mesh->emittance[copy.begin] == mesh->emittance[kept.begin]) {
        for (size_t face = kept.begin; face < kept.end; ++face) mesh->faceFlags[face] |= emission;
      } else if (otherSide && !otherSideKept[stays]) {
        otherSideKept[stays] = 1;
        continue;
      }
    }
    for (size_t face = copy.begin; face < copy.end; ++face) {
      keep[face] = 0;
      ++counts.removed;
      counts.otherMaterial += mesh->materialId[face] != mesh->materialId[kept.begin];
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
  Polygons polygons = CollectPolygons(*mesh, true);
  if (polygons.list.size() < mesh->triangles.size()) {
    counts = RemoveRepeatedPolygons(polygons, mesh);
    polygons = CollectPolygons(*mesh, false);
  }
  const RepeatCounts single = RemoveRepeatedPolygons(polygons, mesh);
  counts.removed += single.removed;
  counts.otherMaterial += single.otherMaterial;
  return counts;
}

}  // namespace lambert
