// The one source that includes CGAL, whose headers are slow to compile.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>
#include <CGAL/min_quadrilateral_2.h>

#include <array>

#include "Clustering/Core/ClusterFrame.h"

namespace lambert {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;

struct Span {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  void Include(double x) { low = std::min(low, x), high = std::max(high, x); }
  double Middle() const { return 0.5 * (low + high); }
  double Half() const { return 0.5 * (high - low); }
};

/// The octagon through the points that lie farthest along x, y and between: convex,
/// counter-clockwise, some of its corners may be one.
std::array<Vec2d, 8> Octagon(const std::vector<Vec2f>& points) {
  std::array<Vec2d, 8> corners;
  std::array<double, 8> farthest;
  farthest.fill(std::numeric_limits<double>::lowest());
  for (const Vec2f& point : points) {
    const Vec2d p(point);
    const double along[8] = {p.x, p.x + p.y, p.y, p.y - p.x, -p.x, -p.x - p.y, -p.y, p.x - p.y};
    for (size_t i = 0; i < 8; ++i) {
      if (!(along[i] > farthest[i])) continue;
      farthest[i] = along[i];
      corners[i] = p;
    }
  }
  return corners;
}

/// The points that the hull of all of them may go through: few of many.
std::vector<Point> PointsOfHull(const std::vector<Vec2f>& points) {
  // A polygon of some of them, its sides moved inward by far more than double arithmetic errs.
  struct Side {
    Vec2d from, inward;
    double least;
  };
  constexpr double kInside = 1e-9;  // of the extent, as a height over a side
  const std::array<Vec2d, 8> corners = Octagon(points);
  const double extent = std::max(corners[0].x - corners[4].x, corners[2].y - corners[6].y);
  std::vector<Side> sides;
  for (size_t i = 0; i < 8; ++i) {
    const Vec2d &a = corners[i], side = corners[(i + 1) % 8] - a;
    if (side != Vec2d()) {
      sides.push_back({a, {-side.y, side.x}, kInside * extent * std::hypot(side.x, side.y)});
    }
  }

  // What lies within it does not lie on the hull.
  const auto isWithin = [&](const Vec2d& p) {
    for (const Side& side : sides) {
      const Vec2d d = p - side.from;
      if (!(d.x * side.inward.x + d.y * side.inward.y > side.least)) return false;
    }
    return !sides.empty();
  };
  std::vector<Point> kept;
  for (const Vec2f& p : points) {
    if (std::isfinite(p.x) && std::isfinite(p.y) && !isWithin(Vec2d(p)))
      kept.emplace_back(p.x, p.y);
  }
  return kept;
}

/// Direction of the longest side of a polygon; x where all its points are one.
Vec2d LongestSide(const std::vector<Point>& polygon) {
  Vec2d longest{1, 0};
  double best = 0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const Vec2d side{b.x() - a.x(), b.y() - a.y()};
    const double length = std::hypot(side.x, side.y);
    if (length > best && std::isfinite(length)) {
      best = length;
      longest = side * (1 / length);
    }
  }
  return longest;
}

/// The rectangle around `hull` with a side along the unit vector `axis`.
Rectangle2 RectangleAlong(const Vec2d& axis, const std::vector<Point>& hull) {
  Span along, across;
  for (const Point& p : hull) {
    along.Include(p.x() * axis.x + p.y() * axis.y);
    across.Include(p.y() * axis.x - p.x() * axis.y);
  }
  Rectangle2 rectangle;
  rectangle.center = {float(axis.x * along.Middle() - axis.y * across.Middle()),
                      float(axis.y * along.Middle() + axis.x * across.Middle())};
  const bool swapped = across.Half() > along.Half();
  rectangle.axis = swapped ? Vec2f(float(-axis.y), float(axis.x)) : Vec2f(axis);
  rectangle.halfExtent = {float(std::max(along.Half(), across.Half())),
                          float(std::min(along.Half(), across.Half()))};
  return rectangle;
}

}  // namespace

Rectangle2 MinimumAreaRectangle(const std::vector<Vec2f>& points) {
  const std::vector<Point> corners = PointsOfHull(points);
  if (corners.empty()) return {{}, {1, 0}, {}};

  std::vector<Point> hull;
  CGAL::convex_hull_2(corners.begin(), corners.end(), std::back_inserter(hull));
  if (hull.size() < 3) return RectangleAlong(LongestSide(hull), hull);

  // The calipers may fail to close on needles thinner than double precision tells; then a side of
  // the hull serves, which every minimum rectangle has along one of its own.
  std::vector<Point> rectangle;
  CGAL::min_rectangle_2(hull.begin(), hull.end(), std::back_inserter(rectangle));
  const Rectangle2 byHull = RectangleAlong(LongestSide(hull), hull);
  const Rectangle2 byCalipers = RectangleAlong(LongestSide(rectangle), hull);
  const auto area = [](const Rectangle2& r) {
    return double(r.halfExtent.x) * double(r.halfExtent.y);
  };
  return area(byHull) < area(byCalipers) ? byHull : byCalipers;
}

}  // namespace lambert
