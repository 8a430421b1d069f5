// Environment: radiance by direction from an image. What of it is bright and small, a sun say, is
// sampled; the rest is left to rays that meet nothing.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "Common/Core/Error.h"
#include "Scene/Core/Compass.h"
#include "Scene/Core/EnvironmentImage.h"
#include "Scene/Core/LightKinds.h"
#include "Scene/Core/SceneLimits.h"

namespace lambert {

namespace {

/// What is brighter than so many times the mean of what is left to rays is sampled instead.
constexpr float kBright = 4;
/// Rounds in which that mean is found, from the mean of all on.
constexpr int kRounds = 8;
/// Rays to the bright parts.
constexpr int kSamples = 16;

class Environment : public LightSource {
 public:
  explicit Environment(const Light& light)
      : image_(light.image),
        scale_(light.intensity),
        rotation_(double(light.rotation)),
        compass_(Normalize(-light.direction)) {
    if (!image_) throw Error("The light \"" + light.name + "\" has no environment image.");
    RequireSolvable(light);
    FindLimit();
    FindBrightParts();
    for (int i = 0; i < image_->Count(); ++i) {
      for (int band = 0; band < 3; ++band) {
        largest_[band] = std::max(largest_[band], Even(i)[band] * scale_[band]);
      }
    }
  }

  void RequireSolvable(const Light& light) const {
    for (int i = 0; i < image_->Count(); ++i) {
      if (IsSolvable(scale_ * image_->Texel(i))) continue;
      throw Error("The light \"" + light.name +
                  "\" is brighter than 1e30 somewhere; scale it down.");
    }
  }

  Spectrum Strength() const override { return scale_ * image_->Mean(); }
  bool IsOneColor() const override { return false; }
  int Samples() const override { return bright_.empty() ? 0 : kSamples; }
  LightSample Sample(const Vec3f& /*x*/, const Vec2f& u) const override;
  bool FillsSky() const override { return true; }
  Spectrum Radiance(const Vec3f& direction) const override {
    const double azimuth =
        std::atan2(double(Dot(direction, compass_.east)), double(Dot(direction, compass_.north)));
    return scale_ *
           Even(image_->IndexOf({azimuth - rotation_, double(Dot(direction, compass_.up))}));
  }
  Spectrum LargestRadiance() const override { return largest_; }
  /// Where it has bright parts, all may come from one direction.
  float LargestTransfer(float /*nearest*/) const override {
    return bright_.empty() ? HemisphereTransfer(largest_, Strength()) : 4 * float(kPi);
  }
  Spectrum Power(float area) const override { return Strength() * (float(kPi) * area); }

 private:
  /// Part of a texel's radiance that is left to rays.
  float EvenPart(int texel) const {
    const float mean = image_->Texel(texel).Mean();
    return mean > limit_ ? limit_ / mean : 1;
  }
  Spectrum Even(int texel) const { return image_->Texel(texel) * EvenPart(texel); }
  void FindLimit();
  void FindBrightParts();

  std::shared_ptr<const EnvironmentImage> image_;
  Spectrum scale_;
  double rotation_;  ///< radians, clockwise as seen from above
  Compass compass_;
  float limit_ = 0;  ///< mean of the bands up to which a texel is left to rays
  Spectrum largest_;
  std::vector<int> bright_;         ///< texels over the limit
  std::vector<double> brightUpTo_;  ///< sum of their chances
};

/// The mean of what is left to rays and the limit of it depend on each other.
void Environment::FindLimit() {
  limit_ = kBright * image_->Mean().Mean();
  for (int round = 0; round < kRounds; ++round) {
    double sum = 0;
    for (int i = 0; i < image_->Count(); ++i) sum += double(Even(i).Mean()) * image_->SolidAngle(i);
    limit_ = kBright * float(sum / (4 * kPi));
  }
}

/// Each is sampled by the power that it has beyond the limit.
void Environment::FindBrightParts() {
  double total = 0;
  for (int i = 0; i < image_->Count(); ++i) {
    const float beyond = image_->Texel(i).Mean() * (1 - EvenPart(i));
    if (!(beyond > 0)) continue;
    total += double(beyond) * image_->SolidAngle(i);
    bright_.push_back(i);
    brightUpTo_.push_back(total);
  }
  for (double& upTo : brightUpTo_) upTo /= total;
}

LightSample Environment::Sample(const Vec3f& /*x*/, const Vec2f& u) const {
  if (bright_.empty()) return {};

  // A texel by its chance; what is left of `u` chooses the place on it.
  const auto next = std::upper_bound(brightUpTo_.begin(), brightUpTo_.end(), double(u.x));
  const size_t k = std::min(bright_.size() - 1, size_t(next - brightUpTo_.begin()));
  const double before = k > 0 ? brightUpTo_[k - 1] : 0, chance = brightUpTo_[k] - before;
  const Vec2f within(std::min(0.999999f, float((double(u.x) - before) / chance)), u.y);
  const ImageDirection place = image_->PlaceOn(bright_[k], within);

  // What it has beyond the limit, over its solid angle and its chance.
  const Spectrum beyond = image_->Texel(bright_[k]) * (1 - EvenPart(bright_[k]));
  return {
      compass_.Direction(place.azimuth + rotation_, std::asin(std::clamp(place.sine, -1.0, 1.0))),
      std::numeric_limits<float>::infinity(),
      scale_ * beyond * float(image_->SolidAngle(bright_[k]) / chance)};
}

}  // namespace

std::unique_ptr<LightSource> MakeEnvironment(const Light& light) {
  return std::make_unique<Environment>(light);
}

}  // namespace lambert
