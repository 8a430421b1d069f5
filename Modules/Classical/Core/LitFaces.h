// Which sides of which faces can light reach? Dark ones are not modelled and cost nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "Classical/Core/SourceLight.h"
#include "Classical/Core/UniformMesh.h"
#include "Scene/Core/Scene.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

/// Per face of the scene, bit 1 where light reaches its front, bit 2 its back: where the side
/// emits, or more than 2 in a thousand of the paths that start on it find a light, an emitter or
/// the sky. 16 paths a side at least, one from every element, of up to 6 bounces. Sides beside lit
/// ones, and those where rays from lit ones arrive, get 512 before they count as dark, and so on
/// from what is found. A side that sees light only through a chink may be missed; it then stays
/// black. Adds the rays to `rays`.
std::vector<uint8_t> FindLitFaces(const Scene& scene, const UniformMesh& mesh,
                                  const RayScene& rayScene, const SourceLight& sources,
                                  int64_t* rays);

}  // namespace lambert
