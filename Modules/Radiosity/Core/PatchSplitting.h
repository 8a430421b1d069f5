// Where a patch is cut: across the longer side of its minimum-area rectangle (thesis 4.4.2), or at
// the middles of its sides (3.4.2).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "Common/Core/Vector.h"

namespace lambert {

/// A vertex of a patch's border, in the plane of its face.
struct PatchBorderVertex {
  Vec2d position;
  bool isCorner = true;  ///< false for a t-vertex, which lies on a straight side
};

/// Minimum-area enclosing rectangle.
struct PatchRectangle {
  Vec2d center;
  Vec2d axis;         ///< unit, along the longer side
  double length = 0;  ///< longer side
  double width = 0;   ///< shorter side
};

/// Place on a patch's border: `fraction` of the way from one border vertex to the next, or the
/// vertex `from` itself where `to` is -1.
struct PatchCutEnd {
  int from = 0;
  int to = -1;
  double fraction = 0;
};

/// Whether the border has three corners, t-vertices not counted.
bool IsTriangle(const std::vector<PatchBorderVertex>& border);

/// Largest distance along an axis of the plane from the first vertex to any other.
double PatchExtent(const std::vector<PatchBorderVertex>& border);

/// Rectangle around the corners of a convex polygon, one side flush with an edge. Of rectangles of
/// equal area the longest is taken: every acute triangle has three.
PatchRectangle MinimumPatchRectangle(const std::vector<PatchBorderVertex>& border);

/// Ends of the line that cuts the convex counter-clockwise polygon `border` across the middle of
/// its rectangle's longer side. Each end moves to the nearest vertex within `snapTolerance`
/// (fraction of the longer side, [0, 0.5)), as long as the line then leans by no more than 45
/// degrees: a thin patch cut aslant would only leave sharper tips. The ends lie on different sides
/// of the polygon and apart from every vertex that they are not.
std::array<PatchCutEnd, 2> CutPatch(const std::vector<PatchBorderVertex>& border,
                                    double snapTolerance);

/// Middles of the three sides of a triangular border, from its first corner on: where regular
/// refinement cuts it. A vertex within 1e-4 of the side's length of its middle is taken for it.
std::array<PatchCutEnd, 3> SideMiddles(const std::vector<PatchBorderVertex>& border);

/// Ends of the line through `a` and `b` in the same border; none where the border does not lie on
/// both sides of it. Vertices within a thousandth of the border's extent of the line lie on it.
std::optional<std::array<PatchCutEnd, 2>> CutPatchAlong(
    const std::vector<PatchBorderVertex>& border, Vec2d a, Vec2d b);

/// Corners of a triangle in its own plane, counter-clockwise, the longest edge along x. A triangle
/// without area gets a height of 1e-9 of its length, so that its parts keep their proportions and
/// nothing divides by zero.
std::array<Vec2d, 3> FlattenTriangle(const Vec3d& a, const Vec3d& b, const Vec3d& c);

}  // namespace lambert
