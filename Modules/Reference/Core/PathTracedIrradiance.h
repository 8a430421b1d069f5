// Irradiance by path tracing: the truth that every method is charted against. It reads the contract's mesh alone: its
// own rays, its own offsets, nothing of trees, sides or visibility code.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "Common/Core/Progress.h"
#include "Scene/Core/Scene.h"

namespace lambert {

struct PathTracedIrradianceOptions {
  int samples = 256;      ///< paths a point, [1, inf)
  int maximumDepth = 64;  ///< bounces; Russian roulette ends paths before, without bias
  uint64_t seed = 1;
};

/// A point that light is asked for: position, the normal that irradiance is for, and the geometric normal whose
/// hemisphere can see light (they are the same for a free probe).
struct ReceiverPoint {
  Vec3f position;
  Vec3f normal;
  Vec3f geometricNormal;
};

struct IrradianceEstimate {
  Spectrum irradiance;     ///< W/m2
  Spectrum standardError;  ///< W/m2, of the mean, per band
};

/// Path tracer over a scene. Both sides of a face reflect and block.
class PathTracedIrradiance {
 public:
  /// Keeps a reference to `scene`.
  explicit PathTracedIrradiance(const Scene& scene);
  ~PathTracedIrradiance();

  /// Estimates at every point; estimate i depends on the options, the scene and i alone, for any number of threads.
  /// Throws Cancelled.
  std::vector<IrradianceEstimate> Estimate(const std::vector<ReceiverPoint>& points,
                                           const PathTracedIrradianceOptions& options = {},
                                           const ProgressCallback& progress = {}) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace lambert
