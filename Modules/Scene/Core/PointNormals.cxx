#include "Scene/Core/PointNormals.h"

#include <algorithm>
#include <array>
#include <utility>

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

/// Per half-edge: 1 where its edge is bent by at most the feature angle; told at the lower of the
/// two that meet there.
std::vector<uint8_t> SmoothEdges(const TriangleMesh& mesh, const MeshTopology& topology,
                                 double featureAngle) {
  // A little slack, so that an edge of exactly the feature angle counts as smooth.
  const double cosine = std::cos(featureAngle * kPi / 180) - 1e-9;
  std::vector<uint8_t> smooth(topology.neighbor.size(), 0);
  ParallelForEach(mesh.FaceCount(), kGrain, [&](int64_t face) {
    const Vec3d normal = UnitNormal(mesh, face);
    for (size_t edge = size_t(3 * face); edge < size_t(3 * face + 3); ++edge) {
      const int32_t across = topology.neighbor[edge];
      if (across < int32_t(edge)) continue;
      const int64_t other = across / 3;
      if (topology.against[size_t(face)] != topology.against[size_t(other)]) continue;
      smooth[edge] = Dot(normal, UnitNormal(mesh, other)) >= cosine;
    }
  });
  return smooth;
}

/// Corners whose faces are smooth about their point.
struct CornerGroups {
  std::vector<int32_t> ofCorner;  ///< in the order of their first corners
  std::vector<Vec3d> normal;      ///< per group: mean of its faces, weighted by angle
};

/// Joins the corners at both ends of every smooth edge.
CornerGroups GroupCorners(const MeshTopology& topology, const std::vector<uint8_t>& smooth) {
  DisjointSets sets(smooth.size());
  for (int32_t edge = 0; edge < int32_t(smooth.size()); ++edge) {
    if (!smooth[size_t(edge)]) continue;
    const int32_t across = topology.neighbor[size_t(edge)];
    const auto end = [](int32_t e) { return e % 3 == 2 ? e - 2 : e + 1; };
    sets.Join(edge, end(across));
    sets.Join(end(edge), across);
  }
  CornerGroups groups;
  groups.ofCorner.resize(smooth.size());
  int32_t count = 0;
  for (int32_t corner = 0; corner < int32_t(smooth.size()); ++corner) {
    const int32_t first = sets.Find(corner);
    groups.ofCorner[size_t(corner)] = first == corner ? count++ : groups.ofCorner[size_t(first)];
  }
  groups.normal.resize(size_t(count));
  return groups;
}

/// Angle-weighted mean normal of every group; in the order of the corners.
void AddNormals(const TriangleMesh& mesh, CornerGroups* groups) {
  constexpr int64_t kBlock = 1 << 16;  // faces
  std::vector<std::array<Vec3d, 3>> weighted(size_t(std::min(kBlock, mesh.FaceCount())));
  for (int64_t begin = 0; begin < mesh.FaceCount(); begin += kBlock) {
    const int64_t count = std::min(kBlock, mesh.FaceCount() - begin);
    ParallelForEach(count, kGrain, [&](int64_t i) {
      const Vec3d normal = UnitNormal(mesh, begin + i);
      for (int c = 0; c < 3; ++c) {
        weighted[size_t(i)][size_t(c)] = normal * CornerAngle(mesh, begin + i, c);
      }
    });
    for (int64_t corner = 0; corner < 3 * count; ++corner) {
      groups->normal[size_t(groups->ofCorner[size_t(3 * begin + corner)])] +=
          weighted[size_t(corner / 3)][size_t(corner % 3)];
    }
  }
}

/// For each corner the first of its group and point.
class FirstCorners {
 public:
  FirstCorners(const TriangleMesh& mesh, const CornerGroups& groups)
      : mesh_(mesh), groups_(groups), ofGroup_(groups.normal.size(), -1) {
    // Most groups are about one point: the corners of other points are few.
    std::vector<int32_t> others;
    for (int32_t corner = 0; corner < int32_t(groups.ofCorner.size()); ++corner) {
      int32_t& first = ofGroup_[this->Group(corner)];
      if (first < 0) first = corner;
      if (this->Point(first) != this->Point(corner)) others.push_back(corner);
    }
    const std::vector<int32_t> first = FirstEqual(
        int64_t(others.size()),
        [&](int64_t i) {
          const int32_t corner = others[size_t(i)];
          return HashBits(uint64_t(this->Point(corner)) << 32 | uint32_t(this->Group(corner)));
        },
        [&](int64_t i, int64_t j) {
          const int32_t a = others[size_t(i)], b = others[size_t(j)];
          return this->Point(a) == this->Point(b) && this->Group(a) == this->Group(b);
        });
    for (size_t i = 0; i < others.size(); ++i) {
      firstOfOther_.emplace_back(others[i], others[size_t(first[i])]);
    }
  }

  /// Corners are asked for in ascending order; those asked so far may have other points by now.
  int32_t Next(int32_t corner) {
    if (next_ == firstOfOther_.size() || firstOfOther_[next_].first != corner) {
      return ofGroup_[this->Group(corner)];
    }
    return firstOfOther_[next_++].second;
  }

 private:
  size_t Group(int32_t corner) const { return size_t(groups_.ofCorner[size_t(corner)]); }
  int32_t Point(int32_t corner) const {
    return mesh_.triangles[size_t(corner / 3)][size_t(corner % 3)];
  }

  const TriangleMesh& mesh_;
  const CornerGroups& groups_;
  std::vector<int32_t> ofGroup_;                           ///< of the group's first point
  std::vector<std::pair<int32_t, int32_t>> firstOfOther_;  ///< corners of other points, ascending
  size_t next_ = 0;
};

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
  CornerGroups groups = GroupCorners(*topology, SmoothEdges(*mesh, *topology, featureAngle));
  AddNormals(*mesh, &groups);

  // A point serves its first group; every other group at it gets a copy.
  PointNormalCounts counts;
  int64_t& count = hadNormals ? counts.repaired : counts.made;
  FirstCorners firstCorners(*mesh, groups);
  for (int32_t corner = 0; corner < int32_t(groups.ofCorner.size()); ++corner) {
    const int32_t first = firstCorners.Next(corner);
    int32_t& serving = mesh->triangles[size_t(corner / 3)][size_t(corner % 3)];
    const int32_t original = serving;
    if (!missing[size_t(original)]) continue;
    if (first != corner) {
      serving = mesh->triangles[size_t(first / 3)][size_t(first % 3)];
      continue;
    }
    if (missing[size_t(original)] == 2) {
      serving = int32_t(mesh->positions.size());
      CopyPoint(original, mesh, topology);
    }
    missing[size_t(original)] = 2;
    mesh->normals[size_t(serving)] = UsableNormal(
        groups.normal[size_t(groups.ofCorner[size_t(corner)])], UnitNormal(*mesh, corner / 3));
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
