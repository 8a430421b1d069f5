// Light at any point of the elements: links re-evaluated at the corners of clusters and at points
// of triangles, and interpolated in between (thesis 4.5.5, 6.4.1).
#pragma once

#include <array>
#include <vector>

#include "Radiosity/Core/ElementHierarchy.h"
#include "Radiosity/Core/KeptTransfers.h"
#include "Radiosity/Core/LinkRefinement.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

class LightReconstruction {
 public:
  /// `room`: for transfers to the corners of clusters that stay for another light. All by
  /// reference.
  LightReconstruction(const ElementHierarchy& hierarchy, const LinkNetwork& network,
                      const ElementLight& light, const RayScene& rayScene,
                      std::atomic<int64_t>* room);

  /// Evaluates the corners of all cluster elements by the light as it is now, from the root
  /// clusters down: before At, and again for another light of the same elements and links.
  void LightCorners();

  /// A leaf element that meets a point.
  struct Share {
    int32_t leaf;
    float weight;  ///< shares of a point add up to 1
    Vec3f inside;  ///< a place within the leaf: it is evaluated a little toward it
  };

  /// Irradiance at `x`, mean over the leaves that meet there: interpolated over the clusters above
  /// them, plus the links of the triangles and patches that hold `x`, each with its own kernel and,
  /// where it is partly blocked, its own rays. Transfers that `transfers` does not know are added
  /// to it, and their rays to `rays`.
  VectorIrradiance At(const Vec3f& x, const std::vector<Share>& shares,
                      KeptTransfers::Cursor* transfers, int64_t* rays) const;

  /// Transfers made to corners so far.
  int64_t TransfersMade() const;

 private:
  using Corners = std::array<VectorIrradiance, 4>;

  bool IsCluster(int32_t element) const;
  VectorIrradiance FromAbove(int32_t polygon, const Vec3f& x,
                             KeptTransfers::Cursor* transfers) const;
  VectorIrradiance Interpolate(int32_t cluster, const Vec3f& x) const;
  VectorIrradiance AtCorner(int32_t cluster, const Vec3f& x,
                            KeptTransfers::Cursor* transfers) const;
  void AddLinks(int32_t holder, const Element& receiver, const Vec3f& x,
                KeptTransfers::Cursor* transfers, VectorIrradiance* sum,
                int64_t* rays = nullptr) const;
  Vec3f FromSky(const Link& link, const Vec3f& x, const Vec3f& horizon,
                KeptTransfers::Transfer* transfer, int64_t* rays) const;
  VectorIrradiance FromVolumes(int32_t surfaceSide, const Vec3f& x,
                               KeptTransfers::Cursor* transfers) const;

  const ElementHierarchy& hierarchy_;
  const LinkNetwork& network_;
  const ElementLight& light_;
  const RayScene& rayScene_;
  std::vector<int32_t> cornerIndex_;  ///< by element; -1 for those that are no clusters
  std::vector<Corners> corners_;
  std::vector<KeptTransfers> transfers_;  ///< by level: to the corners of its clusters
};

}  // namespace lambert
