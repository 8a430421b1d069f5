// Rays through the clusters themselves (thesis 4.5.4): boxes of volume and face clusters in a
// depth-first array, each with the index to skip to. Measured against the ray tracer in use.
#pragma once

#include <cstdint>
#include <vector>

#include "Clustering/Core/FaceClustering.h"
#include "Common/Core/TriangleMesh.h"

namespace lambert {

class ClusterRays {
 public:
  enum class Boxes { AxisAligned, Oriented };

  /// `mesh` by reference, in the order of the tree. A cluster of `facesOfLeaf` faces or fewer is
  /// not entered further.
  ClusterRays(const TriangleMesh& mesh, const ClusterTree& tree, Boxes boxes, int facesOfLeaf);

  /// The face that is met first beyond `nearest` and within `farthest`, m; -1: none.
  int32_t Closest(const Vec3f& from, const Vec3f& direction, float nearest, float farthest) const;
  bool Occluded(const Vec3f& from, const Vec3f& direction, float nearest, float farthest) const;
  size_t Bytes() const;

 private:
  /// Rows of a box's frame, scaled so that the box is the unit cube about its center.
  struct Oriented {
    Vec3f rows[3];
    Vec3f offset;
  };
  struct Node {
    Box3f bounds;
    int32_t skip;                          ///< the node to go on with where this one is missed
    int32_t firstFace = 0, faceCount = 0;  ///< of a leaf
    int32_t oriented = -1;                 ///< its oriented box; -1: the bounds
  };

  void AddVolume(const std::vector<struct VolumeNode>& volumes, int32_t volume,
                 const ClusterTree& tree, int facesOfLeaf, Boxes boxes);
  void AddCluster(const ClusterTree& tree, int32_t cluster, int facesOfLeaf, Boxes boxes);
  template <bool anyHit>
  int32_t Trace(const Vec3f& from, const Vec3f& direction, float nearest, float farthest) const;

  const TriangleMesh& mesh_;
  std::vector<Node> nodes_;
  std::vector<Oriented> oriented_;
};

}  // namespace lambert
