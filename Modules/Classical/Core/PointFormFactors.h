// Form factors from points to a triangle, visibility included: what a shot delivers where.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "Classical/Core/ExchangeArea.h"
#include "Classical/Core/ShaftBlockers.h"
#include "Classical/Core/UniformMesh.h"

namespace lambert {

/// Form factors of one point to the four parts of a triangle about its places, [0, 1]: of the
/// point's facet, and of a facet with the point's normal.
struct PointFormFactor {
  std::array<float, kPlacesPerElement> facet{}, normal{};
};

class PointFormFactors {
 public:
  /// Keeps references to all. `shooters` shine from the side from which their corners run
  /// counter-clockwise.
  PointFormFactors(const std::vector<ElementReceiver>& receivers,
                   const std::vector<ExchangeTriangle>& shooters, const TriangleMesh& mesh,
                   const RayScene& rayScene);

  /// The form factors of all receivers to one shooter: closed form times visible part, by a ray to
  /// each place. A near shooter is cut in four, twice at most where it may be partly hidden. Adds
  /// the rays to `rays`.
  void ToShooter(int32_t shooter, std::vector<PointFormFactor>* factors, int64_t* rays) const;

 private:
  /// Closed form of a triangle, for the point's facet and its normal.
  struct Open {
    float facet = 0, normal = 0;
  };
  static Open OpenFactor(const ElementReceiver& receiver, const ExchangeTriangle& triangle);
  PointFormFactor Factor(const ElementReceiver& receiver, const ExchangeTriangle& triangle,
                         const ShaftBlockers::Faces& faces, int cuts, int64_t* rays) const;
  bool IsSeen(const ElementReceiver& receiver, const Vec3f& place,
              const ShaftBlockers::Faces& faces, int64_t* rays) const;

  const std::vector<ElementReceiver>& receivers_;
  const std::vector<ExchangeTriangle>& shooters_;
  const RayScene& rayScene_;
  ShaftBlockers shafts_;  ///< groups: the shooters, then the receivers, kGroup a group
};

}  // namespace lambert
