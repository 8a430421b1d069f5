#include "Scene/Core/PointNormals.h"

#include "Common/Core/DisjointSets.h"
#include "Common/Core/Parallel.h"
#include "Scene/Core/FirstEqual.h"

namespace lambert {

namespace {

constexpr int64_t kGrain = 4096;

/// Unit normal of a face in double; zero for one without area.
Vec3d UnitNormal(const TriangleMesh& mesh, int64_t face) {
  const Vec3d p(mesh.Corner(face, 0));
  return Normalize(Cross(Vec3d(mesh.Corner(face, 1)) - p, Vec3d(mesh.Corner(face, 2)) - p));
}

double CornerAngle(const TriangleMesh& mesh, int64_t face, int corner) {
  const Vec3d p(mesh.Corner(face, corner));
  const Vec3d u = Vec3d(mesh.Corner(face, (corner + 1) % 3)) - p;
  const Vec3d v = Vec3d(mesh.Corner(face, (corner + 2) % 3)) - p;
  return std::atan2(Length(Cross(u, v)), Dot(u, v));
}

/// Joins the corners at both ends of every edge that is bent by at most the feature angle.
DisjointSets GroupCorners(const TriangleMesh& mesh, const MeshTopology& topology,
                          const std::vector<Vec3d>& faceNormals, double featureAngle) {
  // A little slack, so that an edge of exactly the feature angle counts as smooth.
  const double cosine = std::cos(featureAngle * kPi / 180) - 1e-9;
  DisjointSets groups(3 * mesh.triangles.size());
  for (int32_t edge = 0; edge < int32_t(topology.neighbor.size()); ++edge) {
    const int32_t across = topology.neighbor[size_t(edge)];
    if (across < edge) continue;
    const size_t face = size_t(edge / 3), other = size_t(across / 3);
    if (topology.against[face] != topology.against[other]) continue;
    if (Dot(faceNormals[face], faceNormals[other]) < cosine) continue;
    const auto end = [](int32_t e) { return e % 3 == 2 ? e - 2 : e + 1; };
    groups.Join(edge, end(across));
    groups.Join(end(edge), across);
  }
  return groups;
}

/// Angle-weighted mean normal of every group, at its root; in the order of the corners.
std::vector<Vec3d> GroupNormals(const TriangleMesh& mesh, const std::vector<Vec3d>& faceNormals,
                                const std::vector<int32_t>& root) {
  std::vector<Vec3d> weighted(root.size()), sum(root.size());
  ParallelForEach(int64_t(root.size()), kGrain, [&](int64_t corner) {
    const int64_t face = corner / 3;
    weighted[size_t(corner)] = faceNormals[size_t(face)] * CornerAngle(mesh, face, int(corner % 3));
  });
  for (size_t corner = 0; corner < root.size(); ++corner) {
    sum[size_t(root[corner])] += weighted[corner];
  }
  return sum;
}

/// The normal that a group delivers: its mean, else that of its first face, else straight up (a
/// point all of whose faces have no area).
Vec3f UsableNormal(const Vec3d& mean, const Vec3d& faceNormal) {
  const double length = Length(mean);
  if (length > 1e-12) return Vec3f(mean / length);
  return LengthSquared(faceNormal) > 0 ? Vec3f(faceNormal) : Vec3f(0, 0, 1);
}

bool IsUsable(const Vec3f& normal) {
  return IsFinite(normal) && LengthSquared(Vec3d(normal)) > 1e-24;
}

void CopyPoint(int32_t point, TriangleMesh* mesh, MeshTopology* topology) {
  mesh->positions.push_back(Vec3f(mesh->positions[size_t(point)]));
  mesh->normals.emplace_back();
  if (!mesh->uvs.empty()) mesh->uvs.push_back(Vec2f(mesh->uvs[size_t(point)]));
  topology->positionId.push_back(int32_t(topology->positionId[size_t(point)]));
}

}  // namespace

bool HasUnitNormals(const TriangleMesh& mesh) {
  constexpr double kRounding = 1e-3;  // Normals are stored with few bits, too.
  return mesh.normals.size() == mesh.positions.size() &&
         std::all_of(mesh.normals.begin(), mesh.normals.end(), [](const Vec3f& normal) {
           return std::abs(LengthSquared(Vec3d(normal)) - 1) <= kRounding;
         });
}

PointNormalCounts CompletePointNormals(double featureAngle, TriangleMesh* mesh,
                                       MeshTopology* topology) {
  // The file's own normals stay.
  const bool hadNormals = !mesh->normals.empty();
  mesh->normals.resize(mesh->positions.size());
  std::vector<uint8_t> missing(mesh->positions.size());
  ParallelForEach(mesh->PointCount(), kGrain, [&](int64_t point) {
    Vec3f& normal = mesh->normals[size_t(point)];
    missing[size_t(point)] = !IsUsable(normal);
    if (!missing[size_t(point)]) normal = Vec3f(Normalize(Vec3d(normal)));
  });
  if (std::find(missing.begin(), missing.end(), 1) == missing.end()) return {};

  // Smooth groups of corners, and the normal of each.
  std::vector<Vec3d> faceNormals(mesh->triangles.size());
  ParallelForEach(mesh->FaceCount(), kGrain,
                  [&](int64_t face) { faceNormals[size_t(face)] = UnitNormal(*mesh, face); });
  DisjointSets groups = GroupCorners(*mesh, *topology, faceNormals, featureAngle);
  std::vector<int32_t> root(3 * mesh->triangles.size()), point(root.size());
  for (size_t corner = 0; corner < root.size(); ++corner) {
    root[corner] = groups.Find(int32_t(corner));
    point[corner] = mesh->triangles[corner / 3][corner % 3];
  }
  const std::vector<Vec3d> groupNormals = GroupNormals(*mesh, faceNormals, root);

  // A point serves its first group; every other group at it gets a copy.
  PointNormalCounts counts;
  int64_t& count = hadNormals ? counts.repaired : counts.made;
  const std::vector<int32_t> first = FirstEqual(
      int64_t(root.size()),
      [&](int64_t i) {
        return HashBits(uint64_t(point[size_t(i)]) << 32 | uint32_t(root[size_t(i)]));
      },
      [&](int64_t i, int64_t j) {
        return point[size_t(i)] == point[size_t(j)] && root[size_t(i)] == root[size_t(j)];
      });
  for (size_t corner = 0; corner < root.size(); ++corner) {
    const int32_t original = point[corner];
    if (!missing[size_t(original)]) continue;
    int32_t& serving = mesh->triangles[corner / 3][corner % 3];
    if (size_t(first[corner]) != corner) {
      serving = mesh->triangles[size_t(first[corner] / 3)][size_t(first[corner] % 3)];
      continue;
    }
    if (missing[size_t(original)] == 2) {
      serving = int32_t(mesh->positions.size());
      CopyPoint(original, mesh, topology);
    }
    missing[size_t(original)] = 2;
    mesh->normals[size_t(serving)] =
        UsableNormal(groupNormals[size_t(root[corner])], faceNormals[corner / 3]);
    ++count;
  }

  // Points of no face.
  for (size_t i = 0; i < missing.size(); ++i) {
    if (missing[i] != 1) continue;
    mesh->normals[i] = {0, 0, 1};
    ++count;
  }
  return counts;
}

}  // namespace lambert
