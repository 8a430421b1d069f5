// Other materials on the faces that a scene has.
#pragma once

#include <cstdint>
#include <vector>

#include "Scene/Core/Scene.h"

namespace lambert {

/// Gives `scene` the reflectance and emittance of `next`, the same scene with face `order[i]` in
/// place of face i. False, with nothing changed, where these are what it has, or where more than
/// materials differs: points, faces, parts, or which faces share a material.
bool TakeMaterials(const Scene& next, const std::vector<int64_t>& order, Scene* scene);

}  // namespace lambert
