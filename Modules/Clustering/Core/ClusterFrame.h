// The oriented frame and rectangle of a cluster (thesis 4.2.2, 6.2.1).
#pragma once

#include <array>
#include <cstdint>

#include "Clustering/Core/FaceClustering.h"
#include "Clustering/Core/FaceRuns.h"
#include "Common/Core/Vector.h"

namespace lambert {

/// An oriented box: center, right-handed unit axes, half extents. Axis 2 is the cluster's normal;
/// the rectangle spanned by axes 0 and 1 through the center is the cluster's rectangle.
struct ClusterFrame {
  Vec3f center;
  std::array<Vec3f, 3> axes;
  Vec3f halfExtent;

  /// Corner (-,-), (+,-), (+,+), (-,+) of the rectangle, by index 0 to 3.
  Vec3f Corner(int index) const {
    const float u = (index == 0 || index == 3) ? -halfExtent.x : halfExtent.x;
    const float v = index < 2 ? -halfExtent.y : halfExtent.y;
    return center + axes[0] * u + axes[1] * v;
  }
};

/// Frame of the faces [firstFace, firstFace + faceCount): principal axes of the covariance
/// (4.5-4.7); where it is unstable (nearly planar), the vector area as normal and the minimum-area
/// rectangle of the projected points.
ClusterFrame ComputeClusterFrame(const TriangleMesh& mesh, const ClusterNode& node);
/// The same, to the bit; faster for large clusters.
ClusterFrame ComputeClusterFrame(const FaceRuns& runs, const ClusterNode& node);

/// Minimum-area enclosing rectangle of points in the plane, by convex hull and rotating calipers
/// (CGAL).
struct Rectangle2 {
  Vec2f center;
  Vec2f axis;        ///< unit, along the longer side
  Vec2f halfExtent;  ///< x along `axis`, x >= y
};
Rectangle2 MinimumAreaRectangle(const std::vector<Vec2f>& points);

}  // namespace lambert
