#include "Scene/Core/LightSource.h"

#include <algorithm>
#include <cstring>
#include <iterator>

#include "Common/Core/Error.h"
#include "Scene/Core/LightKinds.h"

namespace lambert {

namespace {

/// Makers, in the order of LightType: point and spot, directional, skies.
constexpr std::unique_ptr<LightSource> (*kMakers[])(const Light&) = {
    MakeLamp, MakeLamp, MakeSun, MakeSky, MakeGradientSky, MakeEnvironment};

}  // namespace

bool IsLightType(double number) { return number >= 0 && number < double(std::size(kMakers)); }

std::unique_ptr<LightSource> MakeLightSource(const Light& light) {
  if (IsLightType(double(light.type))) return kMakers[size_t(light.type)](light);
  throw Error("The light \"" + light.name + "\" is of no known type.");
}

std::vector<Light> SelectLights(const std::vector<Light>& lights, bool areFar) {
  std::vector<Light> selected;
  std::copy_if(lights.begin(), lights.end(), std::back_inserter(selected),
               [areFar](const Light& light) { return light.IsPlaced() != areFar; });
  return selected;
}

uint64_t SeedOfPlace(const Vec3f& position) {
  uint64_t seed = 0;
  for (int axis = 0; axis < 3; ++axis) {
    uint32_t bits = 0;
    std::memcpy(&bits, &position[axis], sizeof bits);
    seed = HashBits(seed, bits);
  }
  return seed;
}

LightSources::LightSources(const std::vector<Light>& lights) {
  for (const Light& light : lights) {
    if (!light.IsBlack()) sources_.push_back(MakeLightSource(light));
  }
}

bool LightSources::FillSky() const {
  return std::any_of(begin(), end(), [](const auto& source) { return source->FillsSky(); });
}

Spectrum LightSources::Radiance(const Vec3f& direction) const {
  Spectrum sum;
  for (const auto& source : sources_) sum += source->Radiance(direction);
  return sum;
}

Spectrum LightSources::LargestRadiance() const {
  Spectrum sum;
  for (const auto& source : sources_) sum += source->LargestRadiance();
  return sum;
}

bool LightSources::HaveSamples() const {
  return std::any_of(begin(), end(), [](const auto& source) { return source->Samples() > 0; });
}

}  // namespace lambert
