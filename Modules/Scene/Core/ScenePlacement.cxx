#include "Scene/Core/ScenePlacement.h"

#include <algorithm>
#include <limits>

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"

namespace lambert {

namespace {

constexpr int64_t kGrain = 16384;

/// Object to world: p -> linear p + translation.
class Placement {
 public:
  explicit Placement(const std::array<double, 16>& m)
      : x_(m[0], m[1], m[2]),
        y_(m[4], m[5], m[6]),
        z_(m[8], m[9], m[10]),
        translation_(m[3], m[7], m[11]),
        mirrors_(Dot(x_, Cross(y_, z_)) < 0) {}

  bool Mirrors() const { return mirrors_; }
  Vec3f Point(const Vec3f& point) const {
    const Vec3d p(point);
    return Vec3f(Vec3d(Dot(x_, p), Dot(y_, p), Dot(z_, p)) + translation_);
  }
  /// The inverse transpose up to a positive factor: the cofactors, turned where the matrix mirrors.
  Vec3f Normal(const Vec3f& normal) const {
    const Vec3d n(normal);
    const Vec3d world(Dot(Cross(y_, z_), n), Dot(Cross(z_, x_), n), Dot(Cross(x_, y_), n));
    return Vec3f(Normalize(mirrors_ ? -world : world));
  }

 private:
  Vec3d x_, y_, z_;  ///< rows
  Vec3d translation_;
  bool mirrors_;
};

/// Places an array of the parts' meshes in the world. `place(part, value)` is the value there.
template <class T, class Place>
void PlaceArray(std::vector<T> TriangleMesh::*array, const std::vector<Part>& parts,
                const std::vector<int64_t>& begin, const Place& place,
                const std::vector<CleanedMesh>& meshes, TriangleMesh* world) {
  std::vector<T>& placed = world->*array;
  placed.resize(size_t(begin.back()));
  ParallelForEach(int64_t(parts.size()), 1, [&](int64_t part) {
    const std::vector<T>& values = meshes[size_t(parts[size_t(part)].meshId)].mesh.*array;
    T* const to = placed.data() + begin[size_t(part)];
    ParallelForEach(int64_t(values.size()), kGrain,
                    [&](int64_t i) { to[i] = place(size_t(part), values[size_t(i)]); });
  });
}

/// The same, and frees it in the meshes: two of a kind are all that there ever is.
template <class T, class Place>
void MoveArray(std::vector<T> TriangleMesh::*array, const std::vector<Part>& parts,
               const std::vector<int64_t>& begin, const Place& place,
               std::vector<CleanedMesh>* meshes, TriangleMesh* world) {
  PlaceArray(array, parts, begin, place, *meshes, world);
  for (CleanedMesh& cleaned : *meshes) cleaned.mesh.*array = std::vector<T>();
}

void PlacePoints(const std::vector<Part>& parts, const std::vector<Placement>& placements,
                 const PartRanges& ranges, std::vector<CleanedMesh>* meshes, TriangleMesh* world) {
  const auto move = [&](auto array, const auto& value) {
    MoveArray(array, parts, ranges.pointBegin, value, meshes, world);
  };
  move(&TriangleMesh::positions,
       [&](size_t part, const Vec3f& p) { return placements[part].Point(p); });
  move(&TriangleMesh::normals,
       [&](size_t part, const Vec3f& n) { return placements[part].Normal(n); });
  const bool uvs = std::any_of(parts.begin(), parts.end(), [&](const Part& part) {
    return !(*meshes)[size_t(part.meshId)].mesh.uvs.empty();
  });
  if (uvs) move(&TriangleMesh::uvs, [](size_t, const Vec2f& uv) { return Vec2f(uv); });
}

void PlaceFaces(const std::vector<Part>& parts, const std::vector<Placement>& placements,
                const PartRanges& ranges, std::vector<CleanedMesh>* meshes, TriangleMesh* world) {
  const auto move = [&](auto array, const auto& value) {
    MoveArray(array, parts, ranges.faceBegin, value, meshes, world);
  };
  const auto stays = [](size_t, const auto& value) { return value; };
  const auto placeCorners = [&](size_t part, std::array<int32_t, 3> corners) {
    for (int32_t& corner : corners) corner += int32_t(ranges.pointBegin[part]);
    if (placements[part].Mirrors()) std::swap(corners[1], corners[2]);
    return corners;
  };
  PlaceArray(&TriangleMesh::triangles, parts, ranges.faceBegin, placeCorners, *meshes, world);
  move(&TriangleMesh::reflectance, stays);
  move(&TriangleMesh::emittance, stays);
  move(&TriangleMesh::faceFlags, stays);
  move(&TriangleMesh::materialId, stays);
  move(&TriangleMesh::partId, [](size_t part, int32_t) { return int32_t(part); });
  move(&TriangleMesh::sourceCellId, stays);
}

/// A flattening matrix leaves a normal no length; it takes that of a face there.
void ReplaceLostNormals(TriangleMesh* world) {
  for (int64_t face = 0; face < world->FaceCount(); ++face) {
    for (const int32_t point : world->triangles[size_t(face)]) {
      Vec3f& normal = world->normals[size_t(point)];
      if (LengthSquared(normal) == 0) normal = world->FrontNormal(face);
    }
  }
  for (Vec3f& normal : world->normals) {
    if (LengthSquared(normal) == 0) normal = {0, 0, 1};
  }
}

}  // namespace

PartRanges RangesOfParts(const std::vector<CleanedMesh>& meshes, const std::vector<Part>& parts) {
  PartRanges ranges{{0}, {0}, {0}};
  for (const Part& part : parts) {
    const CleanedMesh& cleaned = meshes[size_t(part.meshId)];
    ranges.faceBegin.push_back(ranges.faceBegin.back() + cleaned.mesh.FaceCount());
    ranges.pointBegin.push_back(ranges.pointBegin.back() + cleaned.mesh.PointCount());
    ranges.pieceBegin.push_back(ranges.pieceBegin.back() + cleaned.topology.PieceCount());
  }
  return ranges;
}

TriangleMesh PlaceParts(const std::vector<Part>& parts, const PartRanges& ranges,
                        std::vector<CleanedMesh>* meshes) {
  constexpr int64_t kMost = std::numeric_limits<int32_t>::max();
  if (3 * ranges.faceBegin.back() > kMost || ranges.pointBegin.back() > kMost) {
    throw Error("The scene has " + std::to_string(ranges.faceBegin.back()) +
                " triangles with all instances; at most " + std::to_string(kMost / 3) +
                " can be solved.");
  }
  std::vector<Placement> placements;
  for (const Part& part : parts) placements.emplace_back(part.objectToWorld);
  TriangleMesh world;
  PlacePoints(parts, placements, ranges, meshes, &world);
  PlaceFaces(parts, placements, ranges, meshes, &world);
  for (const Vec3f& position : world.positions) {
    if (!IsFinite(position)) {
      throw Error("A part's matrix takes a point out of the range of numbers; repair the input.");
    }
  }
  ReplaceLostNormals(&world);
  return world;
}

}  // namespace lambert
