#include "Radiosity/Core/IrradianceFilter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nanoflann.hpp>

#include "Common/Core/Parallel.h"

namespace lambert {

namespace {

/// Points in a leaf of the search tree.
constexpr size_t kLeafSize = 10;
/// Normals whose cosine is larger look the same way; a neighbour lies as flat as this sine says.
constexpr float kAlike = 0.9f, kFlat = 0.25f;
/// Slopes are held back by this part of the samples' own spread: along a line of them nothing is
/// known of the slope across.
constexpr double kSlopeRidge = 0.05;
/// What is thought of the scatter before it is known: that of so many rays, each as far off as the
/// mean or the usual light is large.
constexpr float kPriorRays = 2;

struct Positions {
  const std::vector<IrradianceSample>& samples;
  size_t kdtree_get_point_count() const { return samples.size(); }
  float kdtree_get_pt(size_t i, size_t axis) const { return samples[i].position[int(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Positions>,
                                                 Positions, 3, uint32_t>;

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
      lists_((samples.size() - size_t(first)) * kMost),
      counts_(samples.size() - size_t(first), 0) {
  const Positions positions{samples};
  const Tree tree(3, positions, {kLeafSize});
  ParallelForEach(int64_t(counts_.size()), 64, [&](int64_t i) {
    const int32_t sample = first + int32_t(i);
    const IrradianceSample& own = samples[size_t(sample)];
    std::array<uint32_t, kMost + 1> found;
    std::array<float, kMost + 1> squares;
    const size_t size = tree.knnSearch(&own.position.x, found.size(), found.data(), squares.data());
    for (size_t k = 0; k < size && counts_[size_t(i)] < kMost; ++k) {
      const IrradianceSample& other = samples[found[k]];
      if (int32_t(found[k]) == sample || Dot(own.normal, other.normal) < kAlike) continue;
      const float height = Dot(other.position - own.position, own.normal);
      if (height * height > kFlat * kFlat * squares[k]) continue;
      lists_[size_t(i) * kMost + size_t(counts_[size_t(i)]++)] = int32_t(found[k]);
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
