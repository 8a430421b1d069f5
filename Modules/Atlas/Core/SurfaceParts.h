// Surfaces cut into clusters that show their light in one way each (thesis 5.3 leaves this open):
// what refinement left as it was at points, the rest in a light map, and hardly a step between.
#pragma once

#include <cstdint>
#include <vector>

#include "Atlas/Core/LightMap.h"
#include "Atlas/Core/RadiosityAtlas.h"
#include "Atlas/Core/SurfaceSubset.h"
#include "Clustering/Core/FaceClustering.h"
#include "Common/Core/TriangleMesh.h"
#include "Scene/Core/RadiositySolution.h"

namespace lambert {

/// The parts of surfaces, each a cluster of its tree: surfaces of a tree of their own, in the order
/// of the faces.
struct SurfaceParts {
  ClusterTree tree;
  std::vector<int32_t> partOfFace;
  std::vector<int32_t> surfaceOfPart;
};

/// Cuts the surfaces that may be cut down their trees, until what was not refined is apart from
/// what was. A cluster of less than a 32nd of its surface stays whole. `mesh` is in the order of
/// `tree`; triangles of `solution` lie on one side of every surface.
SurfaceParts CutWhereRefined(const TriangleMesh& mesh, const ClusterTree& tree,
                             const RadiositySolution& solution, const std::vector<bool>& mayBeCut);

/// Cuts parts on, down their trees, until all faces of each are laid flat or none is.
SurfaceParts CutWhereLaid(const SurfaceParts& parts, const std::vector<int64_t>& laidFaces);

/// Where what a light map shows of a surface ends and points show the rest: places along the edges
/// between the two (ForEachPlaceAlong), and the light that points show there. `mapped` has the
/// faces of `mesh` that `atlas` is of; `mesh`, with its uncut surfaces, and `solution` as above.
std::vector<BorderPoint> FindBorders(const TriangleMesh& mesh, const RadiositySolution& solution,
                                     const SurfaceSubset& mapped, const RadiosityAtlas& atlas);

}  // namespace lambert
