// Sky of the same radiance in all directions.
#include "Scene/Core/LightKinds.h"

namespace lambert {

namespace {

class Sky : public LightSource {
 public:
  explicit Sky(const Spectrum& radiance) : radiance_(radiance) {}

  Spectrum Strength() const override { return radiance_; }
  int Samples() const override { return 0; }
  bool FillsSky() const override { return true; }
  Spectrum Radiance(const Vec3f& /*direction*/) const override { return radiance_; }
  Spectrum LargestRadiance() const override { return radiance_; }
  float LargestTransfer(float /*nearest*/) const override { return float(kPi); }
  Spectrum Power(float area) const override { return radiance_ * (float(kPi) * area); }

 private:
  Spectrum radiance_;  ///< W/(m2 sr)
};

}  // namespace

std::unique_ptr<LightSource> MakeSky(const Light& light) {
  return std::make_unique<Sky>(light.intensity);
}

}  // namespace lambert
