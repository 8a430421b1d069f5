// Which sides of which faces can light reach? Dark ones are not modelled and cost nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "Classical/Core/UniformMesh.h"
#include "Scene/Core/Scene.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

/// Per face of the scene, bit 1 where light reaches its front, bit 2 its back. Rays from the
/// elements of every side tell which sides see each other, a light or the sky; a side is lit that
/// emits or sees a lit one, directly or over others. Sampled (64 rays a side at least), so that a
/// side that sees light only through a chink may be missed; it then stays black. Adds the rays to
/// `rays`.
std::vector<uint8_t> FindLitFaces(const Scene& scene, const UniformMesh& mesh,
                                  const RayScene& rayScene, int64_t* rays);

}  // namespace lambert
