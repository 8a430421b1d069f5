#include "Clustering/Core/ClusterFrame.h"

#include <Eigen/Dense>

namespace lambert {

namespace {

/// The frame's directions before the extents are known.
struct Axes {
  Vec3d u, v, n;
};

template <class Visit>
void ForEachCorner(const TriangleMesh& mesh, const ClusterNode& node, const Visit& visit) {
  for (int32_t face = node.firstFace; face < node.firstFace + node.faceCount; ++face) {
    for (int k = 0; k < 3; ++k) visit(Vec3d(mesh.Corner(face, k)));
  }
}

Vec3d ToVec3d(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Spreads along three axes, smallest first, with the axes in columns: eigenvalues of Z (4.5).
Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> PrincipalAxes(const TriangleMesh& mesh,
                                                             const ClusterNode& node) {
  const Vec3d origin(mesh.Corner(node.firstFace, 0));
  Vec3d sum;
  ForEachCorner(mesh, node, [&](const Vec3d& p) { sum += p - origin; });
  const Vec3d mean = origin + sum / (3.0 * node.faceCount);  // (4.6)
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  ForEachCorner(mesh, node, [&](const Vec3d& p) {
    const Eigen::Vector3d d(p.x - mean.x, p.y - mean.y, p.z - mean.z);
    covariance += d * d.transpose();  // (4.5)
  });
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance);
}

/// Axes in the plane of the unit normal n, along the minimum-area rectangle of the projected
/// points.
Axes RectangleAxes(const TriangleMesh& mesh, const ClusterNode& node, const Vec3d& n) {
  Vec3d u, v;
  CoordinateSystem(n, &u, &v);
  const Vec3d origin(mesh.Corner(node.firstFace, 0));
  std::vector<Vec2f> points;
  points.reserve(size_t(3 * node.faceCount));
  ForEachCorner(mesh, node, [&](const Vec3d& p) {
    points.push_back({float(Dot(p - origin, u)), float(Dot(p - origin, v))});
  });
  const Vec2d axis(MinimumAreaRectangle(points).axis);
  return {u * axis.x + v * axis.y, v * axis.x - u * axis.y, n};
}

/// Center and extents of the points along the axes; contains each of them in float arithmetic.
ClusterFrame FrameAlong(const Axes& axes, const TriangleMesh& mesh, const ClusterNode& node) {
  ClusterFrame frame;
  frame.axes = {Vec3f(axes.u), Vec3f(axes.v), Vec3f(axes.n)};
  const Vec3d origin(mesh.Corner(node.firstFace, 0));
  Vec3d low, high;
  ForEachCorner(mesh, node, [&](const Vec3d& p) {
    const Vec3d d = p - origin;
    const Vec3d along{Dot(d, axes.u), Dot(d, axes.v), Dot(d, axes.n)};
    low = Min(low, along), high = Max(high, along);
  });
  const Vec3d middle = (low + high) * 0.5;
  frame.center = Vec3f(origin + axes.u * middle.x + axes.v * middle.y + axes.n * middle.z);

  // The rounded center is off the middle: measure from where it came to lie, and round up.
  ForEachCorner(mesh, node, [&](const Vec3d& p) {
    const Vec3d d = p - Vec3d(frame.center);
    for (int k = 0; k < 3; ++k) {
      const float reach = float(std::abs(Dot(d, Vec3d(frame.axes[size_t(k)]))));
      frame.halfExtent[k] = std::max(frame.halfExtent[k], reach);
    }
  });
  for (int k = 0; k < 3; ++k) {
    if (frame.halfExtent[k] > 0)
      frame.halfExtent[k] = std::nextafter(frame.halfExtent[k], std::numeric_limits<float>::max());
  }
  return frame;
}

}  // namespace

ClusterFrame ComputeClusterFrame(const TriangleMesh& mesh, const ClusterNode& node) {
  if (node.faceCount <= 0) return {{}, {Vec3f{1, 0, 0}, Vec3f{0, 1, 0}, Vec3f{0, 0, 1}}, {}};
  const auto principal = PrincipalAxes(mesh, node);
  const Eigen::Vector3d spread = principal.eigenvalues();
  const Vec3d vectorArea(node.vectorArea);
  Vec3d leastSpread = Normalize(ToVec3d(principal.eigenvectors().col(0)));
  if (Dot(leastSpread, vectorArea) < 0) leastSpread = -leastSpread;

  // The way that the cluster faces, where its normals do not cancel.
  constexpr double kCancelled = 1e-3;  // of the area: below it the sum of normals says nothing
  const bool cancels = !(Length(vectorArea) > kCancelled * node.area);
  const Vec3d facing = cancels ? leastSpread : Normalize(vectorArea);

  // Nearly planar, or folded so that the best plane stands across the normals (over 60 degrees):
  // thesis 6.2.1.
  constexpr double kPlanar = 1e-2;  // spread across the plane, relative to the smaller one within
  const bool planar = spread[0] <= kPlanar * spread[1];
  if (planar || Dot(facing, leastSpread) < 0.5) {
    return FrameAlong(RectangleAxes(mesh, node, facing), mesh, node);
  }

  const Vec3d u = Normalize(ToVec3d(principal.eigenvectors().col(2)));
  return FrameAlong({u, Cross(leastSpread, u), leastSpread}, mesh, node);
}

}  // namespace lambert
