#include "Radiosity/Core/IrradianceFilter.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "Common/Core/Parallel.h"
#include "Radiosity/Core/NearestPoints.h"
#include "Radiosity/Core/PlaneFit.h"

namespace lambert {

namespace {

/// Normals whose cosine is larger look the same way; a neighbour lies as flat as this sine says.
constexpr float kAlike = 0.9f, kFlat = 0.25f;
/// What is thought of the scatter before it is known: that of so many rays, each as far off as the
/// mean or the usual light is large.
constexpr float kPriorRays = 2;

}  // namespace

SampleNeighbours::SampleNeighbours(const std::vector<IrradianceSample>& samples, int32_t first)
    : first_(first),
      lists_(new int32_t[(samples.size() - size_t(first)) * kMost]),
      counts_(samples.size() - size_t(first), 0) {
  std::vector<Vec3f> positions(samples.size());
  for (size_t i = 0; i < samples.size(); ++i) positions[i] = samples[i].position;
  const NearestPoints nearest(positions);
  ParallelForEach(int64_t(samples.size()), 64, [&](int64_t place) {
    const int32_t sample = nearest.InOrder()[size_t(place)];
    if (sample < first) return;
    const IrradianceSample& own = samples[size_t(sample)];
    std::array<int32_t, kMost + 1> found;
    std::array<float, kMost + 1> squares;
    const int size = nearest.Find(own.position, kMost + 1, found.data(), squares.data());
    int32_t* const list = &lists_[size_t(sample - first) * kMost];
    uint8_t& count = counts_[size_t(sample - first)];
    for (size_t k = 0; k < size_t(size) && count < kMost; ++k) {
      const IrradianceSample& other = samples[size_t(found[k])];
      if (found[k] == sample || Dot(own.normal, other.normal) < kAlike) continue;
      const float height = Dot(other.position - own.position, own.normal);
      if (height * height > kFlat * kFlat * squares[k]) continue;
      list[count++] = found[k];
    }
  });
}

FilteredIrradiance FilterIrradiance(const std::vector<IrradianceSample>& samples,
                                    const SampleNeighbours& neighbours, int32_t sample,
                                    float usual) {
  // Who tells of this place.
  const IrradianceSample& own = samples[size_t(sample)];
  std::array<PlanePoint, SampleNeighbours::kMost + 1> places;
  std::array<const IrradianceSample*, SampleNeighbours::kMost + 1> telling;
  int count = 0;
  telling[0] = &own;
  places[size_t(count++)] = {0, 0, own.rays};
  Vec3f s, t;
  CoordinateSystem(own.normal, &s, &t);
  float variance = own.variance * own.rays, rays = own.rays;
  for (const int32_t* i = neighbours.begin(sample); i != neighbours.end(sample); ++i) {
    const IrradianceSample& other = samples[size_t(*i)];
    variance += other.variance * other.rays, rays += other.rays;
    const Vec3f offset = other.position - own.position;
    const float reach = std::min(own.reach, other.reach);
    const float part = LengthSquared(offset) / (reach * reach);
    if (!(part < 1)) continue;
    telling[size_t(count)] = &other;
    places[size_t(count++)] = {Dot(offset, s) / own.reach, Dot(offset, t) / own.reach,
                               other.rays * (1 - part) * (1 - part)};
  }

  // The plane through them. How far rays scatter all neighbours tell, within reach or not: if each
  // asked itself alone, those that happened to find light would cast more rays than those that did
  // not, and light would be lost.
  const PlaneFit fit(places.data(), count);
  FilteredIrradiance light;
  Spectrum least = own.irradiance, most = own.irradiance;
  float squareOfWeights = 0;
  for (int i = 0; i < count; ++i) {
    const IrradianceSample& sampleOfIt = *telling[size_t(i)];
    const float weight = fit.WeightAtMiddle(places[size_t(i)]);
    light.irradiance += sampleOfIt.irradiance * weight;
    squareOfWeights += weight * weight / sampleOfIt.rays;
    for (int band = 0; band < 3; ++band) {
      least[band] = std::min(least[band], sampleOfIt.irradiance[band]);
      most[band] = std::max(most[band], sampleOfIt.irradiance[band]);
    }
  }
  for (int band = 0; band < 3; ++band) {
    light.irradiance[band] = std::min(most[band], std::max(least[band], light.irradiance[band]));
  }
  const Spectrum& e = light.irradiance;
  const float prior = std::max(usual * usual, e.r * e.r + e.g * e.g + e.b * e.b);
  light.variance = (variance + kPriorRays * prior) / (rays + kPriorRays) * squareOfWeights;
  return light;
}

}  // namespace lambert
