// Light at points: straight from the sources, and by rays into the element cache.
#pragma once

#include <cstdint>
#include <vector>

#include "Classical/Core/ElementCache.h"
#include "Classical/Core/SourceLight.h"
#include "Common/Core/Progress.h"

namespace lambert {

struct CacheGatherOptions {
  int rays = 64;         ///< a point, over the hemisphere, [1, inf)
  int emitterRays = 16;  ///< a point, to emitting faces, [1, inf)
  double nearby = 0;     ///< m; hits nearer than this are not read but followed further
  uint64_t seed = 1;
};

/// `position` drawn toward the middle of its face or element by 8 times the length that rays skip,
/// but no more than a tenth of the way: from there, rays leak past no surface that meets this one
/// at its edge.
Vec3f DrawnInward(const Vec3f& position, const Vec3f& middle, const RayScene& rays);

/// Irradiance (W/m2) at every point. What point i receives depends on the scene, the options and i
/// alone. Adds the rays cast to `cast`. Throws Cancelled.
std::vector<Spectrum> GatherFromCache(const Scene& scene, const RayScene& rays,
                                      const SourceLight& sources, const ElementCache& cache,
                                      const std::vector<LightReceiver>& points,
                                      const CacheGatherOptions& options, int64_t* cast,
                                      const ProgressCallback& progress = {});

}  // namespace lambert
