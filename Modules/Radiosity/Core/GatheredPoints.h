// Light at points, gathered with as many rays as each needs: few at first, what neighbours found
// shared, more where it still scatters.
#pragma once

#include <cstdint>
#include <vector>

#include "Common/Core/Progress.h"
#include "Radiosity/Core/FinalGather.h"
#include "Radiosity/Core/IrradianceFilter.h"
#include "Radiosity/Core/VisibilityFilter.h"

namespace lambert {

struct GatheredPointsOptions {
  int firstRays = 4;      ///< over the hemisphere of every point, a power of two
  int mostRays = 1024;    ///< over that of any, a power of two
  int directRays = 16;    ///< to the emitting faces, [1, inf), where many groups of them give light
  int penumbraRays = 24;  ///< more of them where the neighbours of a point are partly in shadow
  double noise = 0.02;    ///< relative RMS error that the scatter of rays may leave, (0, 1]
  uint64_t seed = 1;
};

class GatheredPoints {
 public:
  struct Point {
    uint64_t key = 0;  ///< by which it is known when it is asked again
    GatherPoint at;
    bool isProbe = false;  ///< only tells how good others are: few rays are enough, now and later
  };
  struct Light {
    Spectrum irradiance;  ///< W/m2
    /// Of it, sum of the bands, (W/m2)^2, as differences between points are held against it: with a
    /// third of what rays to emitters leave.
    float variance = 0;
    bool isNew = false;  ///< not asked before
  };

  /// By reference.
  GatheredPoints(const FinalGather& gather, const GatheredPointsOptions& options)
      : gather_(gather),
        options_(options),
        fewestMore_(options.firstRays),
        brightest_(gather.Brightest()) {}

  /// Light at every point; those asked before are as they were.
  /// `areas` of the points count as theirs from now on. Adds the rays cast to `rays`. Throws
  /// Cancelled.
  std::vector<Light> At(const std::vector<Point>& points, int64_t* rays,
                        const ProgressCallback& progress = {});
  /// More rays for the points asked so far, without probes: to emitters until they have what
  /// `options` ask for, over the hemisphere until they scatter by no more. The options go for
  /// points asked later too, but for the seed. Adds the rays cast to `rays`. Throws Cancelled.
  void Improve(const GatheredPointsOptions& options, int64_t* rays,
               const ProgressCallback& progress = {});

 private:
  struct Record {
    uint64_t key;
    GatherPoint at;
    bool isProbe = false;
    DirectSample direct;
    /// Rays to emitters behind `direct`: without the first ones, which it has where no more were
    /// cast. Those tell neighbours of their shadows, and what decides must not count.
    int directRays = 0;
    BounceSum bounces;
    FilteredIrradiance bounced;
    Spectrum shared;           ///< direct light, all neighbours heard, W/m2
    float sharedVariance = 0;  ///< of it, sum of the bands, (W/m2)^2
  };

  int32_t FindOrAdd(const Point& point);
  void GatherNew(int32_t first, int64_t* rays, const ProgressCallback& progress);
  bool IsInPenumbra(int32_t record, const SampleNeighbours& neighbours) const;
  double ScatterOfShadow(int32_t record, const SampleNeighbours& neighbours, double mean) const;
  void CastMoreToEmitters(const std::vector<int>& more, int32_t first, int64_t* rays);
  /// Which points look around once more.
  enum class Which { All, WithoutProbes };
  void LookIntoPenumbrae(int32_t first, Which which, const SampleNeighbours& neighbours,
                         int64_t* rays);
  void ShareDirect(int32_t first, const SampleNeighbours& neighbours);
  void Share(int32_t first, const SampleNeighbours& neighbours);
  void GatherWhereItScatters(int32_t first, const SampleNeighbours& neighbours, int64_t* rays,
                             const ProgressCallback& progress);
  /// By record.
  struct Scatter {
    std::vector<double> noise, growth;
  };
  Scatter ScatterOfNew(int32_t first, const SampleNeighbours& neighbours) const;
  IrradianceSample SampleOf(const Record& record) const;
  void SampleAll();

  const FinalGather& gather_;
  GatheredPointsOptions options_;
  const int fewestMore_;  ///< rays over the hemisphere that a point may get beyond the first ones
  const Spectrum brightest_;
  std::vector<Record> records_;               ///< in the order in which they were asked for
  std::vector<IrradianceSample> samples_;     ///< of the records, while light is gathered
  std::vector<VisibilitySample> visibility_;  ///< by record, for neighbours to come
  /// The records by their keys: each from the place on that its key hashes to, in the first that
  /// was free; -1 for a free one. A power of two of them, at most half of them taken.
  std::vector<int32_t> recordOfKey_;
  int64_t deliveredCount_ = 0;  ///< records that are no probes
  uint64_t improved_ = 0;       ///< so many times
};

/// By how much a squared error (W/m2)^2 at a place with irradiance `light` (W/m2, norm over bands)
/// counts, where `mean` and `meanSquare` are those of all places: in the relative RMS error, in
/// which what blazes counts as a multiple of the mean, or in the bounded error, whichever is more.
double ErrorWeight(double light, double mean, double meanSquare);
/// Irradiance beyond this many times the mean counts as that much: a lamp's socket must not take
/// all rays and triangles.
constexpr double kBlazing = 6;

}  // namespace lambert
