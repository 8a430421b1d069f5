// How wrong a link may be, from geometry and visibility, never from the spread of its own samples:
// that would keep the links that miss what they should see.
#pragma once

#include "Radiosity/Core/Element.h"
#include "Radiosity/Core/ElementHierarchy.h"

namespace lambert {

/// Geometry of a pair of elements, for unit radiosity of the source.
struct PairBound {
  bool apart = false;    ///< neither can light the other: no link at all
  float formFactor = 0;  ///< irradiance on the receiver with nothing in the way, a mid estimate in
                         ///< [0, 1]; lights: W/m2
  float receiverSpread =
      0;  ///< relative variation over the receiver that reconstruction cannot follow, [0, 1]
  float sourceSpread = 0;  ///< relative error of the source's shape, [0, 1]; 0 for polygons
  float nearness =
      0;  ///< size of the source over its distance, [0, 1]: how much its own variation counts
};

PairBound BoundPair(const ElementHierarchy& hierarchy, const Element& source,
                    const Element& receiver);

/// Error of a transfer, W/m2 on the receiver, split by whose refinement lessens it.
struct TransferError {
  float byReceiver = 0, bySource = 0;
  float Sum() const { return byReceiver + bySource; }
};

/// `radiosity`: largest band of the source; `variation`: standard deviation of it within the
/// source, W/m2. `visibility`: sampled, in [0, 1], or negative where it is not known yet.
TransferError EstimateError(const PairBound& bound, float radiosity, float variation,
                            float visibility, const Element& source, const Element& receiver);

}  // namespace lambert
