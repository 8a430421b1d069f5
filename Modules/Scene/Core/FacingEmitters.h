// Lamps that face a surface at no distance.
#pragma once

#include "Scene/Core/Scene.h"
#include "Scene/Core/ScenePlacement.h"

namespace lambert {

/// Turns the emission of lamps that face nothing but a surface at no distance, to their other side.
/// A lamp is the connected faces of a part that are of one material and emit from one side each;
/// those of either winding are judged for themselves. They are turned where
///  - straight ahead of each of at least 32 points, four or more a face, stratified by area, lies a
///    face that is not of the lamp, at no distance, and
///  - straight behind one of them there is none, not even in the lamp's own plane, and no face of
///    the lamp at any distance: a closed lamp does not shine into itself.
/// "No distance" is a gap of which at most 5 % of the light finds the rim, 0.1 area / perimeter of
/// the lamp (a fortieth of the side of a square), but no less than 1e-5 of the scene's diagonal
/// (rays start there: it would shine through) and no more than 1e-3 of it. What is nearer than 1e-6
/// of the diagonal, or of the largest coordinate where that is more, lies in the lamp's plane by
/// all that a file's digits tell, and so on neither side: a lamp in the ceiling's plane stays.
/// Returns, per material, how many lamps were turned.
std::vector<int64_t> TurnFacingEmitters(const std::vector<CleanedMesh>& meshes,
                                        const PartRanges& ranges, Scene* scene);

}  // namespace lambert
