// Irradiance by path tracing: the truth that every method is charted against. It reads the
// contract's mesh alone: its own rays, its own offsets, nothing of trees, sides or visibility code.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "Common/Core/Progress.h"
#include "Scene/Core/Scene.h"

namespace lambert {

struct PathTracedIrradianceOptions {
  /// Paths a point, [2, inf); rounded up to a multiple of the 16 replicates that the standard error
  /// comes from (of as many replicates as samples where there are fewer than 16).
  int samples = 256;
  /// Bounces, [0, inf). Russian roulette ends paths before, without bias; this bound is against
  /// endless ones only: at the largest reflectance 0.98 the light lost behind 1024 bounces is 1e-9
  /// of the whole. 0 is direct light alone.
  int maximumDepth = 1024;
  uint64_t seed = 1;
};

/// A point that light is asked for: position, the normal that irradiance is for, and the geometric
/// normal whose hemisphere can see light (they are the same for a free probe).
struct ReceiverPoint {
  Vec3f position;
  Vec3f normal;
  Vec3f geometricNormal;
};

struct IrradianceEstimate {
  Spectrum irradiance;     ///< W/m2
  Spectrum standardError;  ///< W/m2, of the mean, per band
};

/// A run of the paths of one receiver: those numbered [begin, end) of its point set.
struct PathRange {
  int begin = 0, end = 0;
};

/// Path tracer over a scene. Both sides of a face reflect and block.
class PathTracedIrradiance {
 public:
  /// Keeps a reference to `scene`. Throws Error where Embree cannot be started.
  explicit PathTracedIrradiance(const Scene& scene);
  ~PathTracedIrradiance();

  /// Estimates at every point; estimate i depends on the options, the scene and i alone, for any
  /// number of threads. A point without a normal receives nothing. Throws Error for fewer than 2
  /// samples, Cancelled.
  std::vector<IrradianceEstimate> Estimate(const std::vector<ReceiverPoint>& points,
                                           const PathTracedIrradianceOptions& options = {},
                                           const ProgressCallback& progress = {}) const;

  /// Sum over `paths` of the light that each brings to `point`, W/m2: divided by their number it is
  /// the irradiance. The paths of one `seed` share one point set, so that sums over adjoining
  /// ranges add up to the sum over the whole; receivers need seeds of their own. Adds the rays cast
  /// to `rays`. Safe to call from several threads; faster within FlushDenormals.
  std::array<double, 3> SumOfPaths(const ReceiverPoint& point, uint64_t seed, PathRange paths,
                                   int64_t* rays) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace lambert
