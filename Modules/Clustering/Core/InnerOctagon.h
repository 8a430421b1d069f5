// What lies well within some points of the plane: none of it is a corner of their hull.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "Common/Core/Vector.h"

namespace lambert {

/// The octagon through the points that lie farthest along x, y and between; convex,
/// counter-clockwise, some of its corners may be one.
class InnerOctagon {
 public:
  InnerOctagon() { farthest_.fill(std::numeric_limits<double>::lowest()); }

  void Include(const Vec2f& point) {
    const Vec2d p(point);
    const double along[8] = {p.x, p.x + p.y, p.y, p.y - p.x, -p.x, -p.x - p.y, -p.y, p.x - p.y};
    for (size_t i = 0; i < 8; ++i) {
      if (!(along[i] > farthest_[i])) continue;
      farthest_[i] = along[i];
      corners_[i] = p;
    }
  }
  /// Within its sides, moved inward by far more than double arithmetic errs.
  bool Holds(const Vec2d& p) const {
    constexpr double kInside = 1e-9;  // of the extent, as a height over a side
    const double extent = std::max(farthest_[0] + farthest_[4], farthest_[2] + farthest_[6]);
    bool hasSide = false;
    for (size_t i = 0; i < 8; ++i) {
      const Vec2d &a = corners_[i], side = corners_[(i + 1) % 8] - a, d = p - a;
      if (side == Vec2d()) continue;
      const double least = kInside * extent * std::sqrt(side.x * side.x + side.y * side.y);
      if (!(d.y * side.x - d.x * side.y > least)) return false;
      hasSide = true;
    }
    return hasSide;
  }

 private:
  std::array<Vec2d, 8> corners_;
  std::array<double, 8> farthest_;
};

}  // namespace lambert
