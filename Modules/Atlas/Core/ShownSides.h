// The sides of surfaces that a light map shows. A sheet that is lit on both sides is two surfaces,
// back to back.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "Clustering/Core/FaceClustering.h"
#include "Common/Core/TriangleMesh.h"
#include "Scene/Core/RadiositySolution.h"

namespace lambert {

/// Throws Error where a triangle of the solution does not lie on its face: of another mesh, or of
/// the same one in another order.
void RequireSameFaces(const TriangleMesh& mesh, const RadiositySolution& solution);

/// Of every surface of `mesh` the side that shows in a light map: that which receives more power,
/// of dark ones the larger.
std::vector<uint8_t> BrighterSidesOfSurfaces(const TriangleMesh& mesh,
                                             const RadiositySolution& solution);

/// By surface, whether both sides show: on the dimmer one there is at least 10 % of the mean
/// irradiance of the brighter sides of all; or a ten-thousandth, if it is flat (vector area over
/// half its area) or its piece is open (holes over a quarter of its area). Not the inside of a
/// solid: light that the solution has there has seeped in.
std::vector<bool> FindSheets(const TriangleMesh& mesh, const ClusterTree& tree,
                             const RadiositySolution& solution);

/// A solved mesh whose faces are wound towards the side that they show, and emit from there alone:
/// first all faces in their order, of the brighter sides, then those of the second sides of sheets,
/// each sheet a surface with a tree and points of its own.
struct ShownSides {
  TriangleMesh mesh;
  ClusterTree tree;
  std::vector<int64_t> inputFace;     ///< by face: of the solved mesh
  std::vector<uint8_t> side;          ///< by face: of that face, which it shows
  std::vector<int32_t> inputSurface;  ///< by surface: of the solved mesh
  std::vector<int64_t> inputPoint;    ///< by point: of the solved mesh
};

/// Which side of each surface shows, and whether the other one does, too.
struct SidesOfSurfaces {
  std::vector<uint8_t> first;
  std::vector<bool> isSheet;
};
ShownSides ShowSides(const TriangleMesh& mesh, const ClusterTree& tree,
                     const SidesOfSurfaces& sides);

/// Nothing where there are no sheets: the mesh then does as it is. `mesh` is in the order of
/// `tree`. Throws Error where the solution is not of this mesh.
std::optional<ShownSides> ShowBothSides(const TriangleMesh& mesh, const ClusterTree& tree,
                                        const RadiositySolution& solution);

/// The solution on the faces that show its sides (ShownSides::inputFace and side): their light lies
/// on fronts. A side that none shows is the back of the face that shows the other. Throws Error
/// where no face shows either. Without inputIrradiance.
RadiositySolution OntoShownSides(RadiositySolution solution, const std::vector<int64_t>& inputFace,
                                 const std::vector<uint8_t>& side);

}  // namespace lambert
