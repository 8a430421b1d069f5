// Parts that are one mesh, placed several times.
#pragma once

#include <vector>

#include "Clustering/Core/DualGraph.h"
#include "Scene/Core/Scene.h"

namespace lambert {

/// For each part the earlier part whose clusters fit it too, else the part itself. They fit where
/// both name the same mesh, hold the same faces with the same materials, and a similarity takes the
/// points of one to those of the other.
std::vector<int32_t> FindInstances(const TriangleMesh& mesh, const PartFaces& parts,
                                   const std::vector<Part>& partTable);

}  // namespace lambert
