#include "Scene/Core/FacingEmitters.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>

#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"
#include "Scene/Core/MeshRepair.h"

namespace lambert {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using TrianglePrimitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using TriangleTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, TrianglePrimitive>>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Points from which a lamp looks ahead and behind, and the least of them on each of its faces.
constexpr double kPoints = 32, kPointsOfFace = 4;

/// What counts as no distance, m.
struct Gaps {
  double plane;           ///< up to here: in the lamp's own plane
  double least, largest;  ///< bounds of what is no distance
};

Gaps GapsOf(const Box3f& bounds) {
  const double diagonal = bounds.Diagonal();
  double extreme = diagonal;
  for (int axis = 0; axis < 3; ++axis) {
    extreme = std::max(
        {extreme, double(std::abs(bounds.low[axis])), double(std::abs(bounds.high[axis]))});
  }
  return {1e-6 * extreme, 1e-5 * diagonal, 1e-3 * diagonal};
}

/// Faces too small or too large for their area to be a number are left alone.
bool EmitsFromOneSide(const TriangleMesh& mesh, int64_t face) {
  if (mesh.Emits(face, kFront) == mesh.Emits(face, kBack)) return false;
  const double area = mesh.Area(face);
  return !mesh.emittance[size_t(face)].IsBlack() && area > 0 && area < kInfinity &&
         !HasNoArea(mesh.Corner(face, 0), mesh.Corner(face, 1), mesh.Corner(face, 2));
}

/// Towards where the face emits.
Vec3d EmissionNormal(const TriangleMesh& mesh, int64_t face) {
  const Vec3d front = Normalize(Vec3d(mesh.FrontNormal(face)));
  return mesh.Emits(face, kFront) ? front : -front;
}

/// Connected faces of one material that emit from one side each.
struct Lamp {
  double area = 0, perimeter = 0;

  /// Between two plates at a distance h that is small for them, h perimeter / (2 area) of the light
  /// finds the rim: at most 5 % of it, less than the error that a solution is asked for. No plate
  /// has less rim than a disc.
  double NoDistance(const Gaps& gaps) const {
    const double rim = std::max(perimeter, 2 * std::sqrt(kPi * area));
    return std::clamp(0.1 * area / rim, gaps.least, gaps.largest);
  }
};

/// The faces of a lamp that emit to the outside of the piece as it is wound, or those to the
/// inside.
struct LampSide {
  int32_t lamp;
  std::vector<int64_t> faces;
};

class Lamps {
 public:
  Lamps(const std::vector<CleanedMesh>& meshes, const PartRanges& ranges, const Scene& scene)
      : mesh_(scene.mesh), lampOf_(scene.mesh.triangles.size(), -1) {
    for (size_t part = 0; part < scene.parts.size(); ++part) {
      const CleanedMesh& object = meshes[size_t(scene.parts[part].meshId)];
      for (int64_t face = ranges.faceBegin[part]; face < ranges.faceBegin[part + 1]; ++face) {
        if (lampOf_[size_t(face)] < 0 && EmitsFromOneSide(mesh_, face)) {
          WalkLamp(object, ranges.faceBegin[part], ranges.pointBegin[part], face);
        }
      }
    }
  }

  int64_t Count() const { return int64_t(lamps_.size()); }
  const Lamp& operator[](int32_t lamp) const { return lamps_[size_t(lamp)]; }
  const std::vector<LampSide>& Sides() const { return sides_; }
  /// -1 for a face of none.
  int32_t LampOf(int64_t face) const { return lampOf_[size_t(face)]; }

 private:
  void WalkLamp(const CleanedMesh& object, int64_t faceBegin, int64_t pointBegin, int64_t seed) {
    const int32_t id = int32_t(lamps_.size());
    Lamp& lamp = lamps_.emplace_back();
    LampSide sides[2]{{id, {}}, {id, {}}};
    std::vector<int64_t> walk{seed};
    lampOf_[size_t(seed)] = id;
    for (size_t i = 0; i < walk.size(); ++i) {
      const int64_t face = walk[i], inMesh = face - faceBegin;
      const bool against = object.topology.against[size_t(inMesh)];
      sides[mesh_.Emits(face, kFront) == against].faces.push_back(face);
      lamp.area += mesh_.Area(face);
      for (int corner = 0; corner < 3; ++corner) {
        const int32_t across = object.topology.neighbor[size_t(3 * inMesh + corner)];
        const int64_t other = across < 0 ? -1 : faceBegin + across / 3;
        if (other >= 0 && lampOf_[size_t(other)] < 0 && IsSameLamp(face, other)) {
          lampOf_[size_t(other)] = id;
          walk.push_back(other);
        }
        if (other < 0 || lampOf_[size_t(other)] != id) {
          lamp.perimeter += EdgeLength(object.mesh, inMesh, corner, pointBegin);
        }
      }
    }
    for (LampSide& side : sides) {
      if (!side.faces.empty()) sides_.push_back(std::move(side));
    }
  }

  bool IsSameLamp(int64_t face, int64_t other) const {
    return EmitsFromOneSide(mesh_, other) &&
           mesh_.materialId[size_t(face)] == mesh_.materialId[size_t(other)];
  }

