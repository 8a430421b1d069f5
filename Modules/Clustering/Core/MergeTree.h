// A binary tree as the list of its merges, and the bound on its depth.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "Common/Core/Vector.h"

namespace lambert {

/// Leaves are 0 to leafCount - 1; merge i makes node leafCount + i of two earlier nodes, the last
/// one the root. (LimitDepth keeps the root but not the order.)
struct MergeTree {
  int32_t leafCount = 0;
  std::vector<std::array<int32_t, 2>> merges;  ///< leafCount - 1 of them

  int32_t Root() const { return 2 * leafCount - 2; }
  bool IsLeaf(int32_t node) const { return node < leafCount; }
  const std::array<int32_t, 2>& Children(int32_t node) const {
    return merges[size_t(node - leafCount)];
  }
};

/// Largest depth that LimitDepth grants to a tree of `leafCount` leaves: 3.5 log2 leafCount.
int32_t DepthLimit(int32_t leafCount);

/// Rebuilds the chains of `tree` that reach below DepthLimit: the pieces that a chain took up one
/// by one are joined by a spatial bisection of equal weights instead. Returns the number of merges
/// that were rebuilt.
int64_t LimitDepth(MergeTree* tree, const std::function<Vec3f(int32_t leaf)>& leafCenter);

}  // namespace lambert
