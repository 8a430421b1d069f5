// The one source that includes CGAL, whose headers are slow to compile.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>
#include <CGAL/min_quadrilateral_2.h>

#include "Clustering/Core/ClusterFrame.h"
#include "Clustering/Core/InnerOctagon.h"

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

/// The points that the hull of all of them may go through: few of many.
std::vector<Point> PointsOfHull(const std::vector<Vec2f>& points) {
  InnerOctagon inner;
  for (const Vec2f& p : points) inner.Include(p);
  std::vector<Point> kept;
  for (const Vec2f& p : points) {
    if (std::isfinite(p.x) && std::isfinite(p.y) && !inner.Holds(Vec2d(p)))
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
