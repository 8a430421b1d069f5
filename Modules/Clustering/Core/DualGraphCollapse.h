// Collapses the dual graph of one surface, edge by edge, into a binary tree of face clusters
// (thesis 4.2.2).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "Clustering/Core/MergeTree.h"
#include "Common/Core/TriangleMesh.h"

namespace lambert {

/// One surface: `count` faces of `mesh`, and for each the up to three others (by place in `faces`)
/// beside it, -1 for none, by edge (corner e to corner e + 1). Connected.
struct SurfaceFaces {
  const TriangleMesh* mesh = nullptr;
  const int32_t* faces = nullptr;
  const std::array<int32_t, 3>* neighbours = nullptr;
  int32_t count = 0;
};

/// The tree of a surface. `balance` is k of (4.8). `proceed` is called now and then with the
/// fraction done; false ends the work with Cancelled. Uses all threads for large surfaces, one for
/// small ones; the same tree in any case.
MergeTree CollapseDualGraph(const SurfaceFaces& surface, double balance,
                            const std::function<bool(double)>& proceed = {});

}  // namespace lambert
