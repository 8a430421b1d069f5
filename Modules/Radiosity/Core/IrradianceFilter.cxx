#include "Radiosity/Core/IrradianceFilter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "Common/Core/Parallel.h"
#include "Radiosity/Core/NearestPoints.h"
#include "Radiosity/Core/PlaneFit.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {

namespace {

/// Normals whose cosine is larger look the same way; a neighbour lies as flat as this sine says.
constexpr float kAlike = 0.9f, kFlat = 0.25f;
/// A sheet may lie between places that are higher than each other by so many times the length that
/// rays skip; it is looked for so many times that length above them.
constexpr float kStep = 1, kAbove = 2;
/// What is thought of the scatter before it is known: that of so many rays, each as far off as the
/// mean or the usual light is large.
constexpr float kPriorRays = 2;
/// Where no more than so many lie within reach, so many of the nearest are asked. They count up to
/// this part of the distance of the farthest.
constexpr int kNearest = 8;
constexpr float kExtent = 1.1f;

}  // namespace

/// Whether one of two places has the other above it, and the other has not: on a surface that bends
/// each is as high above the other, in a plane neither is.
static bool IsStep(const IrradianceSample& a, const IrradianceSample& b, float least) {
  return std::abs(Dot(b.position - a.position, a.normal + b.normal)) > 2 * least;
}

SampleNeighbours::SampleNeighbours(const std::vector<IrradianceSample>& samples, int32_t first,
                                   const RayScene* scene, int64_t* rays)
    : first_(first),
      lists_(new int32_t[(samples.size() - size_t(first)) * kMost]),
      counts_(samples.size() - size_t(first), 0) {
  std::vector<Vec3f> positions(samples.size());
  for (size_t i = 0; i < samples.size(); ++i) positions[i] = samples[i].position;
  const NearestPoints nearest(positions);
  const float epsilon = scene ? scene->Epsilon() : 0;
  const auto isHidden = [&](const IrradianceSample& a, const IrradianceSample& b) {
    return scene->Occluded(a.position + a.normal * (kAbove * epsilon),
                           b.position + b.normal * (kAbove * epsilon));
  };
  std::vector<uint8_t> cast(samples.size() - size_t(first), 0);
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
      if (scene && IsStep(own, other, kStep * epsilon)) {
        ++cast[size_t(sample - first)];
        if (isHidden(own, other)) continue;
      }
      list[count++] = found[k];
    }
  });
  if (rays) *rays += std::accumulate(cast.begin(), cast.end(), int64_t(0));
}

namespace {

/// Those that tell of a place, itself first, in its plane.
struct Telling {
  std::array<PlanePoint, SampleNeighbours::kMost + 1> places;
  std::array<const IrradianceSample*, SampleNeighbours::kMost + 1> samples;
  int count = 1;
  Vec3f s, t;

  explicit Telling(const IrradianceSample& own) {
    places[0] = {0, 0, own.rays};
    samples[0] = &own;
    CoordinateSystem(own.normal, &s, &t);
  }
  /// If it lies within `reach`, the less the farther; in units of length `unit`.
  void Add(const IrradianceSample& other, float reach, float unit) {
    const Vec3f offset = other.position - samples[0]->position;
    const float part = LengthSquared(offset) / (reach * reach);
    if (!(part < 1)) return;
    samples[size_t(count)] = &other;
    places[size_t(count++)] = {Dot(offset, s) / unit, Dot(offset, t) / unit,
                               other.rays * (1 - part) * (1 - part)};
  }
};

/// A plane's value at the place, and the sum of the squares of the parts that rays have in it.
struct ValueOfPlane {
  Spectrum irradiance;
  float squareOfWeights = 0;
};

ValueOfPlane PlaneThrough(const Telling& telling) {
  const PlaneFit fit(telling.places.data(), telling.count);
  ValueOfPlane value;
  Spectrum least = telling.samples[0]->irradiance, most = least;
  for (int i = 0; i < telling.count; ++i) {
    const IrradianceSample& sample = *telling.samples[size_t(i)];
    const float weight = fit.WeightAtMiddle(telling.places[size_t(i)]);
    value.irradiance += sample.irradiance * weight;
    value.squareOfWeights += weight * weight / sample.rays;
    for (int band = 0; band < 3; ++band) {
      least[band] = std::min(least[band], sample.irradiance[band]);
      most[band] = std::max(most[band], sample.irradiance[band]);
    }
  }
  for (int band = 0; band < 3; ++band) {
    value.irradiance[band] = std::min(most[band], std::max(least[band], value.irradiance[band]));
  }
  return value;
}

/// By how much the first of them does not belong to the others, [0, 1], when a ray has the given
/// variance.
float FirstStandsApart(const Telling& telling, double variance) {
  const PlaneFit fit(telling.places.data(), telling.count);
  std::array<float, SampleNeighbours::kMost + 1> values, rays;
  std::array<double, SampleNeighbours::kMost + 1> squares{};
  for (int band = 0; band < 3; ++band) {
    for (int i = 0; i < telling.count; ++i) {
      values[size_t(i)] = telling.samples[size_t(i)]->irradiance[band];
      rays[size_t(i)] = telling.samples[size_t(i)]->rays;
    }
    AddSquaresOff(fit, telling.places.data(), values.data(), telling.count, squares.data());
  }
  return StandsApart(telling.places.data(), squares.data(), rays.data(), telling.count, variance);
}

}  // namespace

FilteredIrradiance FilterIrradiance(const std::vector<IrradianceSample>& samples,
                                    const SampleNeighbours& neighbours, int32_t sample,
                                    float usual) {
  // Who tells of this place: those within reach, and the nearest. How far rays scatter all
  // neighbours tell: if each asked itself alone, those that happened to find light would cast more
  // rays than those that did not, and light would be lost.
  const IrradianceSample& own = samples[size_t(sample)];
  const int32_t* const begin = neighbours.begin(sample);
  const int32_t* const end = neighbours.end(sample);
  const int32_t* const endOfNearest = std::min(end, begin + kNearest);
  Telling within(own), nearest(own);
  const float extent =
      begin == end ? 1
                   : kExtent * Length(samples[size_t(endOfNearest[-1])].position - own.position);
  float variance = own.variance * own.rays, rays = own.rays;
  for (const int32_t* i = begin; i != end; ++i) {
    const IrradianceSample& other = samples[size_t(*i)];
    variance += other.variance * other.rays, rays += other.rays;
    within.Add(other, std::min(own.reach, other.reach), own.reach);
    if (i < endOfNearest) nearest.Add(other, extent, extent);
  }
  const auto varianceOfRay = [&](const Spectrum& e) {
    const float prior = std::max(usual * usual, e.r * e.r + e.g * e.g + e.b * e.b);
    return (variance + kPriorRays * prior) / (rays + kPriorRays);
  };

  // What they found. In corners hardly any lies within reach: there the nearest tell as far as
  // they agree, by what is known of the scatter, not what is thought of it.
  ValueOfPlane value = PlaneThrough(within);
  if (within.count <= kNearest && nearest.count > kNearest) {
    const float apart = FirstStandsApart(nearest, double(variance / rays));
    const ValueOfPlane shared = PlaneThrough(nearest);
    value.irradiance = value.irradiance * apart + shared.irradiance * (1 - apart);
    value.squareOfWeights = value.squareOfWeights * apart + shared.squareOfWeights * (1 - apart);
  }
  const float ofRay = varianceOfRay(value.irradiance);
  return {value.irradiance, ofRay * value.squareOfWeights, ofRay};
}

}  // namespace lambert
