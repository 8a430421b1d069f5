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

/// Points of a face by position, sorted; with the winding that the sorting undid.
struct CornerSet {
  std::array<int32_t, 3> position;
  bool odd;  ///< the face runs against the ascending order
};

CornerSet SortedCorners(const std::vector<int32_t>& positionId, std::array<int32_t, 3> corners) {
  for (int32_t& corner : corners) corner = positionId[size_t(corner)];
  bool odd = false;
  const auto order = [&](size_t i, size_t j) {
    if (corners[i] <= corners[j]) return;
    std::swap(corners[i], corners[j]);
    odd = !odd;
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  return {corners, odd};
}

bool Emits(const TriangleMesh& mesh, size_t face) {
  return (mesh.faceFlags[face] & (kEmitsFront | kEmitsBack)) && !mesh.emittance[face].IsBlack();
}

/// Emission bits of `face` as seen from the front of a copy with the same or the reverse winding.
uint8_t EmissionSeenFrom(const TriangleMesh& mesh, size_t face, bool sameWinding) {
  const uint8_t bits = mesh.faceFlags[face] & (kEmitsFront | kEmitsBack);
  return sameWinding ? bits : uint8_t((bits >> 1) | ((bits & 1) << 1));
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
  const size_t faces = mesh->triangles.size();
  const std::vector<int32_t> positionId = PositionIds(*mesh);
  std::vector<CornerSet> corners(faces);
  for (size_t i = 0; i < faces; ++i) corners[i] = SortedCorners(positionId, mesh->triangles[i]);
  const std::vector<int32_t> first = FirstEqual(
      int64_t(faces),
      [&](int64_t i) {
        const auto& p = corners[size_t(i)].position;
        return HashBits(uint64_t(p[0]) << 32 | uint32_t(p[1]), uint64_t(p[2]));
      },
      [&](int64_t i, int64_t j) {
        return corners[size_t(i)].position == corners[size_t(j)].position;
      });

  // The first copy that emits stays, else the first.
  std::vector<int32_t> staying(first);
  for (size_t face = 0; face < faces; ++face) {
    int32_t& stays = staying[size_t(first[face])];
    if (!Emits(*mesh, size_t(stays)) && Emits(*mesh, face)) stays = int32_t(face);
  }

  // What the other copies emit must not be lost.
  RepeatCounts counts;
  std::vector<uint8_t> keep(faces, 1);
  std::vector<uint8_t> otherSideKept(faces, 0);
  for (size_t face = 0; face < faces; ++face) {
    const size_t stays = size_t(staying[size_t(first[face])]);
    if (face == stays) continue;
    if (Emits(*mesh, face)) {
      const uint8_t emission =
          EmissionSeenFrom(*mesh, face, corners[face].odd == corners[stays].odd);
      const bool otherSide = (emission & ~mesh->faceFlags[stays]) != 0;
      if (mesh->emittance[face] == mesh->emittance[stays]) {
        mesh->faceFlags[stays] |= emission;
      } else if (otherSide && !otherSideKept[stays]) {
        otherSideKept[stays] = 1;
        continue;
      }
    }
    keep[face] = 0;
    ++counts.removed;
    counts.otherMaterial += mesh->materialId[face] != mesh->materialId[stays];
  }
  if (counts.removed > 0) KeepFaces(keep, mesh);
  return counts;
}

}  // namespace lambert
