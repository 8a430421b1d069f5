// Lights at a place: point and spot.
#include <cmath>

#include "Scene/Core/LightKinds.h"

namespace lambert {

namespace {

class Lamp : public LightSource {
 public:
  explicit Lamp(const Light& light) : light_(light) {}

  bool IsFar() const override { return false; }
  Spectrum Strength() const override { return light_.intensity; }
  LightSample Sample(const Vec3f& x, const Vec2f& /*u*/) const override {
    const Vec3f offset = light_.position - x;
    const float distance = Length(offset);
    if (!(distance > 0)) return {};
    const Vec3f direction = offset / distance;
    const float factor = light_.ConeFactor(-direction) / (distance * distance);
    return {direction, distance, light_.intensity * factor};
  }
  float LargestTransfer(float nearest) const override {
    return 1 / std::max(nearest * nearest, 1e-20f);
  }
  float Variation(float ratio) const override {
    return std::min(1.f, light_.type == LightType::Spot ? ratio : ratio * ratio);
  }
  Spectrum Power(float /*area*/) const override {
    const bool isSpot = light_.type == LightType::Spot;
    const double half = isSpot ? double(light_.outerConeAngle) : kPi;
    return light_.intensity * float(2 * kPi * (1 - std::cos(half)));
  }

 private:
  Light light_;
};

}  // namespace

std::unique_ptr<LightSource> MakeLamp(const Light& light) { return std::make_unique<Lamp>(light); }

}  // namespace lambert
