#include "Radiosity/Core/VisibilityFilter.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "Radiosity/Core/PlaneFit.h"

namespace lambert {

namespace {

/// Neighbours that are asked, and how many have to tell: fewer may all be mistaken.
constexpr int kMost = 16, kLeast = 8;
/// What is thought of the variance of a ray before it is known counts as that of one ray.
constexpr double kPriorVariance = 0.25;

/// The variance of a ray, as some samples together tell.
double VarianceOfRay(const VisibilitySample* const* samples, int count) {
  double rays = 0, mean = 0, squares = 0;
  for (int i = 0; i < count; ++i) {
    const VisibilitySample& one = *samples[i];
    rays += double(one.rays);
    mean += double(one.rays) * double(one.visible.Mean());
    squares += double(one.rays) * double(one.squares);
  }
  return (std::max(0., squares - mean * mean / rays) + kPriorVariance) / (rays + 1);
}

/// A sample and its neighbours in its plane, in units of the distance of the farthest.
struct Neighbourhood {
  std::array<PlanePoint, kMost + 1> places;
  std::array<const VisibilitySample*, kMost + 1> samples;
  int count = 0;

  Neighbourhood(const std::vector<VisibilitySample>& all,
                const std::vector<IrradianceSample>& where, const SampleNeighbours& neighbours,
                int32_t sample) {
    const IrradianceSample& own = where[size_t(sample)];
    const int32_t* const begin = neighbours.begin(sample);
    const int32_t* const end = std::min(neighbours.end(sample), begin + kMost);
    if (!(all[size_t(sample)].rays > 0) || begin == end) return;
    const float square = LengthSquared(where[size_t(end[-1])].position - own.position);
    if (!(square > 0)) return;
    Vec3f s, t;
    CoordinateSystem(own.normal, &s, &t);
    const auto add = [&](size_t index) {
      const VisibilitySample& one = all[index];
      if (!(one.rays > 0)) return;
      const Vec3f offset = (where[index].position - own.position) / std::sqrt(square);
      const float near = std::max(0.f, 1 - LengthSquared(offset));
      samples[size_t(count)] = &one;
      places[size_t(count++)] = {Dot(offset, s), Dot(offset, t), one.rays * near * near};
    };
    add(size_t(sample));
    for (const int32_t* other = begin; other != end; ++other) add(size_t(*other));
  }
  bool Tells() const { return count > kLeast; }
  /// The variance of a ray, as all of them together tell.
  double Variance() const { return VarianceOfRay(samples.data(), count); }
};

}  // namespace

float StandsApart(const std::vector<VisibilitySample>& samples,
                  const std::vector<IrradianceSample>& places, const SampleNeighbours& neighbours,
                  int32_t sample) {
  const Neighbourhood near(samples, places, neighbours, sample);
  if (!near.Tells()) return 1;
  std::array<float, kMost + 1> values, rays;
  for (int i = 0; i < near.count; ++i) {
    values[size_t(i)] = near.samples[size_t(i)]->visible.Mean();
    rays[size_t(i)] = near.samples[size_t(i)]->rays;
  }
  const PlaneFit fit(near.places.data(), near.count);
  std::array<double, kMost + 1> squares{};
  AddSquaresOff(fit, near.places.data(), values.data(), near.count, squares.data());
  return StandsApart(near.places.data(), squares.data(), rays.data(), near.count, near.Variance());
}

FilteredVisibility FilterVisibility(const std::vector<VisibilitySample>& samples,
                                    const std::vector<IrradianceSample>& places,
                                    const SampleNeighbours& neighbours, int32_t sample) {
  // On its own it scatters as its rays do, or as those around it where that is more: a few that
  // agree may all be lucky.
  const VisibilitySample* const own = &samples[size_t(sample)];
  if (!(own->rays > 0)) return {own->visible, 0};
  Neighbourhood near(samples, places, neighbours, sample);
  const double ofNear = near.Tells() ? near.Variance() : 0;
  const double ofRay = std::max(VarianceOfRay(&own, 1), ofNear);
  const FilteredVisibility alone{own->visible, float(ofRay / double(own->rays))};
  if (own->apart >= 1 || !near.Tells()) return alone;

  // The plane through what does not stand apart.
  double weights = 0;
  for (int i = 0; i < near.count; ++i) {
    near.places[size_t(i)].weight *= 1 - near.samples[size_t(i)]->apart;
    weights += double(near.places[size_t(i)].weight);
  }
  if (!(weights > 0)) return alone;
  const PlaneFit fit(near.places.data(), near.count);
  FilteredVisibility fitted;
  for (int i = 0; i < near.count; ++i) {
    const VisibilitySample& one = *near.samples[size_t(i)];
    const float weight = fit.WeightAtMiddle(near.places[size_t(i)]);
    fitted.visible += one.visible * weight;
    fitted.variance += float(ofNear) * weight * weight / one.rays;
  }
  for (int band = 0; band < 3; ++band) fitted.visible[band] = std::max(0.f, fitted.visible[band]);
  return {fitted.visible + (alone.visible - fitted.visible) * own->apart,
          fitted.variance + (alone.variance - fitted.variance) * own->apart};
}

}  // namespace lambert
