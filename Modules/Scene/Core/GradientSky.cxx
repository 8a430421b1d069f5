// Sky whose radiance goes from the horizon to the zenith in proportion to the sine of the
// elevation, over an even ground.
#include "Scene/Core/LightKinds.h"

namespace lambert {

namespace {

class GradientSky : public LightSource {
 public:
  explicit GradientSky(const Light& light)
      : zenith_(light.intensity),
        horizon_(light.horizon),
        ground_(light.ground),
        up_(Normalize(-light.direction)) {}

  /// The mean: over the upper hemisphere that of the sine is a half.
  Spectrum Strength() const override { return (zenith_ + horizon_) * 0.25f + ground_ * 0.5f; }
  bool IsOneColor() const override { return false; }
  int Samples() const override { return 0; }
  bool FillsSky() const override { return true; }
  Spectrum Radiance(const Vec3f& direction) const override {
    const float sine = Dot(direction, up_);
    return sine < 0 ? ground_ : horizon_ + (zenith_ - horizon_) * std::min(1.f, sine);
  }
  Spectrum LargestRadiance() const override {
    Spectrum most;
    for (const Spectrum& s : {zenith_, horizon_, ground_}) {
      for (int band = 0; band < 3; ++band) most[band] = std::max(most[band], s[band]);
    }
    return most;
  }
  float LargestTransfer(float /*nearest*/) const override {
    return HemisphereTransfer(LargestRadiance(), Strength());
  }
  Spectrum Power(float area) const override { return Strength() * (float(kPi) * area); }

 private:
  Spectrum zenith_, horizon_, ground_;  ///< W/(m2 sr)
  Vec3f up_;
};

}  // namespace

std::unique_ptr<LightSource> MakeGradientSky(const Light& light) {
  return std::make_unique<GradientSky>(light);
}

}  // namespace lambert
