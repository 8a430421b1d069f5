// Receivers that are half hidden in or behind something near are split until what is hidden and
// what is open part company; else an element averages both, and darkness or light shows where it
// should not.
#pragma once

#include <cstdint>
#include <vector>

#include "Radiosity/Core/ElementHierarchy.h"
#include "Radiosity/Core/LinkRefinement.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

/// What is known of an element's exposure; kept between iterations.
enum class Exposure : uint8_t { Unknown, Even, Mixed };

/// Splits leaves of which one sample is enclosed and another open, within the reach of their own
/// size, as long as they receive more than `threshold` (W), and gives their children links of their
/// own.
void SplitByExposure(double threshold, const RayScene& rayScene, ElementHierarchy* hierarchy,
                     ElementLight* light, LinkNetwork* network, std::vector<Exposure>* exposures);

}  // namespace lambert
