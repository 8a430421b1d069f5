// An atlas that was made before: the light of a scene drawn where its surfaces lie already.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "Atlas/Core/RadiosityAtlas.h"
#include "Atlas/Core/ShownSides.h"

namespace lambert {

struct StoredAtlas {
  RadiosityAtlas atlas;
  std::vector<std::array<Vec3f, 3>> corners;  ///< by face: m
  /// By face, of an atlas that has both sides of sheets: of the scene, and the side of that face
  /// which it shows (ShownSides). Else empty: its faces are those of the scene.
  std::vector<int64_t> inputFace;
  std::vector<uint8_t> side;
  /// It is of the surfaces, or parts of them, that a light map took, some of the scene's faces.
  /// These `inputFace` tells, `side` where there are sheets.
  bool isOfChosen = false;
};

/// What a mesh with texture coordinates does not say itself: points by their numbers within their
/// charts, and the utilisation. Corners of `mesh` that are one place of a chart are one point.
void CompleteAtlas(const TriangleMesh& mesh, RadiosityAtlas* atlas);

/// Whether its faces are those of `mesh`, or some of these where it is of chosen surfaces. `mesh`
/// is in the order of `tree` and has surfaces.
bool IsAtlasOf(const StoredAtlas& stored, const TriangleMesh& mesh, const ClusterTree& tree);

/// The sides that such an atlas shows in the light of a solution of `mesh`: both of its own sheets,
/// of all other surfaces the one that receives more power, where charts of the other one are turned
/// over. Nothing where the atlas does not tell sides: the mesh then does as it is.
std::optional<ShownSides> ShowStoredSides(const TriangleMesh& mesh, const ClusterTree& tree,
                                          const RadiositySolution& solution, StoredAtlas* stored);

/// By surface of `mesh`: whether all its faces have charts, of one side or the other.
std::vector<bool> FindLaidSurfaces(const StoredAtlas& stored, const TriangleMesh& mesh);

/// The sides that show where surfaces are chosen, and what has no chart is lit at its points: both
/// of the sheets that the atlas has or the light makes; nothing where there are none.
std::optional<ShownSides> ShowSidesOfChosen(const TriangleMesh& mesh, const ClusterTree& tree,
                                            const RadiositySolution& solution,
                                            const StoredAtlas& stored);

/// By face of the sides that show, or of `mesh` itself: the face of the atlas that is laid flat for
/// it; -1 where none is. Of what is no sheet any more the brighter side takes the charts. Turns
/// over those that face the other way now.
std::vector<int64_t> FindLaidFaces(const TriangleMesh& mesh, const ShownSides* shown,
                                   StoredAtlas* stored);

/// What `atlas` has of some of its faces, in that order, on the pages that they need.
RadiosityAtlas TakeFacesOfAtlas(const RadiosityAtlas& atlas, const std::vector<int64_t>& faces);

}  // namespace lambert
