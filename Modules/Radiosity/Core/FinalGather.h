// Final gather: at a point, direct light from its sources and one more bounce by rays into the
// solution (thesis 4.5.5 and 6.4.1 name it as the costly way to display).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "Common/Core/Progress.h"
#include "Common/Core/Random.h"
#include "Radiosity/Core/DirectLight.h"
#include "Radiosity/Core/ElementHierarchy.h"
#include "Radiosity/Core/LinkRefinement.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

struct FinalGatherOptions {
  int rays = 64;  ///< over the hemisphere of a point, rounded to a square, [1, inf)
  DirectLightOptions direct;
  uint64_t seed = 1;
};

/// What a point gathered.
struct GatheredLight {
  Spectrum irradiance;  ///< W/m2
  Spectrum reflected;   ///< part of it that leaves reflected; the rest came from sources, W/m2
  float variance = 0;   ///< of it, sum of the bands, (W/m2)^2; from two halves of the rays
};

/// Gathers from the leaves of a solution.
class FinalGather {
 public:
  /// Radiosity of what a ray meets, emitters left out, W/m2; of the sky pi times its radiance.
  struct Radiosity {
    Spectrum fromSources, fromLeaves;
  };

  /// All by reference; points see the light as it is at construction and as GatherAtLeaves leaves
  /// it.
  FinalGather(const ElementHierarchy& hierarchy, const RayScene& rayScene, ElementLight* light);

  /// Irradiance at every point, W/m2. What point i receives depends on the options, the point and i
  /// alone; neighbours in the list should be neighbours in space, so that their rays are. Adds the
  /// rays cast to `rays`. Throws Cancelled.
  std::vector<GatheredLight> At(const std::vector<GatherPoint>& points,
                                const FinalGatherOptions& options, int64_t* rays,
                                const ProgressCallback& progress = {}) const;

  /// Replaces what the leaves received over links by what they gather, one bounce; `rays` over the
  /// hemisphere of a leaf of mean area, in proportion to area. Adds the rays cast to `cast`.
  void GatherAtLeaves(int rays, uint64_t seed, int64_t* cast);

 private:
  Radiosity Met(const Vec3f& from, const Vec3f& direction, Random* random, int bounces,
                int64_t* rays) const;
  int32_t LeafAt(int64_t face, Side side, const Vec3f& position) const;
  GatheredLight GatherAtLeaf(int32_t leaf, int rays, uint64_t seed, int64_t* cast) const;
  Spectrum BalancingFactor(const std::vector<int32_t>& leaves,
                           const std::vector<GatheredLight>& gathered) const;
  void Receive(int32_t leaf, const Spectrum& irradiance);
  void GatherBatch(const GatherPoint* points, int64_t first, int count,
                   const FinalGatherOptions& options, GatheredLight* light, int64_t* rays) const;

  /// Where a polygon was cut: its first child lies where the plane is not negative.
  struct Cut {
    Vec3f normal;
    float offset = 0;
  };
  void FindCut(int32_t index);

  const ElementHierarchy& hierarchy_;
  const RayScene& rayScene_;
  ElementLight* light_;
  const DirectLight direct_;
  Spectrum sky_;  ///< radiosity of a facet that sees nothing but the sky, W/m2
  std::array<std::vector<int32_t>, 2>
      elementOfFace_;                        ///< by side: the element that holds the face,
                                             ///< a leaf or a triangle; -1 where none does
  std::vector<Spectrum> polygonIrradiance_;  ///< by element, of triangles and patches
  std::vector<Cut> cuts_;  ///< by element, of triangles and patches that have children
};

}  // namespace lambert
