// Light that leaves send to each other over the rays that they have cast, to the last bounce.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "Common/Core/Spectrum.h"
#include "Radiosity/Core/Element.h"

namespace lambert {

/// What is known of the light that a leaf receives: at its samples, and their mean. Light by
/// element and place lies in a row.
constexpr int kMean = kSamplesPerElement, kPlacesOfLeaf = kSamplesPerElement + 1;

/// A ray of a leaf's sample.
struct LeafRay {
  int32_t element = -1;  ///< the leaf that it sees; -1: none
  int32_t place = 0;     ///< of it
  Spectrum part;         ///< that comes back along the ray of what the place receives
};

/// The rays of the leaves that gather, a row of them a leaf.
struct LeafRows {
  std::vector<int32_t> leaves;  ///< elements
  std::vector<float> areas;     ///< of them, m2
  std::vector<int64_t> begin;   ///< of each leaf's rays, those of its samples in a row; one more
  std::vector<LeafRay> rays;
  /// From sources, directly and over one bounce, W/m2.
  std::vector<std::array<Spectrum, kSamplesPerElement>> fromSources;
};

/// Irradiance by element and place, W/m2, once light is in balance: bounce by bounce from the dark
/// on, so that what no light reaches stays dark however little it absorbs. What does not gather
/// keeps what it has of `received`; no place is brighter than `most`. How facets turn within a leaf
/// has to be left out of the rays: in the mean it neither adds nor takes light, but over the few
/// rays of closed things it may add more than is absorbed.
std::vector<Spectrum> BalanceLeaves(const LeafRows& rows, const std::vector<Spectrum>& received,
                                    const Spectrum& most);

}  // namespace lambert
