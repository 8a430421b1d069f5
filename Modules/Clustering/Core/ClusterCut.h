// Cuts through a cluster tree: sets of clusters that hold every face once.
#pragma once

#include <cstdint>
#include <vector>

#include "Clustering/Core/FaceClustering.h"

namespace lambert {

/// The clusters `level` steps below the roots, and the leaves above them; level 0 gives the
/// surfaces. Nodes in ascending order of their first face. Throws Error for a negative level.
std::vector<int32_t> CutAtLevel(const ClusterTree& tree, int32_t level);

/// At least one cluster a surface, then always the one of the largest area is split until there are
/// `count` of them or only faces are left. Nodes in ascending order of their first face.
std::vector<int32_t> CutToCount(const ClusterTree& tree, int64_t count);

}  // namespace lambert
