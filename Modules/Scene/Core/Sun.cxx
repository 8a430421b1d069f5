// Directional light: a disc of even radiance, or a point, infinitely far.
#include <cmath>
#include <limits>

#include "Scene/Core/LightKinds.h"

namespace lambert {

namespace {

class Sun : public LightSource {
 public:
  explicit Sun(const Light& light)
      : irradiance_(light.intensity),
        toward_(Normalize(-light.direction)),
        sine_(std::sin(light.size / 2)) {}

  Spectrum Strength() const override { return irradiance_; }
  int Samples() const override { return sine_ > 0 ? kSamplesOfDisc : 1; }
  LightSample Sample(const Vec3f& /*x*/, const Vec2f& u) const override {
    constexpr float kFar = std::numeric_limits<float>::infinity();
    if (!(sine_ > 0)) return {toward_, kFar, irradiance_};
    float cosine = 1;
    const Vec3f direction = TowardDisc(toward_, sine_, u, &cosine);
    return {direction, kFar, irradiance_ / cosine};
  }
  float LargestTransfer(float /*nearest*/) const override { return 1; }
  /// Half the surface of a box turns half its area to the light.
  Spectrum Power(float area) const override { return irradiance_ * (area / 2); }

 private:
  Spectrum irradiance_;  ///< of a facet that faces it, W/m2
  Vec3f toward_;         ///< unit, to its middle
  float sine_;           ///< of half the angular diameter
};

}  // namespace

std::unique_ptr<LightSource> MakeSun(const Light& light) { return std::make_unique<Sun>(light); }

}  // namespace lambert
