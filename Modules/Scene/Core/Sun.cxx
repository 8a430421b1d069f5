// Directional light.
#include <limits>

#include "Scene/Core/LightKinds.h"

namespace lambert {

namespace {

class Sun : public LightSource {
 public:
  explicit Sun(const Light& light)
      : irradiance_(light.intensity), toward_(Normalize(-light.direction)) {}

  Spectrum Strength() const override { return irradiance_; }
  LightSample Sample(const Vec3f& /*x*/, const Vec2f& /*u*/) const override {
    return {toward_, std::numeric_limits<float>::infinity(), irradiance_};
  }
  float LargestTransfer(float /*nearest*/) const override { return 1; }
  /// Half the surface of a box turns half its area to the light.
  Spectrum Power(float area) const override { return irradiance_ * (area / 2); }

 private:
  Spectrum irradiance_;  ///< of a facet that faces it, W/m2
  Vec3f toward_;
};

}  // namespace

std::unique_ptr<LightSource> MakeSun(const Light& light) { return std::make_unique<Sun>(light); }

}  // namespace lambert
