// The displayable mesh: leaf triangles with light at their points, in the terms of the contract.
#pragma once

#include "Radiosity/Core/LightReconstruction.h"
#include "Scene/Core/RadiositySolution.h"

namespace lambert {

/// Triangulates the leaves and evaluates their light. `litSides` as given to the hierarchy, per
/// surface; a face that has no lit side is delivered black, by its front. Adds the rays cast to
/// `rays`.
RadiositySolution MakeRefinedMesh(ElementHierarchy* hierarchy, const LightReconstruction& light,
                                  const std::vector<uint8_t>& litSides, int64_t* rays);

}  // namespace lambert
