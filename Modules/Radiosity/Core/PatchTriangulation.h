// The triangles of one patch with t-vertices on its border: constrained Delaunay (thesis 4.4.3).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "Radiosity/Core/PatchSplitting.h"

namespace lambert {

/// Triangles of a convex counter-clockwise polygon as indices into its border. They use every
/// border vertex and edge, border.size() - 2 triangles in all, counter-clockwise. Sides with
/// t-vertices need be straight to rounding only.
std::vector<std::array<int32_t, 3>> TriangulatePatch(const std::vector<PatchBorderVertex>& border);

}  // namespace lambert
