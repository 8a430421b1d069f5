#include "Radiosity/Core/IrradianceFilter.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "Common/Core/Parallel.h"
#include "Radiosity/Core/NearestPoints.h"

namespace lambert {

namespace {

/// Normals whose cosine is larger look the same way; a neighbour lies as flat as this sine says.
constexpr float kAlike = 0.9f, kFlat = 0.25f;
/// Slopes are held back by this part of the samples' own spread: along a line of them nothing is
/// known of the slope across.
constexpr double kSlopeRidge = 0.05;
/// What is thought of the scatter before it is known: that of so many rays, each as far off as the
/// mean or the usual light is large.
constexpr float kPriorRays = 2;

/// A neighbour's place in the tangent plane, in units of the reach, and its weight.
struct Neighbour {
  float u, v, weight;
  const IrradianceSample* sample;
};

/// The weights by which a plane fitted to the neighbours (1, u, v) takes its value at the middle.
struct PlaneFit {
  float constant = 1, alongU = 0, alongV = 0;

  PlaneFit(const Neighbour* neighbours, int count) {
    // Moments.
    double m00 = 0, m01 = 0, m02 = 0, m11 = 0, m12 = 0, m22 = 0;
    for (int i = 0; i < count; ++i) {
      const Neighbour& n = neighbours[i];
      m00 += n.weight, m01 += n.weight * n.u, m02 += n.weight * n.v;
      m11 += n.weight * n.u * n.u, m12 += n.weight * n.u * n.v, m22 += n.weight * n.v * n.v;
    }
    const double ridge = kSlopeRidge * (m11 + m22);
    m11 += ridge, m22 += ridge;
    // First column of the inverse.
    const double c00 = m11 * m22 - m12 * m12, c01 = m02 * m12 - m01 * m22,
                 c02 = m01 * m12 - m02 * m11;
    const double determinant = m00 * c00 + m01 * c01 + m02 * c02;
    if (!(determinant > 0)) {
      constant = m00 > 0 ? float(1 / m00) : 0;
      return;
    }
    constant = float(c00 / determinant);
    alongU = float(c01 / determinant), alongV = float(c02 / determinant);
  }
  float Weight(const Neighbour& n) const {
    return n.weight * (constant + alongU * n.u + alongV * n.v);
  }
};

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
  std::array<Neighbour, SampleNeighbours::kMost + 1> telling;
  int count = 0;
  telling[size_t(count++)] = {0, 0, own.rays, &own};
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
    telling[size_t(count++)] = {Dot(offset, s) / own.reach, Dot(offset, t) / own.reach,
                                other.rays * (1 - part) * (1 - part), &other};
  }

  // The plane through them. How far rays scatter all neighbours tell, within reach or not: if each
  // asked itself alone, those that happened to find light would cast more rays than those that did
  // not, and light would be lost.
  const PlaneFit fit(telling.data(), count);
  FilteredIrradiance light;
  Spectrum least = own.irradiance, most = own.irradiance;
  float squareOfWeights = 0;
  for (int i = 0; i < count; ++i) {
    const Neighbour& n = telling[size_t(i)];
    const float weight = fit.Weight(n);
    light.irradiance += n.sample->irradiance * weight;
    squareOfWeights += weight * weight / n.sample->rays;
    for (int band = 0; band < 3; ++band) {
      least[band] = std::min(least[band], n.sample->irradiance[band]);
      most[band] = std::max(most[band], n.sample->irradiance[band]);
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
