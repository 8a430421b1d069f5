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
};

/// What a mesh with texture coordinates does not say itself: points by their numbers within their
/// charts, and the utilisation. Corners of `mesh` that are one place of a chart are one point.
void CompleteAtlas(const TriangleMesh& mesh, RadiosityAtlas* atlas);

/// Whether its faces are those of `mesh`, which is in the order of `tree` and has surfaces.
bool IsAtlasOf(const StoredAtlas& stored, const TriangleMesh& mesh, const ClusterTree& tree);

/// The sides that such an atlas shows in the light of a solution of `mesh`: both of its own sheets,
/// of all other surfaces the one that receives more power, where charts of the other one are turned
/// over. Nothing where the atlas does not tell sides: the mesh then does as it is.
std::optional<ShownSides> ShowStoredSides(const TriangleMesh& mesh, const ClusterTree& tree,
                                          const RadiositySolution& solution, StoredAtlas* stored);

}  // namespace lambert
