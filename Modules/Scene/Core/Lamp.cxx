// Lights at a place: a point or a ball of even radiance, into all directions or within a cone.
#include <cmath>

#include "Scene/Core/LightKinds.h"

namespace lambert {

namespace {

class Lamp : public LightSource {
 public:
  explicit Lamp(const Light& light) : light_(light) {}

  bool IsFar() const override { return false; }
  Vec3f Position() const override { return light_.position; }
  Spectrum Intensity(const Vec3f& direction) const override {
    return light_.intensity * light_.ConeFactor(direction);
  }
  Spectrum Strength() const override { return light_.intensity; }
  int Samples() const override { return light_.size > 0 ? kSamplesOfDisc : 1; }
  /// Of a ball that holds `x` nothing is seen.
  LightSample Sample(const Vec3f& x, const Vec2f& u) const override {
    const Vec3f offset = light_.position - x;
    const float distance = Length(offset);
    if (!(distance > light_.size)) return {};
    const Vec3f direction = offset / distance;
    const float factor = light_.ConeFactor(-direction) / (distance * distance);
    if (!(light_.size > 0)) return {direction, distance, light_.intensity * factor};
    float cosine = 1;
    const Vec3f toward = TowardDisc(direction, light_.size / distance, u, &cosine);
    return {toward, distance * cosine, light_.intensity * (factor / cosine)};
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
