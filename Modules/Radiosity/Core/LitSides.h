// Which sides of which surfaces can light reach? Dark ones are not modelled and cost nothing.
#pragma once

#include <cstdint>
#include <vector>

#include "Clustering/Core/FaceClustering.h"
#include "Scene/Core/Scene.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

/// Per surface, bit 1 where light reaches its front, bit 2 its back. Rays from samples of every
/// side tell which sides see each other or the sky, rays to lights and to emitters that a sample
/// may get most from, which of these they see; a side is lit that emits or sees a lit one, directly
/// or over others. Sampled, so that a side that sees light only through a chink may
/// be missed; it then stays black.
std::vector<uint8_t> FindLitSides(const Scene& scene, const ClusterTree& tree,
                                  const RayScene& rayScene, int64_t* rays);

}  // namespace lambert
