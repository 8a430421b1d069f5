// Elements and links by kind.
#pragma once

#include "Radiosity/Core/ElementHierarchy.h"
#include "Radiosity/Core/LinkRefinement.h"
#include "Scene/Core/RadiositySolution.h"

namespace lambert {

/// Fills the counts of elements and links, `rays` and `linksAtFloor` of the statistics.
void CountElementsAndLinks(const ElementHierarchy& hierarchy, const LinkNetwork& network,
                           SolverStatistics* statistics);

}  // namespace lambert
