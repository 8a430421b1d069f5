#include "Clustering/Core/ClusterFrame.h"

#include <Eigen/Dense>

#include "Clustering/Core/InnerOctagon.h"

namespace lambert {

namespace {

/// The frame's directions before the extents are known.
struct Axes {
  Vec3d u, v, n;
};

/// The points of a cluster, met face by face or run by run.
class FacePoints {
 public:
  FacePoints(const TriangleMesh& mesh, const ClusterNode& node, const FaceRuns* runs)
      : mesh_(mesh), node_(node), runs_(runs) {}

  Vec3d First() const { return Vec3d(mesh_.Corner(node_.firstFace, 0)); }
  PointSpread Spread() const {
    if (runs_) return runs_->SpreadOf(node_);
    return PointSpread::OfCorners(mesh_, node_.firstFace, this->End());
  }
  /// Each at least once, but for those in boxes of which isWithin(box) is true: they change nothing
  /// after what was visited.
  template <class Visit, class IsWithin>
  void ForEachOuter(const Visit& visit, const IsWithin& isWithin) const {
    if (runs_) {
      runs_->ForEachOuterPoint(
          node_, [&](const Vec3f& p) { visit(Vec3d(p)); }, isWithin);
      return;
    }
    for (int32_t face = node_.firstFace; face < this->End(); ++face) {
      for (int k = 0; k < 3; ++k) visit(Vec3d(mesh_.Corner(face, k)));
    }
  }

 private:
  int32_t End() const { return node_.firstFace + node_.faceCount; }

  const TriangleMesh& mesh_;
  const ClusterNode& node_;
  const FaceRuns* runs_;
};

/// A box along three unit axes.
struct BoxAlong {
  Vec3d center, reach;

  BoxAlong(const Box3f& box, const Vec3d& origin, const Vec3d& u, const Vec3d& v, const Vec3d& n) {
    const Vec3d low(box.low), high(box.high);
    const Vec3d offset = (low + high) * 0.5 - origin, half = (high - low) * 0.5;
    const auto reachAlong = [&](const Vec3d& axis) {
      return std::abs(axis.x) * half.x + std::abs(axis.y) * half.y + std::abs(axis.z) * half.z;
    };
    center = {Dot(offset, u), Dot(offset, v), Dot(offset, n)};
    reach = {reachAlong(u), reachAlong(v), reachAlong(n)};
  }
};

bool IsAtMost(const Vec3d& a, const Vec3d& b) { return a.x <= b.x && a.y <= b.y && a.z <= b.z; }

Vec3d ToVec3d(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Spreads along three axes, smallest first, with the axes in columns: eigenvalues of Z (4.5).
Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> PrincipalAxes(const PointSpread& spread) {
  const Vec3d &d = spread.diagonal, &m = spread.mixed;
  Eigen::Matrix3d covariance;
  covariance << d.x, m.z, m.y, m.z, d.y, m.x, m.y, m.x, d.z;
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance);
}

/// Axes in the plane of the unit normal n, along the minimum-area rectangle of the projected
/// points.
Axes RectangleAxes(const FacePoints& points, const Vec3d& n) {
  Vec3d u, v;
  CoordinateSystem(n, &u, &v);
  const Vec3d origin = points.First();
  std::vector<Vec2f> projected;
  InnerOctagon inner;
  const auto project = [&](const Vec3d& p) {
    projected.push_back({float(Dot(p - origin, u)), float(Dot(p - origin, v))});
    inner.Include(projected.back());
  };
  points.ForEachOuter(project, [&](const Box3f& bounds) {
    const BoxAlong box(bounds, origin, u, v, n);
    const Vec2d middle{box.center.x, box.center.y}, half{box.reach.x, box.reach.y};
    const Vec2d other{half.x, -half.y};
    return inner.Holds(middle + half) && inner.Holds(middle - half) &&
           inner.Holds(middle + other) && inner.Holds(middle - other);
  });
  const Vec2d axis(MinimumAreaRectangle(projected).axis);
  return {u * axis.x + v * axis.y, v * axis.x - u * axis.y, n};
}

/// Center and extents of the points along the axes; contains each of them in float arithmetic.
ClusterFrame FrameAlong(const Axes& axes, const FacePoints& points) {
  ClusterFrame frame;
  frame.axes = {Vec3f(axes.u), Vec3f(axes.v), Vec3f(axes.n)};
  const Vec3d origin = points.First();
  Vec3d low, high;
  const auto include = [&](const Vec3d& p) {
    const Vec3d d = p - origin;
    const Vec3d along{Dot(d, axes.u), Dot(d, axes.v), Dot(d, axes.n)};
    low = Min(low, along), high = Max(high, along);
  };
  points.ForEachOuter(include, [&](const Box3f& bounds) {
    const BoxAlong box(bounds, origin, axes.u, axes.v, axes.n);
    return IsAtMost(low, box.center - box.reach) && IsAtMost(box.center + box.reach, high);
  });
  const Vec3d middle = (low + high) * 0.5;
  frame.center = Vec3f(origin + axes.u * middle.x + axes.v * middle.y + axes.n * middle.z);

  // The rounded center is off the middle: measure from where it came to lie, and round up.
  const Vec3d center(frame.center), u(frame.axes[0]), v(frame.axes[1]), n(frame.axes[2]);
  Vec3d reach;
  const auto reachTo = [&](const Vec3d& p) {
    const Vec3d d = p - center;
    reach = Max(reach, {std::abs(Dot(d, u)), std::abs(Dot(d, v)), std::abs(Dot(d, n))});
  };
  points.ForEachOuter(reachTo, [&](const Box3f& bounds) {
    const BoxAlong box(bounds, center, u, v, n);
    return IsAtMost(Max(box.center, -box.center) + box.reach, reach);
  });
  frame.halfExtent = Vec3f(reach);
  for (int k = 0; k < 3; ++k) {
    if (frame.halfExtent[k] > 0)
      frame.halfExtent[k] = std::nextafter(frame.halfExtent[k], std::numeric_limits<float>::max());
  }
  return frame;
}

ClusterFrame FrameOf(const FacePoints& points, const ClusterNode& node) {
  if (node.faceCount <= 0) return {{}, {Vec3f{1, 0, 0}, Vec3f{0, 1, 0}, Vec3f{0, 0, 1}}, {}};
  const auto principal = PrincipalAxes(points.Spread());
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
    return FrameAlong(RectangleAxes(points, facing), points);
  }

  const Vec3d u = Normalize(ToVec3d(principal.eigenvectors().col(2)));
  return FrameAlong({u, Cross(leastSpread, u), leastSpread}, points);
}

}  // namespace

ClusterFrame ComputeClusterFrame(const TriangleMesh& mesh, const ClusterNode& node) {
  return FrameOf({mesh, node, nullptr}, node);
}

ClusterFrame ComputeClusterFrame(const FaceRuns& runs, const ClusterNode& node) {
  return FrameOf({runs.Mesh(), node, &runs}, node);
}

}  // namespace lambert
