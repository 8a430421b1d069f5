// Charts laid flat: least squares conformal maps (levy2002), and what makes a flat chart valid.
#pragma once

#include <vector>

#include "Atlas/Core/ChartMesh.h"

namespace lambert {

/// Places of the vertices in the plane, m, such that angles are kept as well as may be; the chart
/// keeps its area as a whole. Slivers count little: their angles would poison what is around them.
/// Empty where there is no such map.
std::vector<Vec2d> ConformalMap(const ChartMesh& chart);

/// Places of the vertices seen along the unit vector `axis`, m.
std::vector<Vec2d> ProjectedMap(const ChartMesh& chart, const Vec3d& axis);

/// By how much lengths grow or shrink at most, as a factor of at least 1, where a map is valid: no
/// triangle is flipped, and no place of the plane is taken twice (the outer border and the holes
/// are simple polygons, by exact predicates). 0 where it is not. Triangles of a height under a
/// thousandth of their length count by their length alone, and may lie flat.
double Stretch(const ChartMesh& chart, const std::vector<Vec2d>& map);

}  // namespace lambert
