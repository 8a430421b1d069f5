// Refinement of links: a link in error beyond the threshold is replaced by links to the children of
// one of its ends (thesis 3.2.2, 4.5.2).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "Common/Core/Progress.h"
#include "Radiosity/Core/Element.h"
#include "Radiosity/Core/ElementHierarchy.h"
#include "Radiosity/Core/RefinementOracle.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

/// The light of every element, by element index.
struct ElementLight {
  std::vector<Spectrum> radiosity;  ///< W/m2; of lights: intensity, irradiance or radiance
  std::vector<float> variation;  ///< standard deviation of the radiosity within the element, W/m2
  std::vector<VectorIrradiance> irradiance;  ///< W/m2, what ancestors receive included
  std::vector<float>
      rowScale;  ///< (0, 1]: keeps the form factors of a leaf's links from adding up to more than 1

  /// Room for new elements: children start with their parent's reflected light and their own
  /// emission.
  void Grow(const ElementHierarchy& hierarchy);
};

/// The links of every element, by receiver.
struct LinkNetwork {
  std::vector<std::vector<Link>> incoming;
  int64_t rays = 0;  ///< cast so far
  int64_t linksAtFloor =
      0;  ///< links over the last threshold whose ends could not be split further

  int64_t Count() const;
};

/// The first links: the scene with itself, black emitters and lights to the scene (4.5.1).
void MakeInitialLinks(const ElementHierarchy& hierarchy, LinkNetwork* network);

/// Called before elements are split with how many elements and links are about to come; false
/// where there is no room for them. May be empty.
using RoomCallback = std::function<bool(int64_t elements, int64_t links)>;

/// Refines every link whose error, by `oracle`, exceeds `threshold` (W), splitting the end that
/// contributes most to it, until none does or nothing can be split. Returns false, with the links
/// as they were, where `progress` asked to stop or `hasRoom` said that there is no room; elements
/// made until then have their part of what their parents receive.
bool RefineLinks(double threshold, const RefinementOracle& oracle, const RayScene& rayScene,
                 ElementHierarchy* hierarchy, ElementLight* light, LinkNetwork* network,
                 const ProgressCallback& progress = {}, const RoomCallback& hasRoom = {});

/// Gives the children of each of `parents` links of their own in place of those of the parent's
/// links that bring more than `part` of its light: for children of which some are hidden and some
/// open.
void PushLinksToChildren(const std::vector<int32_t>& parents, float part, const RayScene& rayScene,
                         const ElementHierarchy& hierarchy, const ElementLight& light,
                         LinkNetwork* network);

}  // namespace lambert
