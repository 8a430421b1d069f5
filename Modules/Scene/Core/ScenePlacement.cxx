#include "Scene/Core/ScenePlacement.h"

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

void Resize(const PartRanges& ranges, bool uvs, TriangleMesh* world) {
  const size_t faces = size_t(ranges.faceBegin.back()), points = size_t(ranges.pointBegin.back());
  world->positions.resize(points);
  world->normals.resize(points);
  if (uvs) world->uvs.resize(points);
  world->triangles.resize(faces);
  world->reflectance.resize(faces);
  world->emittance.resize(faces);
  world->faceFlags.resize(faces);
  world->materialId.resize(faces);
  world->partId.resize(faces);
  world->sourceCellId.resize(faces);
}

void PlacePoints(const TriangleMesh& object, const Placement& placement, int64_t begin,
                 TriangleMesh* world) {
  ParallelForEach(object.PointCount(), kGrain, [&](int64_t i) {
    const size_t from = size_t(i), to = size_t(begin + i);
    world->positions[to] = placement.Point(object.positions[from]);
    world->normals[to] = placement.Normal(object.normals[from]);
    if (!object.uvs.empty()) world->uvs[to] = Vec2f(object.uvs[from]);
  });
}

void PlaceFaces(const TriangleMesh& object, bool mirrors, int32_t part, int64_t faceBegin,
                int64_t pointBegin, TriangleMesh* world) {
  ParallelForEach(object.FaceCount(), kGrain, [&](int64_t i) {
    const size_t from = size_t(i), to = size_t(faceBegin + i);
    std::array<int32_t, 3> corners = object.triangles[from];
    for (int32_t& corner : corners) corner += int32_t(pointBegin);
    if (mirrors) std::swap(corners[1], corners[2]);
    world->triangles[to] = corners;
    world->reflectance[to] = Spectrum(object.reflectance[from]);
    world->emittance[to] = Spectrum(object.emittance[from]);
    world->faceFlags[to] = object.faceFlags[from];
    world->materialId[to] = object.materialId[from];
    world->partId[to] = part;
    world->sourceCellId[to] = object.sourceCellId[from];
  });
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

TriangleMesh PlaceParts(const std::vector<CleanedMesh>& meshes, const std::vector<Part>& parts,
                        const PartRanges& ranges) {
  constexpr int64_t kMost = std::numeric_limits<int32_t>::max();
  if (3 * ranges.faceBegin.back() > kMost || ranges.pointBegin.back() > kMost) {
    throw Error("The scene has " + std::to_string(ranges.faceBegin.back()) +
                " triangles with all instances; at most " + std::to_string(kMost / 3) +
                " can be solved.");
  }
  bool uvs = false;
  for (const Part& part : parts) uvs |= !meshes[size_t(part.meshId)].mesh.uvs.empty();

  TriangleMesh world;
  Resize(ranges, uvs, &world);
  ParallelForEach(int64_t(parts.size()), 1, [&](int64_t i) {
    const Part& part = parts[size_t(i)];
    const TriangleMesh& object = meshes[size_t(part.meshId)].mesh;
    const Placement placement(part.objectToWorld);
    const int64_t pointBegin = ranges.pointBegin[size_t(i)];
    PlacePoints(object, placement, pointBegin, &world);
    PlaceFaces(object, placement.Mirrors(), int32_t(i), ranges.faceBegin[size_t(i)], pointBegin,
               &world);
  });
  for (const Vec3f& position : world.positions) {
    if (!IsFinite(position)) {
      throw Error("A part's matrix takes a point out of the range of numbers; repair the input.");
    }
  }
  ReplaceLostNormals(&world);
  return world;
}

}  // namespace lambert
