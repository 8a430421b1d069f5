// Final gather: at a point, direct light from its sources and one more bounce by rays into the
// solution (thesis 4.5.5 and 6.4.1 name it as the costly way to display).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "Common/Core/Progress.h"
#include "Common/Core/Random.h"
#include "Radiosity/Core/DirectLight.h"
#include "Radiosity/Core/ElementHierarchy.h"
#include "Radiosity/Core/LeafBalance.h"
#include "Radiosity/Core/LeafLookup.h"
#include "Radiosity/Core/LeafSurvey.h"
#include "Radiosity/Core/LinkRefinement.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

/// Sums over rays that left a point, cosine-weighted over its hemisphere: one more bounce of light.
struct BounceSum {
  Spectrum radiosity;  ///< of what they met; emitters apart, W/m2
  float squares = 0;   ///< |radiosity|^2, all bands
  float nearness = 0;  ///< one over the distance of what they met, 1/m
  int rays = 0;

  BounceSum& operator+=(const BounceSum& b) {
    radiosity += b.radiosity, squares += b.squares, nearness += b.nearness, rays += b.rays;
    return *this;
  }
  /// Irradiance, W/m2.
  Spectrum Mean() const { return radiosity / float(std::max(1, rays)); }
  /// Variance of a ray, sum of the bands, (W/m2)^2.
  float Variance() const {
    const Spectrum mean = this->Mean();
    const float square = mean.r * mean.r + mean.g * mean.g + mean.b * mean.b;
    return std::max(0.f, squares - float(rays) * square) / float(std::max(1, rays - 1));
  }
};

/// Rays that leave many points, and the seed of their directions.
struct BounceRays {
  int count = 4;  ///< a point, a power of two
  uint32_t first =
      0;  ///< number of the first point: neighbours in number share their directions out
  uint64_t seed = 1;
};

/// Gathers from the leaves of a solution.
class FinalGather {
 public:
  /// All by reference; points see the light as it is at construction and as GatherAtLeaves leaves
  /// it.
  FinalGather(const ElementHierarchy& hierarchy, const RayScene& rayScene, ElementLight* light);

  /// One bounce at every point: rays that together are spread evenly over hemisphere and points.
  /// What a point receives depends on the point, its number and the seed alone; neighbours in the
  /// list should be neighbours in space. Adds the rays cast to `cast`. Throws Cancelled.
  std::vector<BounceSum> Bounces(const std::vector<GatherPoint>& points, const BounceRays& rays,
                                 int64_t* cast, const ProgressCallback& progress = {}) const;
  const DirectLight& Direct() const { return direct_; }
  const RayScene& Rays() const { return rayScene_; }
  /// The radiosity of a furnace of the brightest emitter and the lightest surface of the scene, a
  /// band at a time, W/m2: no place is brighter. Infinite where the scene has lights that points
  /// send rays to.
  Spectrum Furnace() const;
  /// The largest radiosity of all emitters, leaves and the sky, a band at a time, W/m2: what they
  /// together give to a point is never more. Infinite as that of the furnace.
  Spectrum Brightest() const;

  /// Replaces what the leaves received, at first over links, by the light that is in balance over
  /// rays: what each receives from sources, and over its rays from the others, to the last bounce.
  /// `rays` over the hemisphere of a leaf of mean area, in proportion to area. `share` of what they
  /// have then is new, (0, 1]. Adds the rays cast to `cast`.
  void GatherAtLeaves(int rays, double share, uint64_t seed, int64_t* cast);
  /// Places that something lies close to; none before GatherAtLeaves.
  const std::vector<ClosePlace>& PlacesCloseToOthers() const { return survey_.close; }

 private:
  /// What a ray meets, emitters left out: radiosity from sources, and the part that a leaf sends of
  /// what one of its places receives, times how much more its facet there does.
  struct Seen {
    Spectrum fromSources;  ///< W/m2; of the sky pi times its radiance
    Spectrum part, turned;
    int64_t place = -1;  ///< of received_; -1: no leaf
    float distance = 0;  ///< of what it meets, m; 0: nothing
  };
  Seen Met(const RayStart& from, const Vec3f& direction, Random* random, int followed,
           int64_t* rays) const;
  Spectrum RadiosityOf(const Seen& seen) const {
    return seen.place < 0
               ? seen.fromSources
               : seen.fromSources + seen.part * seen.turned * received_[size_t(seen.place)];
  }
  GatherPoint PlaceOf(int32_t leaf, size_t sample) const;
  LeafRows CastFromLeaves(int rays, uint64_t seed, int64_t* cast);
  void LightLeaves(const LeafRows& rows, uint64_t seed, int64_t* cast);
  void CastFromLeaf(size_t row, uint64_t seed, LeafRows* rows, int64_t* cast);
  float TurnedTo(int32_t leaf, const Vec3f& from, const Vec3f& to) const;
  Spectrum TurnedFromMean(int32_t leaf, const Vec3f& to) const;
  int TellingSample(int32_t leaf, const Vec3f& place, const Vec3f& normal, int64_t* rays) const;
  bool IsUneven(int32_t leaf, const Spectrum* atSamples) const;
  bool IsBright(int32_t leaf, const Spectrum* atSamples) const;
  bool IsTakenAsOne(int32_t leaf, const RayHit& hit, float facing, int followed) const;
  void Receive(int32_t leaf, const Spectrum& irradiance);
  template <class Use>
  void CastBatch(const GatherPoint* points, int count, const BounceRays& rays, int64_t* cast,
                 const Use& use) const;

  const ElementHierarchy& hierarchy_;
  const RayScene& rayScene_;
  ElementLight* light_;
  const DirectLight direct_;
  const LeafLookup leaves_;
  LeafSurvey survey_;  ///< as the leaves were when they first gathered
  /// Irradiance by element and place, W/m2: a part of a leaf that is hidden is dark, and what sees
  /// the leaf sees the other.
  std::vector<Spectrum> received_;
  std::vector<std::array<Spectrum, kSamplesPerElement>> sampleDirect_;  ///< of it, from sources
  std::vector<uint8_t> hasGathered_;                                    ///< by element
  std::vector<uint8_t> isUneven_;  ///< by element: its samples may lie on two sides of a wall
  std::vector<uint8_t> isUnlit_;   ///< by element: no ray of its samples found a source
  std::vector<uint8_t>
      isBright_;             ///< by element: much of what reads it in a narrow gap would be wrong
  float meanRadiosity_ = 0;  ///< of the leaves that have gathered, what they reflect, W/m2
};

}  // namespace lambert
