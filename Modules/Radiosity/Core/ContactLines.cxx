#include "Radiosity/Core/ContactLines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace lambert {

namespace {

/// Rays to as many places on the border of a patch. They run this many times the length that rays
/// skip above it, or this part of its longest side where that is more.
constexpr int kSpokes = 16;
constexpr float kAboveSkip = 4, kAboveLength = 1e-3f;
/// What leans flatter than this (cosine) lies on the patch and does not stand on it.
constexpr float kSteep = 0.8f;
/// A line explains at least this part of the variance of light.
constexpr double kExplained = 0.4;

/// Places on a closed border, `count` of them, as far from each other along it.
std::vector<Vec3f> PlacesAlong(const std::vector<Vec3f>& corners, int count) {
  const auto next = [&](size_t corner) { return corners[(corner + 1) % corners.size()]; };
  float around = 0;
  for (size_t c = 0; c < corners.size(); ++c) around += Length(next(c) - corners[c]);
  std::vector<Vec3f> places;
  float begin = 0;
  for (size_t c = 0; c < corners.size(); ++c) {
    const float side = Length(next(c) - corners[c]);
    for (;;) {
      const float at = around * (float(places.size()) + 0.5f) / float(count) - begin;
      if (at >= side || places.size() == size_t(count)) break;
      places.push_back(corners[c] + (next(c) - corners[c]) * (at / side));
    }
    begin += side;
  }
  return places;
}

/// Of the plane of what is met at `place`, `height` above the patch: down along it.
std::optional<ContactLine> FootOf(const Vec3f& front, const Vec3f& place, const Vec3f& normal,
                                  float height) {
  const float lean = Dot(front, normal);
  const Vec3f across = front - normal * lean;
  const float steep = Length(across);
  if (std::abs(lean) > kSteep || !(steep > 0)) return {};
  const Vec3f unit = across / steep;
  return ContactLine{place - normal * height + unit * (height * lean / steep), unit};
}

}  // namespace

std::vector<ContactLine> FindContactLines(const RayScene& scene, const std::vector<Vec3f>& corners,
                                          const Vec3f& normal, int64_t* rays) {
  Vec3f middle;
  float longest = 0;
  for (size_t c = 0; c < corners.size(); ++c) {
    middle += corners[c] / float(corners.size());
    longest = std::max(longest, Length(corners[(c + 1) % corners.size()] - corners[c]));
  }
  const float height = std::max(kAboveSkip * scene.Epsilon(), kAboveLength * longest);
  const Vec3f above = middle + normal * height;

  std::vector<ContactLine> lines;
  for (const Vec3f& place : PlacesAlong(corners, kSpokes)) {
    const float distance = Length(place - middle);
    if (!(distance > 0)) continue;
    const Vec3f direction = (place - middle) / distance;
    const RayHit hit = scene.Closest(above, direction);
    ++*rays;
    if (hit.face < 0 || hit.distance >= distance) continue;
    const auto foot = FootOf(hit.front, above + direction * hit.distance, normal, height);
    if (foot) lines.push_back(*foot);
  }
  return lines;
}

const ContactLine* TellingLine(const std::vector<ContactLine>& lines,
                               const std::vector<KnownLight>& places) {
  Spectrum mean;
  for (const KnownLight& place : places) mean += place.irradiance / float(places.size());
  double variance = 0;
  for (const KnownLight& place : places) variance += SquaredNorm(place.irradiance - mean);

  // How far the means of both sides lie apart.
  const ContactLine* best = nullptr;
  double most = kExplained * variance;
  for (const ContactLine& line : lines) {
    std::array<Spectrum, 2> sum;
    std::array<int, 2> count{};
    for (const KnownLight& place : places) {
      const size_t side = Dot(line.across, place.position - line.position) > 0;
      sum[side] += place.irradiance;
      ++count[side];
    }
    if (count[0] == 0 || count[1] == 0) continue;
    double between = 0;
    for (size_t side = 0; side < 2; ++side) {
      between += count[side] * SquaredNorm(sum[side] / float(count[side]) - mean);
    }
    if (between > most) {
      most = between;
      best = &line;
    }
  }
  return best;
}

}  // namespace lambert
