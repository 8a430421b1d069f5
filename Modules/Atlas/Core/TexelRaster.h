// The texels of a page that a triangle in the plane covers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "Common/Core/Vector.h"

namespace lambert {

/// Calls visit(x, y) for every texel of a page of `size` x `size` whose middle lies in the triangle
/// or on its border; corners in texels.
template <class Visit>
void ForEachTexelOf(const std::array<Vec2d, 3>& corners, int size, const Visit& visit) {
  const auto from = [&](double x) { return std::max(0, int(std::ceil(x - 0.5))); };
  const auto to = [&](double x) { return std::min(size - 1, int(std::floor(x - 0.5))); };
  const double low = std::min({corners[0].y, corners[1].y, corners[2].y});
  const double high = std::max({corners[0].y, corners[1].y, corners[2].y});
  for (int y = from(low); y <= to(high); ++y) {
    // A row of middles, from the left edge of the triangle to the right.
    double left = size, right = 0;
    for (size_t c = 0; c < 3; ++c) {
      const Vec2d &a = corners[c], &b = corners[(c + 1) % 3];
      const double part = (y + 0.5 - a.y) / (b.y - a.y);
      if (!(part >= 0 && part <= 1)) continue;
      left = std::min(left, a.x + part * (b.x - a.x));
      right = std::max(right, a.x + part * (b.x - a.x));
    }
    for (int x = from(left); x <= to(right); ++x) visit(x, y);
  }
}

/// What an edge takes between two upright lines.
inline void IncludeEdge(Vec2d a, Vec2d b, double left, double right, double* low, double* high) {
  if (a.x > b.x) std::swap(a, b);
  if (b.x < left || a.x > right) return;
  const auto at = [&](double x) {
    if (!(b.x > a.x)) return a.y;
    return a.y + (b.y - a.y) * std::min(1., std::max(0., (x - a.x) / (b.x - a.x)));
  };
  const double y[2] = {at(left), b.x > a.x ? at(right) : b.y};
  *low = std::min({*low, y[0], y[1]});
  *high = std::max({*high, y[0], y[1]});
}

/// Calls visit(x, low, high) for every column of texels within `width` x `height` that come nearer
/// to the triangle or edge than `margin`, >= 0, along an axis: those of rows [low, high).
template <size_t Corners, class Visit>
void ForEachColumnNear(const std::array<Vec2d, Corners>& corners, double margin, int width,
                       int height, const Visit& visit) {
  const auto [first, last] = std::minmax_element(
      corners.begin(), corners.end(), [](const Vec2d& a, const Vec2d& b) { return a.x < b.x; });
  const double left = first->x - margin, right = last->x + margin;
  for (int x = std::max(0, int(left)); x <= std::min(width - 1, int(right)); ++x) {
    double low = height, high = 0;
    for (size_t c = 0; c + (Corners == 2) < Corners; ++c) {
      IncludeEdge(corners[c], corners[(c + 1) % Corners], x - margin, x + 1 + margin, &low, &high);
    }
    if (low > high) continue;
    visit(x, std::max(0, int(std::floor(low - margin))),
          std::min(height, int(std::ceil(high + margin))));
  }
}

/// Calls visit(x, y) for every column of texels whose middle line an edge crosses: y is the first
/// row whose middle lies above. Lines that are closed cross each column an even number of times.
template <class Visit>
void ForEachCrossing(Vec2d a, Vec2d b, const Visit& visit) {
  if (a.x > b.x) std::swap(a, b);
  for (int x = int(std::ceil(a.x - 0.5)); x < int(std::ceil(b.x - 0.5)); ++x) {
    const double part = std::min(1., std::max(0., (x + 0.5 - a.x) / (b.x - a.x)));
    visit(x, int(std::ceil(a.y + part * (b.y - a.y) - 0.5)));
  }
}

/// The part of a triangle that lies in the square of a texel.
struct TexelCover {
  double area = 0;  ///< texels
  Vec2d middle;     ///< its centroid, in texels
};

/// Of a triangle that winds forward, in the texel from (x, y) to (x + 1, y + 1).
inline TexelCover CoverOfTexel(const std::array<Vec2d, 3>& corners, int x, int y) {
  // Cut off what lies beyond each side of the square, one after the other.
  std::array<Vec2d, 7> polygon = {corners[0], corners[1], corners[2]}, kept;
  size_t count = 3;
  for (int side = 0; side < 4 && count > 0; ++side) {
    const auto within = [&](const Vec2d& p) {
      return side == 0 ? p.x - x : side == 1 ? x + 1 - p.x : side == 2 ? p.y - y : y + 1 - p.y;
    };
    size_t keptCount = 0;
    for (size_t i = 0; i < count; ++i) {
      const Vec2d &a = polygon[i], &b = polygon[(i + 1) % count];
      const double atA = within(a), atB = within(b);
      if (atA >= 0) kept[keptCount++] = a;
      if ((atA < 0) != (atB < 0)) kept[keptCount++] = a + (b - a) * (atA / (atA - atB));
    }
    std::swap(polygon, kept);
    count = keptCount;
  }

  // What is left is a fan of triangles.
  TexelCover cover;
  Vec2d moment;
  for (size_t i = 1; i + 1 < count; ++i) {
    const Vec2d u = polygon[i] - polygon[0], v = polygon[i + 1] - polygon[0];
    const double area = 0.5 * (u.x * v.y - u.y * v.x);
    cover.area += area;
    moment = moment + (u + v) * (area / 3);
  }
  if (cover.area > 0) cover.middle = polygon[0] + moment * (1 / cover.area);
  return cover;
}

/// Less of a texel is rounding.
constexpr double kLeastCover = 1e-12;

/// Calls visit(x, y, TexelCover) for every texel of a page of `size` x `size` of which the triangle
/// covers at least kLeastCover, whichever way it winds; corners in texels.
template <class Visit>
void ForEachTexelCovered(std::array<Vec2d, 3> corners, int size, const Visit& visit) {
  const Vec2d u = corners[1] - corners[0], v = corners[2] - corners[0];
  if (u.x * v.y < u.y * v.x) std::swap(corners[1], corners[2]);
  ForEachColumnNear(corners, 0, size, size, [&](int x, int low, int high) {
    for (int y = low; y < high; ++y) {
      const TexelCover cover = CoverOfTexel(corners, x, y);
      if (cover.area >= kLeastCover) visit(x, y, cover);
    }
  });
}

/// Weights of the corners at a place in the plane; those of the nearest corner where the triangle
/// has no area.
inline std::array<double, 3> Barycentric(const std::array<Vec2d, 3>& corners, const Vec2d& place) {
  const auto twice = [](const Vec2d& a, const Vec2d& b, const Vec2d& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  };
  const double area = twice(corners[0], corners[1], corners[2]);
  const std::array<double, 3> weights = {twice(corners[1], corners[2], place) / area,
                                         twice(corners[2], corners[0], place) / area,
                                         twice(corners[0], corners[1], place) / area};
  if (std::isfinite(weights[0]) && std::isfinite(weights[1]) && std::isfinite(weights[2])) {
    return weights;
  }
  size_t nearest = 0;
  double least = std::numeric_limits<double>::max();
  for (size_t c = 0; c < 3; ++c) {
    const double d = std::hypot(corners[c].x - place.x, corners[c].y - place.y);
    if (d < least) least = d, nearest = c;
  }
  std::array<double, 3> one = {0, 0, 0};
  one[nearest] = 1;
  return one;
}

}  // namespace lambert
