// Closed lamps that are wound inside out.
#pragma once

#include "Scene/Core/Scene.h"
#include "Scene/Core/ScenePlacement.h"

namespace lambert {

/// Turns the emission of closed pieces that are wound inward and hold nothing. A piece is taken as
/// inverted where it is closed, most of its area emits, some of it only inward, and no other piece,
/// no light with a position and no camera lies within it; those faces then emit outward. A scene
/// of that one piece alone is left as it is: outside there is nothing to light. What lies within is
/// found by the winding number at one face of each other piece that lies in the bounds, at most
/// 1000 of them evenly chosen.
/// Returns, per material, how many pieces had faces of it turned.
std::vector<int64_t> TurnInvertedEmitters(const std::vector<CleanedMesh>& meshes,
                                          const PartRanges& ranges, Scene* scene);

}  // namespace lambert