  /// Edges are numbered in the object's mesh: a mirroring matrix exchanges corners in the world's.
  double EdgeLength(const TriangleMesh& object, int64_t face, int corner,
                    int64_t pointBegin) const {
    const std::array<int32_t, 3>& t = object.triangles[size_t(face)];
    const int64_t a = pointBegin + t[size_t(corner)], b = pointBegin + t[size_t(corner + 1) % 3];
    return Length(Vec3d(mesh_.positions[size_t(b)]) - Vec3d(mesh_.positions[size_t(a)]));
  }

  const TriangleMesh& mesh_;
  std::vector<int32_t> lampOf_;
  std::vector<Lamp> lamps_;
  std::vector<LampSide> sides_;
};

/// A tree over some faces of the mesh.
class FaceTree {
 public:
  FaceTree(const TriangleMesh& mesh, std::vector<int64_t> faces) : faces_(std::move(faces)) {
    triangles_.reserve(faces_.size());
    for (const int64_t face : faces_) {
      triangles_.emplace_back(ToPoint(mesh.Corner(face, 0)), ToPoint(mesh.Corner(face, 1)),
                              ToPoint(mesh.Corner(face, 2)));
    }
    tree_.insert(triangles_.begin(), triangles_.end());
    tree_.build();
  }

  bool Touches(const Box3f& box, double margin) const {
    return tree_.do_intersect(CGAL::Bbox_3(box.low.x - margin, box.low.y - margin,
                                           box.low.z - margin, box.high.x + margin,
                                           box.high.y + margin, box.high.z + margin));
  }

  /// Distance of the first face along a unit direction for which counts(face); infinite where there
  /// is none, or where it is met edge-on.
  template <class Counts>
  double FirstHit(const Vec3d& origin, const Vec3d& direction, const Counts& counts) const {
    const Kernel::Ray_3 ray(ToPoint(origin),
                            Kernel::Vector_3(direction.x, direction.y, direction.z));
    const auto isSkipped = [&](const Triangles::const_iterator& triangle) {
      return !counts(faces_[size_t(triangle - triangles_.begin())]);
    };
    // A tree of one triangle skips nothing by itself.
    const auto hit = tree_.first_intersection(ray, isSkipped);
    if (!hit || isSkipped(hit->second)) return kInfinity;
    const Kernel::Point_3* point = boost::get<Kernel::Point_3>(&hit->first);
    return point ? std::sqrt(CGAL::squared_distance(*point, ray.source())) : kInfinity;
  }

 private:
  template <class Vector>
  static Kernel::Point_3 ToPoint(const Vector& p) {
    return {double(p.x), double(p.y), double(p.z)};
  }

  std::vector<int64_t> faces_;
  Triangles triangles_;
  TriangleTree tree_;
};

/// These faces and all that lie within `margin` of their boxes.
std::vector<int64_t> FacesNear(const TriangleMesh& mesh, const std::vector<int64_t>& center,
                               double margin) {
  const FaceTree tree(mesh, center);
  std::vector<uint8_t> isNear(mesh.triangles.size(), 0);
  ParallelForEach(mesh.FaceCount(), 4096, [&](int64_t face) {
    Box3f box;
    for (int corner = 0; corner < 3; ++corner) box.Include(mesh.Corner(face, corner));
    isNear[size_t(face)] =
        tree.Touches(box, margin) &&
        !HasNoArea(mesh.Corner(face, 0), mesh.Corner(face, 1), mesh.Corner(face, 2));
  });
  std::vector<int64_t> faces;
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    if (isNear[size_t(face)]) faces.push_back(face);
  }
  return faces;
}

/// What lies close before and behind some faces of lamps.
class Surroundings {
 public:
  Surroundings(const TriangleMesh& mesh, const Lamps& lamps, const Gaps& gaps,
               const std::vector<int64_t>& faces)
      : mesh_(mesh),
        lamps_(lamps),
        gaps_(gaps),
        tree_(mesh, FacesNear(mesh, faces, gaps.largest)) {}

  /// True where these faces of a lamp see nothing but a surface at no distance, from at least as
  /// many points.
  bool AreCovered(int32_t lamp, const std::vector<int64_t>& faces, double points) const {
    return !AnySample(faces, points, [&](const Vec3d& point, const Vec3d& normal) {
      return !IsBlockedAhead(lamp, point, normal);
    });
  }

  /// True where something else is seen from behind them.
  bool SeeFromBehind(int32_t lamp, const std::vector<int64_t>& faces) const {
    return AnySample(faces, kPoints, [&](const Vec3d& point, const Vec3d& normal) {
      return SeesFromBehind(lamp, point, normal);
    });
  }

