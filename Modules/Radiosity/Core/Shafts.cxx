#include "Radiosity/Core/Shafts.h"

#include <cmath>

#include "Common/Core/PolygonIrradiance.h"

namespace lambert {

namespace {

/// A half-space: what lies in it has Dot(normal, x) <= offset.
struct Plane {
  Vec3f normal;
  float offset = 0;
  float Over(const Vec3f& x) const { return Dot(normal, x) - offset; }
};

/// Least height of a box over a plane.
float LeastOver(const Plane& plane, const Box3f& box) {
  Vec3f lowest;
  for (int axis = 0; axis < 3; ++axis) {
    lowest[axis] = plane.normal[axis] > 0 ? box.low[axis] : box.high[axis];
  }
  return plane.Over(lowest);
}

/// Where the segment from `a` to `b` crosses a triangle, as a fraction of it; -1 where it does not.
float Crossing(const Vec3f& a, const Vec3f& b, const std::array<Vec3f, 3>& triangle) {
  const Vec3f way = b - a, u = triangle[1] - triangle[0], v = triangle[2] - triangle[0];
  const Vec3f p = Cross(way, v);
  const float determinant = Dot(u, p);
  if (determinant == 0) return -1;
  const Vec3f offset = a - triangle[0], q = Cross(offset, u);
  const float s = Dot(offset, p) / determinant, t = Dot(way, q) / determinant;
  return s > 0 && t > 0 && s + t < 1 ? Dot(v, q) / determinant : -1;
}

}  // namespace

/// The convex hull of two polygons, less what lies behind either.
struct Shafts::Hull {
  std::vector<Plane> planes;
  float margin = 0;

  Hull(const std::vector<Vec3f>& a, const Vec3f& axisOfA, const std::vector<Vec3f>& b,
       const Vec3f& axisOfB, float margin_)
      : margin(margin_) {
    planes.push_back({-axisOfA, -Dot(axisOfA, a[0])});
    planes.push_back({-axisOfB, -Dot(axisOfB, b[0])});
    AddSides(a, b);
    AddSides(b, a);
  }

  /// The planes through an edge of one and a corner of the other that have both on one side.
  void AddSides(const std::vector<Vec3f>& edges, const std::vector<Vec3f>& corners) {
    for (size_t i = 0; i < edges.size(); ++i) {
      const Vec3f& from = edges[i];
      for (const Vec3f& corner : corners) {
        const Vec3f normal = Cross(edges[(i + 1) % edges.size()] - from, corner - from);
        if (!(Length(normal) > margin * margin)) continue;
        for (const Vec3f& outward : {Normalize(normal), -Normalize(normal)}) {
          const Plane plane{outward, Dot(outward, from)};
          const auto holds = [&](const std::vector<Vec3f>& points) {
            for (const Vec3f& p : points) {
              if (plane.Over(p) > margin) return false;
            }
            return true;
          };
          if (holds(edges) && holds(corners)) planes.push_back(plane);
        }
      }
    }
  }

  bool Misses(const Box3f& box) const {
    for (const Plane& plane : planes) {
      if (LeastOver(plane, box) >= -margin) return true;
    }
    return false;
  }
  bool Misses(const std::array<Vec3f, 3>& triangle) const {
    for (const Plane& plane : planes) {
      if (plane.Over(triangle[0]) >= -margin && plane.Over(triangle[1]) >= -margin &&
          plane.Over(triangle[2]) >= -margin) {
        return true;
      }
    }
    return false;
  }
};

Shafts::Shafts(const ElementHierarchy& hierarchy, const RayScene& rayScene)
    : hierarchy_(hierarchy), rayScene_(rayScene) {
  const ClusterTree& tree = hierarchy.Tree();
  std::vector<Box3f> boxes;
  for (const int32_t root : tree.surfaceRoots) boxes.push_back(tree.nodes[size_t(root)].bounds);
  volumes_ = ClusterVolumes(boxes);
}

// Of a polygon, or of the rectangle of a flat cluster; none of anything else.
std::vector<Vec3f> Shafts::CornersOf(const Element& element) const {
  if (element.IsPolygon()) {
    Vec3f corners[kMaximumPolygonCorners];
    const int count = hierarchy_.PolygonCorners(element, corners);
    return {corners, corners + count};
  }
  if (element.IsVolume() || element.kind == ElementKind::Light) return {};
  if (element.frame.halfExtent.z > rayScene_.Epsilon()) return {};
  return {element.frame.Corner(0), element.frame.Corner(1), element.frame.Corner(2),
          element.frame.Corner(3)};
}

bool Shafts::IsClear(const Element& source, const Element& receiver) const {
  const std::vector<Vec3f> from = CornersOf(source), to = CornersOf(receiver);
  if (from.empty() || to.empty()) return false;
  const Hull hull(from, source.axis, to, receiver.axis, rayScene_.Epsilon());
  std::vector<int32_t> open = {0};
  while (!open.empty()) {
    const VolumeNode& volume = volumes_[size_t(open.back())];
    open.pop_back();
    if (hull.Misses(volume.bounds)) continue;
    if (volume.child >= 0) {
      open.insert(open.end(), {volume.child, volume.child + 1});
    } else if (!IsEmpty(hull, hierarchy_.Tree().surfaceRoots[size_t(volume.item)])) {
      return false;
    }
  }
  return true;
}

// Down the face clusters of one surface.
bool Shafts::IsEmpty(const Hull& hull, int32_t clusterNode) const {
  const TriangleMesh& mesh = hierarchy_.GetScene().mesh;
  std::vector<int32_t> open = {clusterNode};
  while (!open.empty()) {
    const ClusterNode& node = hierarchy_.Tree().nodes[size_t(open.back())];
    open.pop_back();
    if (hull.Misses(node.bounds)) continue;
    if (node.child >= 0) {
      open.insert(open.end(), {node.child, node.child + 1});
      continue;
    }
    const int32_t face = node.firstFace;
    if (!hull.Misses({mesh.Corner(face, 0), mesh.Corner(face, 1), mesh.Corner(face, 2)})) {
      return false;
    }
  }
  return true;
}

bool Shafts::IsBlocked(const Element& source, const Element& receiver) const {
  const std::vector<Vec3f> from = CornersOf(source), to = CornersOf(receiver);
  if (from.empty() || to.empty()) return false;

  // The face that the segment between two samples meets first stands for all others.
  const Vec3f start = source.samples[0].position;
  const Vec3f way = receiver.samples[0].position - start;
  const RayHit hit = rayScene_.Closest(start, Normalize(way));
  if (hit.face < 0 || hit.distance >= Length(way)) return false;
  const TriangleMesh& mesh = hierarchy_.GetScene().mesh;
  const std::array<Vec3f, 3> face = {mesh.Corner(hit.face, 0), mesh.Corner(hit.face, 1),
                                     mesh.Corner(hit.face, 2)};

  // Segments between points of convex polygons cross its plane within the hull of where those
  // between corners do.
  for (const Vec3f& a : from) {
    for (const Vec3f& b : to) {
      const float length = Length(b - a), place = Crossing(a, b, face) * length;
      if (!(place > rayScene_.Epsilon() && place < length - rayScene_.Epsilon())) return false;
    }
  }
  return true;
}

}  // namespace lambert
