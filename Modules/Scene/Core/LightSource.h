// Lights without geometry, as methods see them. A new kind is one class, and its maker in the table
// of LightSource.cxx; Light::IsPlaced says whether it stands at a place.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "Common/Core/Random.h"
#include "Scene/Core/Light.h"

namespace lambert {

/// What a light gives along one direction where nothing is in the way.
struct LightSample {
  Vec3f direction;      ///< unit, from the place that is lit toward the light
  float distance = 0;   ///< m, at which a ray toward it ends; infinite for what is far
  Spectrum irradiance;  ///< of a facet that faces `direction`, W/m2, the light whole: it is the
                        ///< mean over the samples
};

/// A light gives by samples, each a direct ray's, or to rays that meet nothing, or both: no part of
/// it by both ways.
class LightSource {
 public:
  virtual ~LightSource() = default;

  /// True for what is seen in the same directions from everywhere.
  virtual bool IsFar() const { return true; }
  /// Of what is not: where it stands, m, and what it sends in a unit direction, W/sr.
  virtual Vec3f Position() const { return {}; }
  virtual Spectrum Intensity(const Vec3f& /*direction*/) const { return {}; }
  /// What Transfer is relative to: the intensity of a row of the table, or the mean radiance.
  virtual Spectrum Strength() const = 0;
  /// False where the colour depends on the direction: then each band is an element of its own.
  virtual bool IsOneColor() const { return true; }

  /// Rays that show well what of it is in sight; 1 where all samples are alike, 0 where there are
  /// none.
  virtual int Samples() const { return 1; }
  /// The sample at `u` in [0,1)^2 for a place `x`; black where it gives nothing. (0, 0) is the
  /// middle.
  virtual LightSample Sample(const Vec3f& /*x*/, const Vec2f& /*u*/) const { return {}; }
  /// True where rays that meet nothing find light; then Radiance in a unit direction and the
  /// largest in any, a band at a time, W/(m2 sr).
  virtual bool FillsSky() const { return false; }
  virtual Spectrum Radiance(const Vec3f& /*direction*/) const { return {}; }
  virtual Spectrum LargestRadiance() const { return {}; }

  /// The most that the length of the irradiance vector may be, per unit of strength, no nearer to
  /// it than `nearest` (m).
  virtual float LargestTransfer(float nearest) const = 0;
  /// The part of it that may vary over a receiver of `ratio` of the distance, [0, 1].
  virtual float Variation(float /*ratio*/) const { return 0; }
  /// Power, W; of what is far, that through bounds with half a surface of `area` m2: a guess.
  virtual Spectrum Power(float area) const = 0;
};

/// Whether a number of a table of lights is that of a type.
bool IsLightType(double number);

/// Throws Error for an environment without its image.
std::unique_ptr<LightSource> MakeLightSource(const Light& light);

/// Of `lights` those that are far (LightSource::IsFar), or the others: none is made to know it.
std::vector<Light> SelectLights(const std::vector<Light>& lights, bool areFar);

/// A place that lights shine on: irradiance is for `normal`, from directions in the hemispheres of
/// both unit normals.
struct LitPlace {
  Vec3f position, normal, geometric;
};

/// A seed of the place alone.
uint64_t SeedOfPlace(const Vec3f& position);

/// All lights of a scene that are not black.
class LightSources {
 public:
  explicit LightSources(const std::vector<Light>& lights);

  bool IsEmpty() const { return sources_.empty(); }
  auto begin() const { return sources_.begin(); }
  auto end() const { return sources_.end(); }

  /// Irradiance (W/m2) from the samples of all lights, for each at most `rays` of them, [1, inf),
  /// by `seed`. Calls isOpen(sample), a ray, for each that lies above the horizon.
  template <class IsOpen>
  Spectrum Irradiance(const LitPlace& at, int rays, uint64_t seed, const IsOpen& isOpen) const {
    Spectrum sum;
    for (size_t i = 0; i < sources_.size(); ++i) {
      const LightSource& source = *sources_[i];
      const int count = std::min(rays, source.Samples());
      Random random(HashBits(seed, i));
      const Vec2f shift =
          count > 1 || source.Samples() > 1 ? Vec2f(random.Uniform(), random.Uniform()) : Vec2f();
      for (int k = 0; k < count; ++k) {
        const Vec2f u((float(k) + shift.x) / float(count), RadicalInverse(uint32_t(k), shift.y));
        const LightSample sample = source.Sample(at.position, u);
        const float cosine = Dot(at.normal, sample.direction);
        if (sample.irradiance.IsBlack() || cosine <= 0) continue;
        if (Dot(at.geometric, sample.direction) <= 0 || !isOpen(sample)) continue;
        sum += sample.irradiance * (cosine / float(count));
      }
    }
    return sum;
  }

  /// True where rays that meet nothing find light; what they find in a unit direction, and the most
  /// that they may, a band at a time, W/(m2 sr).
  bool FillSky() const;
  Spectrum Radiance(const Vec3f& direction) const;
  Spectrum LargestRadiance() const;
  /// True where there are lights with samples.
  bool HaveSamples() const;

 private:
  std::vector<std::unique_ptr<const LightSource>> sources_;
};

}  // namespace lambert
