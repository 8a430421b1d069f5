// Irradiance from few rays at many points: what neighbours found tells of a point too, as far as
// nothing is near (ward1988, kontkanen2004).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "Common/Core/Spectrum.h"
#include "Common/Core/Vector.h"

namespace lambert {

class RayScene;

/// A place where rays told the light that arrives.
struct IrradianceSample {
  Vec3f position;
  Vec3f normal;         ///< unit; irradiance is for it
  Spectrum irradiance;  ///< mean over the rays, W/m2
  float variance = 0;   ///< of one ray, sum of the bands, (W/m2)^2
  float rays = 0;       ///< (0, inf)
  float reach = 0;      ///< it tells nothing of places farther than this, m
};

struct FilteredIrradiance {
  Spectrum irradiance;  ///< W/m2
  float variance = 0;   ///< of it, sum of the bands, (W/m2)^2
  float ofRay = 0;      ///< that of one ray, as all neighbours tell
};

/// Of each sample those that lie nearest and look the same way, itself left out, nearest first.
class SampleNeighbours {
 public:
  static constexpr int kMost = 32;

  /// Of all samples from `first` on, among all. None lies across a sheet of `scene`, where that is
  /// given: rays between samples of different heights tell, which `rays` counts.
  SampleNeighbours(const std::vector<IrradianceSample>& samples, int32_t first,
                   const RayScene* scene = nullptr, int64_t* rays = nullptr);

  const int32_t* begin(int32_t sample) const { return &lists_[size_t(sample - first_) * kMost]; }
  const int32_t* end(int32_t sample) const {
    return this->begin(sample) + counts_[size_t(sample - first_)];
  }

 private:
  int32_t first_;
  std::unique_ptr<int32_t[]> lists_;  ///< kMost places a sample
  std::vector<uint8_t> counts_;
};

/// Irradiance at a sample: a plane fitted to what it and its neighbours found, as far as they lie
/// within its reach and it within theirs, each weighed by its rays and its nearness. Where hardly
/// any does, as in corners, the nearest tell too, as far as they and it agree. Where few tell, rays
/// are thought to scatter by `usual` (W/m2, norm over bands), what light usually is, even if they
/// all found alike.
FilteredIrradiance FilterIrradiance(const std::vector<IrradianceSample>& samples,
                                    const SampleNeighbours& neighbours, int32_t sample,
                                    float usual = 0);

}  // namespace lambert
