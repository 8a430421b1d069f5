#include "Radiosity/Core/PatchSplitting.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lambert {

namespace {

constexpr double kTieTolerance =
    1e-4;  // Areas this near are equal: far above rounding, far below sight.
constexpr double kFlatness = 1e-9;  // Height over length below which a triangle has no usable area.

// Relative to the rectangle's longer side, or the side that is cut: cuts keep this far from
// vertices, so that no edge ends up shorter.
constexpr double kLeastSnap = 1e-4;
constexpr double kLeastLean = 1e-3;
// A line passes through a vertex that is this near, relative to the border's extent.
constexpr double kOnLine = 1e-3;

double DotProduct(Vec2d a, Vec2d b) { return a.x * b.x + a.y * b.y; }
Vec2d Perpendicular(Vec2d v) { return {-v.y, v.x}; }

// Extents of the border along `axis` and across it.
PatchRectangle FlushRectangle(const std::vector<PatchBorderVertex>& border, Vec2d axis) {
  const Vec2d across = Perpendicular(axis);
  double low[2] = {std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  double high[2] = {std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest()};
  for (const PatchBorderVertex& vertex : border) {
    const double coordinates[2] = {DotProduct(vertex.position, axis),
                                   DotProduct(vertex.position, across)};
    for (int i = 0; i < 2; ++i) {
      low[i] = std::min(low[i], coordinates[i]);
      high[i] = std::max(high[i], coordinates[i]);
    }
  }
  PatchRectangle rectangle;
  rectangle.center = axis * (0.5 * (low[0] + high[0])) + across * (0.5 * (low[1] + high[1]));
  rectangle.axis = axis;
  rectangle.length = high[0] - low[0];
  rectangle.width = high[1] - low[1];
  if (rectangle.width > rectangle.length) {
    rectangle.axis = across;
    std::swap(rectangle.length, rectangle.width);
  }
  return rectangle;
}

// One of the two halves of the border between its extremes along the rectangle, in ascending order.
struct Chain {
  std::vector<int> vertices;
  const std::vector<double>* along = nullptr;

  double At(size_t i) const { return (*along)[size_t(vertices[i])]; }

  // Vertex nearest to `target`, the extremes left out; -1 where there is none within `tolerance`.
  int Nearest(double target, double tolerance) const {
    int nearest = -1;
    for (size_t i = 1; i + 1 < vertices.size(); ++i) {
      const double distance = std::abs(At(i) - target);
      if (distance <= tolerance) {
        tolerance = distance;
        nearest = vertices[i];
      }
    }
    return nearest;
  }

  PatchCutEnd Crossing(double target) const {
    size_t i = 0;
    while (i + 2 < vertices.size() && At(i + 1) <= target) ++i;
    return {vertices[i], vertices[i + 1], (target - At(i)) / (At(i + 1) - At(i))};
  }
};

}  // namespace

bool IsTriangle(const std::vector<PatchBorderVertex>& border) {
  return std::count_if(border.begin(), border.end(),
                       [](const PatchBorderVertex& vertex) { return vertex.isCorner; }) == 3;
}

double PatchExtent(const std::vector<PatchBorderVertex>& border) {
  double extent = 0;
  for (const PatchBorderVertex& vertex : border) {
    const Vec2d offset = vertex.position - border.front().position;
    extent = std::max({extent, std::abs(offset.x), std::abs(offset.y)});
  }
  return extent;
}

PatchRectangle MinimumPatchRectangle(const std::vector<PatchBorderVertex>& border) {
  PatchRectangle best;
  double bestArea = std::numeric_limits<double>::max();
  for (size_t i = 0; i < border.size(); ++i) {
    if (!border[i].isCorner) continue;
    size_t next = i;
    do next = (next + 1) % border.size();
    while (!border[next].isCorner);
    const Vec2d edge = border[next].position - border[i].position;
    const double length = std::hypot(edge.x, edge.y);
    if (length == 0) continue;
    const PatchRectangle rectangle = FlushRectangle(border, edge * (1 / length));
    const double area = rectangle.length * rectangle.width;
    const bool isSmaller = area < bestArea * (1 - kTieTolerance);
    const bool isLonger = area < bestArea * (1 + kTieTolerance) &&
                          rectangle.length > best.length * (1 + kTieTolerance);
    if (isSmaller || isLonger) {
      best = rectangle;
      bestArea = area;
    }
  }
  return best;
}

std::array<PatchCutEnd, 2> CutPatch(const std::vector<PatchBorderVertex>& border,
                                    double snapTolerance) {
  // Measure the border along the rectangle's longer side, from its middle.
  const PatchRectangle rectangle = MinimumPatchRectangle(border);
  const int count = int(border.size());
  std::vector<double> along(border.size()), across(border.size());
  for (size_t i = 0; i < border.size(); ++i) {
    const Vec2d offset = border[i].position - rectangle.center;
    along[i] = DotProduct(offset, rectangle.axis);
    across[i] = DotProduct(offset, Perpendicular(rectangle.axis));
  }

  // Part the border at its extremes into the two chains that the line crosses.
  const int first = int(std::min_element(along.begin(), along.end()) - along.begin());
  const int last = int(std::max_element(along.begin(), along.end()) - along.begin());
  std::array<Chain, 2> chains;
  for (int c = 0; c < 2; ++c) {
    const int step = c == 0 ? 1 : count - 1;
    chains[size_t(c)].along = &along;
    for (int i = first; i != last; i = (i + step) % count) chains[size_t(c)].vertices.push_back(i);
    chains[size_t(c)].vertices.push_back(last);
  }
  const auto lateral = [&](const PatchCutEnd& end) {
    const double from = across[size_t(end.from)];
    return end.to < 0 ? from : from + end.fraction * (across[size_t(end.to)] - from);
  };
  const auto mostLean = [&](const PatchCutEnd& a, const PatchCutEnd& b) {
    return std::max(std::abs(lateral(a) - lateral(b)), kLeastLean * rectangle.length);
  };

  // Snap each end of the middle line to its nearest vertex.
  const double tolerance = std::max(snapTolerance, kLeastSnap) * rectangle.length;
  std::array<PatchCutEnd, 2> ends;
  std::array<double, 2> place = {0, 0};
  for (size_t c = 0; c < 2; ++c) {
    const int vertex = chains[c].Nearest(0, tolerance);
    ends[c] = vertex >= 0 ? PatchCutEnd{vertex, -1, 0} : chains[c].Crossing(0);
    if (vertex >= 0) place[c] = along[size_t(vertex)];
  }
  if (std::abs(place[0] - place[1]) <= mostLean(ends[0], ends[1])) return ends;

  // Where the line would lean too much, move it straight to the nearer of the vertices instead.
  const bool firstSnapped = ends[0].to < 0, secondSnapped = ends[1].to < 0;
  const size_t kept =
      firstSnapped && (!secondSnapped || std::abs(place[0]) <= std::abs(place[1])) ? 0 : 1;
  const size_t moved = 1 - kept;
  const PatchCutEnd straight = chains[moved].Crossing(place[kept]);
  const int vertex = chains[moved].Nearest(place[kept], mostLean(ends[kept], straight));
  ends[moved] = vertex >= 0 ? PatchCutEnd{vertex, -1, 0} : straight;
  return ends;
}

std::array<PatchCutEnd, 3> SideMiddles(const std::vector<PatchBorderVertex>& border) {
  std::array<PatchCutEnd, 3> middles;
  const int count = int(border.size());
  int corner = 0;
  while (!border[size_t(corner)].isCorner) ++corner;
  for (PatchCutEnd& middle : middles) {
    // Measure the vertices of the side from its first corner.
    const Vec2d origin = border[size_t(corner)].position;
    Chain side;
    std::vector<double> distance(border.size(), 0);
    side.along = &distance;
    side.vertices = {corner};
    do {
      corner = (corner + 1) % count;
      const Vec2d offset = border[size_t(corner)].position - origin;
      distance[size_t(corner)] = std::hypot(offset.x, offset.y);
      side.vertices.push_back(corner);
    } while (!border[size_t(corner)].isCorner);

    const double length = distance[size_t(corner)];
    const int vertex = side.Nearest(length / 2, kLeastSnap * length);
    middle = vertex >= 0 ? PatchCutEnd{vertex, -1, 0} : side.Crossing(length / 2);
  }
  return middles;
}

std::optional<std::array<PatchCutEnd, 2>> CutPatchAlong(
    const std::vector<PatchBorderVertex>& border, Vec2d a, Vec2d b) {
  // On which side of the line each vertex lies, and how far from it.
  const Vec2d direction = b - a;
  const double length = std::hypot(direction.x, direction.y);
  const double extent = PatchExtent(border);
  if (!(length > kOnLine * extent)) return {};
  const int count = int(border.size());
  std::vector<double> height(border.size());
  for (int i = 0; i < count; ++i) {
    const double h = DotProduct(Perpendicular(direction), border[size_t(i)].position - a) / length;
    height[size_t(i)] = std::abs(h) > kOnLine * extent ? h : 0;
  }

  // Where the border passes from one side to the other.
  std::array<PatchCutEnd, 2> ends;
  int found = 0, before = 0;
  while (before < count && height[size_t(before)] == 0) ++before;
  for (int step = 1, last = before; step <= count && before < count; ++step) {
    const int i = (before + step) % count;
    if (height[size_t(i)] == 0) continue;
    const double from = height[size_t(last)], to = height[size_t(i)];
    if ((from > 0) != (to > 0)) {
      const int between = (last + 1) % count;
      if (found == 2) return {};
      ends[size_t(found++)] =
          between == i ? PatchCutEnd{last, i, from / (from - to)} : PatchCutEnd{between, -1, 0};
    }
    last = i;
  }
  if (found != 2) return {};
  return ends;
}

std::array<Vec2d, 3> FlattenTriangle(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  // Lay the longest edge along x.
  const std::array<Vec3d, 3> corners = {a, b, c};
  size_t base = 0;
  double longest = -1;
  for (size_t i = 0; i < 3; ++i) {
    const double length = LengthSquared(corners[(i + 1) % 3] - corners[i]);
    if (length > longest) {
      longest = length;
      base = i;
    }
  }
  std::array<Vec2d, 3> flat;
  const double length = std::sqrt(longest);
  if (!(length > 0)) return {Vec2d(0, 0), Vec2d(1, 0), Vec2d(0, 1)};

  // The third corner stands above it.
  const Vec3d origin = corners[base];
  const Vec3d axis = (corners[(base + 1) % 3] - origin) / length;
  const Vec3d apex = corners[(base + 2) % 3] - origin;
  flat[base] = {0, 0};
  flat[(base + 1) % 3] = {length, 0};
  flat[(base + 2) % 3] = {Dot(apex, axis), std::max(Length(Cross(axis, apex)), kFlatness * length)};
  return flat;
}

}  // namespace lambert
