#include "Atlas/Core/ChartRoom.h"

#include <cmath>

#include "Clustering/Core/ClusterFrame.h"

namespace lambert {

Room RoomOf(const std::vector<Vec2d>& places) {
  std::vector<Vec2f> points;
  for (const Vec2d& p : places) points.emplace_back(p);
  const Vec2d half(MinimumAreaRectangle(points).halfExtent);
  return {4 * half.x * half.y, 4 * (half.x + half.y)};
}

double MostMargin(const Room& whole, const std::array<Room, 2>& parts, double fraction) {
  const double squares = 4 * (2 - fraction);
  const double linear = parts[0].perimeter + parts[1].perimeter - fraction * whole.perimeter;
  const double constant = parts[0].area + parts[1].area - fraction * whole.area;
  if (constant > 0) return -1;
  return (std::sqrt(linear * linear - 4 * squares * constant) - linear) / (2 * squares);
}

}  // namespace lambert
