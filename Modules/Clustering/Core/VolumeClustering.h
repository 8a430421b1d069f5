// Volume clusters: a binary tree over surfaces, by the surface-area cost (thesis 4.3.2, eq. 4.22).
#pragma once

#include <cstdint>
#include <vector>

#include "Common/Core/Vector.h"

namespace lambert {

struct VolumeNode {
  int32_t parent = -1;
  int32_t child = -1;  ///< first of two children, which stand side by side; -1 at a leaf
  int32_t item = -1;   ///< index of the box at a leaf; -1 inside
  int32_t itemCount = 0;
  Box3f bounds;
};

/// Binary tree over `boxes`, root first; empty for none. O(n log n). Ties are broken by index, so
/// that the tree depends on the boxes alone.
std::vector<VolumeNode> ClusterVolumes(const std::vector<Box3f>& boxes);

}  // namespace lambert
