// Whether all of one planar element sees all of another, or nothing of it: by the hull of the two
// (haines1991), not by samples.
#pragma once

#include <vector>

#include "Clustering/Core/VolumeClustering.h"
#include "Radiosity/Core/Element.h"
#include "Radiosity/Core/ElementHierarchy.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

/// Answers for pairs of polygons and flat clusters; of all others it knows nothing. Exact but for
/// what rays skip too: faces that reach less than RayScene::Epsilon() into a shaft do not block.
/// Safe to use from several threads.
class Shafts {
 public:
  /// Keeps references to both.
  Shafts(const ElementHierarchy& hierarchy, const RayScene& rayScene);

  /// True only where no face reaches between the two. Faces are found down the volume and face
  /// clusters (thesis 4.5.4); a face of which no plane of the hull parts it counts as between.
  bool IsClear(const Element& source, const Element& receiver) const;
  /// True only where one face lies across all segments between the two.
  bool IsBlocked(const Element& source, const Element& receiver) const;

 private:
  struct Hull;
  std::vector<Vec3f> CornersOf(const Element& element) const;
  bool IsEmpty(const Hull& hull, int32_t clusterNode) const;

  const ElementHierarchy& hierarchy_;
  const RayScene& rayScene_;
  std::vector<VolumeNode> volumes_;  ///< over all surfaces, also those that no light reaches
};

}  // namespace lambert
