#include "ClusterRays.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "Clustering/Core/ClusterFrame.h"
#include "Clustering/Core/VolumeClustering.h"

namespace lambert {

namespace {

/// Boxes are this part larger than what they hold, so that rounding loses no face.
constexpr float kLarger = 1e-4f;
/// Oriented boxes are worth their cost where they have less than this part of the other's surface.
constexpr float kWorthTurning = 0.5f;

/// Where a ray enters and leaves three pairs of planes at -1 and 1 about `offset`.
bool MeetsSlabs(const Vec3f& from, const Vec3f& over, float nearest, float farthest) {
  for (int axis = 0; axis < 3; ++axis) {
    const float a = (-1 - from[axis]) * over[axis], b = (1 - from[axis]) * over[axis];
    nearest = std::max(nearest, std::min(a, b));
    farthest = std::min(farthest, std::max(a, b));
  }
  return nearest <= farthest;
}

bool MeetsBox(const Box3f& box, const Vec3f& from, const Vec3f& over, float nearest,
              float farthest) {
  for (int axis = 0; axis < 3; ++axis) {
    const float a = (box.low[axis] - from[axis]) * over[axis];
    const float b = (box.high[axis] - from[axis]) * over[axis];
    nearest = std::max(nearest, std::min(a, b));
    farthest = std::min(farthest, std::max(a, b));
  }
  return nearest <= farthest;
}

/// Distance along the ray to a triangle (moeller1997); infinite where it is missed.
float DistanceTo(const TriangleMesh& mesh, int64_t face, const Vec3f& from,
                 const Vec3f& direction) {
  constexpr float kNone = std::numeric_limits<float>::infinity();
  const Vec3f& a = mesh.Corner(face, 0);
  const Vec3f e = mesh.Corner(face, 1) - a, f = mesh.Corner(face, 2) - a;
  const Vec3f p = Cross(direction, f);
  const float determinant = Dot(e, p);
  if (determinant == 0) return kNone;
  const Vec3f s = from - a;
  const float u = Dot(s, p) / determinant;
  if (!(u >= 0 && u <= 1)) return kNone;
  const Vec3f q = Cross(s, e);
  const float v = Dot(direction, q) / determinant;
  if (!(v >= 0 && u + v <= 1)) return kNone;
  return Dot(f, q) / determinant;
}

Vec3f Over(const Vec3f& direction) {
  const auto over = [](float d) { return 1 / (d == 0 ? std::copysign(1e-30f, d) : d); };
  return {over(direction.x), over(direction.y), over(direction.z)};
}

}  // namespace

ClusterRays::ClusterRays(const TriangleMesh& mesh, const ClusterTree& tree, Boxes boxes,
                         int facesOfLeaf)
    : mesh_(mesh) {
  std::vector<Box3f> ofSurfaces;
  for (const int32_t root : tree.surfaceRoots)
    ofSurfaces.push_back(tree.nodes[size_t(root)].bounds);
  const std::vector<VolumeNode> volumes = ClusterVolumes(ofSurfaces);
  if (!volumes.empty()) this->AddVolume(volumes, 0, tree, facesOfLeaf, boxes);
}

void ClusterRays::AddVolume(const std::vector<VolumeNode>& volumes, int32_t volume,
                            const ClusterTree& tree, int facesOfLeaf, Boxes boxes) {
  const VolumeNode& own = volumes[size_t(volume)];
  if (own.child < 0) {
    this->AddCluster(tree, tree.surfaceRoots[size_t(own.item)], facesOfLeaf, boxes);
    return;
  }
  const size_t index = nodes_.size();
  nodes_.push_back({own.bounds, 0});
  for (int k = 0; k < 2; ++k) this->AddVolume(volumes, own.child + k, tree, facesOfLeaf, boxes);
  nodes_[index].skip = int32_t(nodes_.size());
}

void ClusterRays::AddCluster(const ClusterTree& tree, int32_t cluster, int facesOfLeaf,
                             Boxes boxes) {
  // Trees of slivers are deep: no recursion.
  struct Open {
    int32_t cluster;
    int64_t closes;  ///< the node whose children are all added; -1: none
  };
  std::vector<Open> open{{cluster, -1}};
  while (!open.empty()) {
    const Open next = open.back();
    open.pop_back();
    if (next.closes >= 0) {
      nodes_[size_t(next.closes)].skip = int32_t(nodes_.size());
      continue;
    }
    const ClusterNode& own = tree.nodes[size_t(next.cluster)];
    const bool isLeaf = own.child < 0 || own.faceCount <= facesOfLeaf;
    Node node{own.bounds, int32_t(nodes_.size()) + 1};
    if (isLeaf) node.firstFace = own.firstFace, node.faceCount = own.faceCount;
    if (boxes == Boxes::Oriented && own.faceCount > 1) {
      // Turned where that makes the box much smaller.
      const ClusterFrame frame = ComputeClusterFrame(mesh_, own);
      const float thin = kLarger * node.bounds.Diagonal();
      const Vec3f& h = frame.halfExtent;
      const float surface = 8 * (h.x * h.y + h.y * h.z + h.z * h.x);
      if (surface < kWorthTurning * node.bounds.SurfaceArea()) {
        Oriented turned;
        for (int axis = 0; axis < 3; ++axis) {
          turned.rows[axis] = frame.axes[size_t(axis)] / (h[axis] + thin);
          turned.offset[axis] = Dot(turned.rows[axis], frame.center);
        }
        node.oriented = int32_t(oriented_.size());
        oriented_.push_back(turned);
      }
    }
    const int64_t index = int64_t(nodes_.size());
    nodes_.push_back(node);
    if (isLeaf) continue;
    open.push_back({-1, index});
    open.push_back({own.child + 1, -1});
    open.push_back({own.child, -1});
  }
}

template <bool anyHit>
int32_t ClusterRays::Trace(const Vec3f& from, const Vec3f& direction, float nearest,
                           float farthest) const {
  const Vec3f over = Over(direction);
  int32_t met = -1;
  for (size_t i = 0; i < nodes_.size();) {
    const Node& node = nodes_[i];
    bool isMet = MeetsBox(node.bounds, from, over, nearest, farthest);
    if (isMet && node.oriented >= 0) {
      const Oriented& box = oriented_[size_t(node.oriented)];
      Vec3f place, way;
      for (int axis = 0; axis < 3; ++axis) {
        place[axis] = Dot(box.rows[axis], from) - box.offset[axis];
        way[axis] = Dot(box.rows[axis], direction);
      }
      isMet = MeetsSlabs(place, Over(way), nearest, farthest);
    }
    if (!isMet) {
      i = size_t(node.skip);
      continue;
    }
    for (int32_t face = node.firstFace; face < node.firstFace + node.faceCount; ++face) {
      const float distance = DistanceTo(mesh_, face, from, direction);
      if (!(distance > nearest && distance < farthest)) continue;
      if (anyHit) return face;
      met = face;
      farthest = distance;
    }
    ++i;
  }
  return met;
}

int32_t ClusterRays::Closest(const Vec3f& from, const Vec3f& direction, float nearest,
                             float farthest) const {
  return this->Trace<false>(from, direction, nearest, farthest);
}

bool ClusterRays::Occluded(const Vec3f& from, const Vec3f& direction, float nearest,
                           float farthest) const {
  return this->Trace<true>(from, direction, nearest, farthest) >= 0;
}

size_t ClusterRays::Bytes() const {
  return nodes_.size() * sizeof(Node) + oriented_.size() * sizeof(Oriented);
}

}  // namespace lambert