 private:
  /// True where holds(point, normal towards the emission) for one of the points of the faces.
  template <class Holds>
  bool AnySample(const std::vector<int64_t>& faces, double points, const Holds& holds) const {
    double area = 0;
    for (const int64_t face : faces) area += mesh_.Area(face);
    for (const int64_t face : faces) {
      const Vec3d normal = EmissionNormal(mesh_, face);
      const uint32_t count =
          uint32_t(std::max(kPointsOfFace, std::ceil(points * mesh_.Area(face) / area)));
      Random random(static_cast<uint64_t>(face));
      const float shift = random.Uniform();
      for (uint32_t i = 0; i < count; ++i) {
        const float stratum = (float(i) + random.Uniform()) / float(count);
        const Vec2f b = UniformTriangle(stratum, RadicalInverse(i, shift));
        if (holds(PointOn(face, b), normal)) return true;
      }
    }
    return false;
  }

  Vec3d PointOn(int64_t face, const Vec2f& b) const {
    const Vec3d p(mesh_.Corner(face, 0));
    return p + (Vec3d(mesh_.Corner(face, 1)) - p) * double(b.x) +
           (Vec3d(mesh_.Corner(face, 2)) - p) * double(b.y);
  }

  bool IsBlockedAhead(int32_t lamp, const Vec3d& point, const Vec3d& normal) const {
    const auto isOther = [&](int64_t face) { return lamps_.LampOf(face) != lamp; };
    const Vec3d start = point + normal * gaps_.plane;
    return tree_.FirstHit(start, normal, isOther) <= lamps_[lamp].NoDistance(gaps_) - gaps_.plane;
  }

  /// Nothing at no distance, not even in the lamp's own plane; the lamp itself nowhere.
  bool SeesFromBehind(int32_t lamp, const Vec3d& point, const Vec3d& normal) const {
    const auto isOther = [&](int64_t face) { return lamps_.LampOf(face) != lamp; };
    const auto isOwn = [&](int64_t face) { return lamps_.LampOf(face) == lamp; };
    const Vec3d before = point + normal * gaps_.plane, behind = point - normal * gaps_.plane;
    const double noDistance = lamps_[lamp].NoDistance(gaps_) + gaps_.plane;
    return tree_.FirstHit(before, -normal, isOther) > noDistance &&
           tree_.FirstHit(behind, -normal, isOwn) == kInfinity;
  }

  const TriangleMesh& mesh_;
  const Lamps& lamps_;
  const Gaps gaps_;
  const FaceTree tree_;
};

/// The sides for which holds(side), in their order.
template <class Holds>
std::vector<LampSide> Select(const std::vector<LampSide>& sides, const Holds& holds) {
  std::vector<uint8_t> keep(sides.size());
  ParallelForEach(int64_t(sides.size()), 1,
                  [&](int64_t i) { keep[size_t(i)] = holds(sides[size_t(i)]); });
  std::vector<LampSide> kept;
  for (size_t i = 0; i < sides.size(); ++i) {
    if (keep[i]) kept.push_back(sides[i]);
  }
  return kept;
}

/// Lamps that face a surface at no distance, the faces of either winding for themselves.
std::vector<LampSide> FacingSides(const TriangleMesh& mesh, const Lamps& lamps) {
  const Gaps gaps = GapsOf(mesh.Bounds());

  if (!(gaps.largest < kInfinity)) return {};

  // Most are cleared by a look from one face of theirs.
  std::vector<int64_t> faces;
  for (const LampSide& side : lamps.Sides()) faces.push_back(side.faces.front());
  const Surroundings ofOneFace(mesh, lamps, gaps, faces);
  const std::vector<LampSide> suspects = Select(lamps.Sides(), [&](const LampSide& side) {
    return ofOneFace.AreCovered(side.lamp, {side.faces.front()}, kPointsOfFace);
  });
  if (suspects.empty()) return {};

  // The others see nothing else from any face, but do from behind.
  std::vector<uint8_t> isSuspect(size_t(lamps.Count()), 0);
  for (const LampSide& side : suspects) isSuspect[size_t(side.lamp)] = 1;
  faces.clear();
  for (const LampSide& side : lamps.Sides()) {
    if (isSuspect[size_t(side.lamp)]) {
      faces.insert(faces.end(), side.faces.begin(), side.faces.end());
    }
  }
  const Surroundings ofAllFaces(mesh, lamps, gaps, faces);
  return Select(suspects, [&](const LampSide& side) {
    return ofAllFaces.AreCovered(side.lamp, side.faces, kPoints) &&
           ofAllFaces.SeeFromBehind(side.lamp, side.faces);
  });
}

}  // namespace

std::vector<int64_t> TurnFacingEmitters(const std::vector<CleanedMesh>& meshes,
                                        const PartRanges& ranges, Scene* scene) {
  TriangleMesh& mesh = scene->mesh;
  std::vector<int64_t> turnedOfMaterial(scene->materials.size(), 0);
  const Lamps lamps(meshes, ranges, *scene);
  if (lamps.Sides().empty()) return turnedOfMaterial;
  for (const LampSide& side : FacingSides(mesh, lamps)) {
    for (const int64_t face : side.faces) {
      mesh.faceFlags[size_t(face)] ^= kEmitsFront | kEmitsBack;
    }
    ++turnedOfMaterial[size_t(mesh.materialId[size_t(side.faces.front())])];
  }
  return turnedOfMaterial;
}

}  // namespace lambert
