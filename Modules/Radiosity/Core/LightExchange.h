// Gather along links, push down, pull up: one bounce of light through the hierarchy
// (thesis 4.2.3, 4.5.2).
#pragma once

#include "Radiosity/Core/ElementHierarchy.h"
#include "Radiosity/Core/LinkRefinement.h"

namespace lambert {

/// One gather and push-pull. Returns the relative change of radiosity, by power: sum |b - b_old| A
/// / sum b A over leaves.
double ExchangeLight(const ElementHierarchy& hierarchy, const LinkNetwork& network,
                     ElementLight* light);

/// Fills `light->rowScale`: of every leaf whose form factors to all it is linked with add up to
/// more than `bound`, as sampled ones may, the factor that brings their sum down to it. With a
/// bound of 1 no bounce gains energy and sweeps converge; but sums scatter about 1, and to cut
/// those above it alone darkens the scene.
void BoundRowSums(const ElementHierarchy& hierarchy, const LinkNetwork& network, float bound,
                  ElementLight* light);

/// Irradiance of an element as a whole: (4.21) before reflection, W/m2.
Spectrum ElementIrradiance(const Element& element, const VectorIrradiance& irradiance);

/// Power that all leaves receive, W, largest band.
double ReceivedPower(const ElementHierarchy& hierarchy, const ElementLight& light);

/// What arrives at a child of what its parent receives (4.16).
VectorIrradiance PushIrradiance(const Element& parent, const VectorIrradiance& irradiance,
                                const Element& child);

}  // namespace lambert
