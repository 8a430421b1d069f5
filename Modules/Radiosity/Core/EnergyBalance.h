// Where the light went: emitted = absorbed - covered + escaped, each found on its own.
#pragma once

#include "Radiosity/Core/ElementHierarchy.h"
#include "Radiosity/Core/LinkRefinement.h"
#include "Scene/Core/RadiositySolution.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

/// Fills `emitted`, `absorbed`, `escaped` and `covered` (W per band) of the statistics. Emitted: of
/// faces and of point and spot lights; skies and directional lights count with what arrives from
/// them. Absorbed: by the leaves, and by emitters that do not reflect, by rays. Escaped: what
/// leaves the leaves, by rays that meet nothing; light of point lights too. Covered: the part of
/// the absorbed that falls on faces under others nearer than what rays skip, where the same light
/// counts twice.
void MeasureEnergyBalance(const ElementHierarchy& hierarchy, const LinkNetwork& network,
                          const ElementLight& light, const RayScene& rayScene,
                          SolverStatistics* statistics);

}  // namespace lambert
