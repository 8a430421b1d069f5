#include "Radiosity/Core/DirectLight.h"

#include <algorithm>
#include <array>
#include <optional>

#include "Common/Core/PolygonIrradiance.h"
#include "Common/Core/Random.h"

namespace lambert {

namespace {

/// A group of emitters farther away than this many of its radii is taken as one.
constexpr float kSmallBeyond = 12;
/// A polygon nearer than this many of its sizes is sampled by solid angle, else by area.
constexpr float kLargeWithin = 0.35f;
/// The rays to a polygon choose by what they give from so many places together, where its middle is
/// nearer than this many of its sizes; farther away all places on it give alike. Places by area are
/// cheap, and give less evenly: every ray chooses from some.
constexpr int kPlacesByDirection = 2, kPlacesByArea = 16, kLeastPlacesByArea = 8;
constexpr float kAlikeBeyond = 5;
/// A polygon that looks smaller than this is sampled by area, sr.
constexpr float kLeastSolidAngle = 1e-4f;
/// A corner counts as this much above the horizon at least.
constexpr float kLeastCosine = 0.02f;
/// Where all of these lie below the horizon, that many others are tried.
constexpr int kMorePlaces = 8;
/// Light of which more than this part comes from groups scatters without being blocked.
constexpr float kMostGrouped = 0.2f;
/// Fewer rays than this pick a polygon each, down from the root of all emitters.
constexpr int kRaysToOpen = 4;

/// An angle in [0, pi].
struct Cone {
  float cosine, sine;
};

Cone ConeAbout(float cosine) {
  cosine = std::min(1.f, std::max(-1.f, cosine));
  return {cosine, std::sqrt(1 - cosine * cosine)};
}

/// The difference of two angles; 0 where the second is larger.
Cone Narrowed(const Cone& a, const Cone& b) {
  if (a.cosine >= b.cosine) return {1, 0};
  return {a.cosine * b.cosine + a.sine * b.sine, a.sine * b.cosine - a.cosine * b.sine};
}

float Square(float x) { return x * x; }

/// A number in [0, 1], of density linear from `a` at 0 to `b` at 1, of `u` uniform in it.
float LinearlyDense(float u, float a, float b) {
  return u * (a + b) / (a + std::sqrt(a * a + u * (b * b - a * a)));
}

float Fraction(float x) { return x < 1 ? x : x - 1; }

}  // namespace

DirectLight::DirectLight(const Scene& scene, const RayScene& rayScene)
    : rayScene_(rayScene), lights_(scene.lights) {
  for (const EmittingPolygon& polygon : FindEmittingPolygons(scene.mesh)) {
    emitters_.emplace_back(polygon);
  }
  if (!emitters_.empty()) Build(0, int32_t(emitters_.size()));
}

DirectLight::Emitter::Emitter(const EmittingPolygon& polygon_)
    : polygon(polygon_),
      center(polygon_.Center()),
      size(polygon_.LargestSize()),
      power(polygon_.area * polygon_.emittance.Mean()) {
  float area = 0;
  for (size_t c = 2; c < size_t(polygon.count); ++c) {
    area += polygon.FanArea(int(c));
    upTo[c - 2] = area;
  }
  for (size_t c = 2; c < size_t(polygon.count); ++c) upTo[c - 2] /= area;
}

// Uniform in area, of `u` and `v` uniform in [0, 1).
Vec3f DirectLight::Emitter::Place(float u, float v) const {
  size_t triangle = 0;
  while (int(triangle) + 3 < polygon.count && u >= upTo[triangle]) ++triangle;
  const float before = triangle > 0 ? upTo[triangle - 1] : 0, share = upTo[triangle] - before;
  u = share > 0 ? std::min(1.f, (u - before) / share) : 0.5f;
  const auto& corners = polygon.corners;
  return PlaceOnTriangle(corners[0], corners[triangle + 1], corners[triangle + 2],
                         UniformTriangle(u, v));
}

int32_t DirectLight::Build(int32_t begin, int32_t end) {
  // Bounds.
  const int32_t index = int32_t(nodes_.size());
  Node node;
  node.begin = begin;
  node.end = end;
  Box3f box;
  for (int32_t i = begin; i < end; ++i) {
    const EmittingPolygon& polygon = emitters_[size_t(i)].polygon;
    for (int c = 0; c < polygon.count; ++c) box.Include(polygon.corners[size_t(c)]);
    node.power += emitters_[size_t(i)].power;
  }
  Vec3f normals;
  for (int32_t i = begin; i < end; ++i) normals += emitters_[size_t(i)].polygon.normal;
  node.axis = Normalize(normals);
  node.cosCone = node.axis == Vec3f() ? -1.f : 1.f;
  for (int32_t i = begin; i < end; ++i) {
    node.cosCone = std::min(node.cosCone, Dot(node.axis, emitters_[size_t(i)].polygon.normal));
  }
  node.cosCone = std::max(-1.f, node.cosCone);
  node.sinCone = std::sqrt(1 - node.cosCone * node.cosCone);
  node.center = box.Center();
  node.radius = box.Diagonal() / 2;
  nodes_.push_back(node);
  if (end - begin == 1) return index;

  // Halves across the longest extent.
  const Vec3f extent = box.Extent();
  const int axis =
      extent.x >= extent.y ? (extent.x >= extent.z ? 0 : 2) : (extent.y >= extent.z ? 1 : 2);
  const int32_t middle = (begin + end) / 2;
  std::nth_element(emitters_.begin() + begin, emitters_.begin() + middle, emitters_.begin() + end,
                   [axis](const Emitter& a, const Emitter& b) {
                     if (a.center[axis] != b.center[axis]) return a.center[axis] < b.center[axis];
                     return std::lexicographical_compare(&a.center.x, &a.center.x + 3, &b.center.x,
                                                         &b.center.x + 3);
                   });
  Build(begin, middle);
  const int32_t second = Build(middle, end);
  nodes_[size_t(index)].second = second;
  return index;
}

// What a polygon gives is known in closed form; of a group, what it would give at most as far away
// as its middle.
DirectLight::Source DirectLight::Weigh(int32_t index, const GatherPoint& at) const {
  const Node& node = nodes_[size_t(index)];
  Source source{index, {}, 0};
  if (node.second < 0) {
    const EmittingPolygon& polygon = emitters_[size_t(node.begin)].polygon;
    const Vec3d vector = PolygonIrradianceAbove(polygon.corners.data(), polygon.count, at.position,
                                                at.geometricNormal);
    source.exact = polygon.emittance * std::max(0.f, float(Dot(Vec3d(at.normal), vector)));
    source.weight = source.exact.Mean();
    return source;
  }
  // The cosine here, and there.
  const Vec3f offset = node.center - at.position;
  const float distance = Length(offset), nearest = std::max(distance, node.radius);
  const float height = std::min(Dot(offset, at.normal), Dot(offset, at.geometricNormal));
  if (height + node.radius <= 0) return source;
  const float cosine = std::min(1.f, (height + node.radius) / nearest);
  float facing = 1;
  if (distance > node.radius) {
    const Cone toPoint = ConeAbout(-Dot(node.axis, offset) / distance);
    const float sine = node.radius / distance;
    const Cone least = Narrowed(Narrowed(toPoint, {node.cosCone, node.sinCone}),
                                {std::sqrt(1 - sine * sine), sine});
    if (least.cosine <= 0) return source;
    facing = least.cosine;
  }
  source.weight = node.power * cosine * facing / (float(kPi) * nearest * nearest);
  return source;
}

// Down a group to one of its polygons, by what each half may give; `u` in [0,1) is used up and
// stretched again.
DirectLight::Source DirectLight::PickPolygon(const Source& group, const GatherPoint& at, float* u,
                                             float* chance) const {
  Source source = group;
  *chance = 1;
  while (nodes_[size_t(source.node)].second >= 0) {
    const Source first = this->Weigh(source.node + 1, at);
    const Source second = this->Weigh(nodes_[size_t(source.node)].second, at);
    const float total = first.weight + second.weight;
    if (!(total > 0)) return {source.node, {}, 0};
    const float part = first.weight / total;
    if (*u < part) {
      *u = std::min(0.999999f, *u / part);
      *chance *= part;
      source = first;
    } else {
      *u = std::min(0.999999f, (*u - part) / (1 - part));
      *chance *= 1 - part;
      source = second;
    }
  }
  return source;
}

// The parts of the emitters that are dealt with one by one: the brightest that do not look small
// are opened until there are enough.
int DirectLight::Sources(const GatherPoint& at, Source* sources) const {
  int count = 0;
  sources[count++] = this->Weigh(0, at);
  while (count < kMostSources) {
    int opened = -1;
    float most = 0;
    for (int i = 0; i < count; ++i) {
      const Node& node = nodes_[size_t(sources[i].node)];
      if (node.second < 0 || !(sources[i].weight > most)) continue;
      const float distance = Length(node.center - at.position);
      if (distance > kSmallBeyond * node.radius) continue;
      opened = i;
      most = sources[i].weight;
    }
    if (opened < 0) break;
    const int32_t node = sources[opened].node;
    sources[opened] = this->Weigh(node + 1, at);
    sources[count++] = this->Weigh(nodes_[size_t(node)].second, at);
  }
  return count;
}

DirectLight::Fan::Fan(const EmittingPolygon& polygon, const GatherPoint& at) {
  std::array<Vec3d, EmittingPolygon::kMostCorners> toward;
  for (size_t c = 0; c < size_t(polygon.count); ++c) {
    toward[c] = Normalize(Vec3d(polygon.corners[c]) - Vec3d(at.position));
    cornerCosine[c] = std::max(kLeastCosine, Dot(at.normal, Vec3f(toward[c])));
  }
  float given = 0;
  for (size_t c = 2; c < size_t(polygon.count); ++c) {
    triangles[c - 2] = SphericalTriangle(toward[0], toward[c - 1], toward[c]);
    const float angle = float(triangles[c - 2].SolidAngle());
    solidAngle += angle;
    given += angle * (cornerCosine[0] + 2 * cornerCosine[c - 1] + cornerCosine[c]) / 4;
    upTo[c - 2] = given;
  }
}

DirectLight::PolygonView::PolygonView(const Emitter& emitter_, const GatherPoint& at_)
    : emitter(emitter_), at(at_) {
  // From near by, by solid angle.
  const EmittingPolygon& polygon = emitter.polygon;
  const float squared = LengthSquared(emitter.center - at.position);
  areAlike = squared > Square(kAlikeBeyond * emitter.size);
  if (squared > Square((kLargeWithin + 1) * emitter.size) ||
      polygon.DistanceSquared(at.position) > Square(kLargeWithin * emitter.size)) {
    return;
  }
  fan.emplace(polygon, at);
  if (!(fan->solidAngle > kLeastSolidAngle)) fan.reset();
}

// Of density bilinear between the cosines at the corners, in direction; of `uv` uniform in [0, 1).
Vec3f DirectLight::PolygonView::PlaceInDirection(const Vec2f& uv, float* density) const {
  // The triangle.
  const EmittingPolygon& polygon = emitter.polygon;
  size_t t = 0;
  const float chosen = uv.x * fan->upTo[size_t(polygon.count) - 3];
  while (int(t) + 3 < polygon.count && chosen >= fan->upTo[t]) ++t;
  const float before = t > 0 ? fan->upTo[t - 1] : 0, share = fan->upTo[t] - before;
  const float u = share > 0 ? std::min(1.f, (chosen - before) / share) : 0.5f;

  // From its second corner towards the arc from the first to the third.
  const auto& cosine = fan->cornerCosine;
  const float first = cosine[0], second = cosine[t + 1], third = cosine[t + 2];
  const float away = LinearlyDense(uv.y, 2 * second, first + third);
  const float atFirst = second + away * (first - second),
              atThird = second + away * (third - second);
  const float along = LinearlyDense(u, atFirst, atThird);
  *density = atFirst + along * (atThird - atFirst);
  const Vec3d d = fan->triangles[t].Sample(double(along), double(away));
  const Vec3d normal(polygon.normal);
  const double slope = Dot(d, normal);
  const double height = Dot(Vec3d(polygon.corners[0]) - Vec3d(at.position), normal);
  return slope * height > 0 ? Vec3f(Vec3d(at.position) + d * (height / slope)) : polygon.corners[0];
}

// `given` is what such a place gives, but for a factor that is the same for all of the polygon;
// none below the horizon.
Vec3f DirectLight::PolygonView::Place(const Vec2f& uv, float* given) const {
  float density = 1;
  const Vec3f place = fan ? this->PlaceInDirection(uv, &density) : emitter.Place(uv.x, uv.y);
  const Vec3f offset = place - at.position;
  const float cosine = Dot(at.normal, offset), squared = LengthSquared(offset);
  const bool isAbove = cosine > 0 && Dot(at.geometricNormal, offset) > 0;
  if (!isAbove) {
    *given = 0;
  } else {
    *given = fan ? cosine / (std::sqrt(squared) * density) : cosine / Square(squared);
  }
  return place;
}

// One of some places on a polygon, by what each gives: the fewer the rays that share it out, the
// more places each chooses from, or what little they see would count as if all gave alike. `value`
// is what they give in the mean.
bool DirectLight::PolygonView::PickPlace(const Vec2f& uv, int rays, Random* random, Vec3f* target,
                                         float* value) const {
  // Evenly over the ray's share, one after the other across it.
  const int shared = fan ? kPlacesByDirection : kPlacesByArea;
  const int count = areAlike ? 1 : std::max(fan ? 1 : kLeastPlacesByArea, shared / rays);
  const float step = 1 / float(count * rays);
  float sum = 0, u = random->Uniform();
  for (int i = 0; i < count; ++i) {
    const Vec2f next(Fraction(uv.x + float(i) * step), RadicalInverse(uint32_t(i), uv.y));
    float given = 0;
    const Vec3f place = this->Place(next, &given);
    sum += given;
    // Each takes the place of those before it by its part of what they all give.
    const float part = sum > 0 ? given / sum : 0;
    if (u < part) {
      *target = place;
      u /= part;
    } else if (part < 1) {
      u = (u - part) / (1 - part);
    }
  }
  *value = sum / float(count);
  return sum > 0 || this->PickAnother(count, random, target, value);
}

// Where all that were tried lie below the horizon.
bool DirectLight::PolygonView::PickAnother(int tried, Random* random, Vec3f* target,
                                           float* value) const {
  for (int i = 0; i < kMorePlaces; ++i) {
    const float u = random->Uniform();
    *target = this->Place({u, random->Uniform()}, value);
    *value /= float(tried + i + 1);
    if (*value > 0) return true;
  }
  return false;
}

// Rays dealt out by weight, systematically: each brings an equal part of it. `squares` is the sum
// of the squares of what they bring, in such parts.
Spectrum DirectLight::CastRays(const GatherPoint& at, const Source* sources, int count, float total,
                               int rays, uint64_t seed, int* clear, double* squares) const {
  Random random(seed);
  const float start = random.Uniform(), shift = random.Uniform();
  const float part = total / float(rays);
  Spectrum sum;
  float upTo = 0;
  int ray = 0;
  for (int s = 0; s < count; ++s) {
    // This source's share of the rays.
    const Source& source = sources[s];
    upTo += source.weight;
    const int first = ray;
    while (ray < rays && (float(ray) + start) * part < upTo) ++ray;
    if (s + 1 == count && source.weight > 0) ray = rays;
    const int own = ray - first;
    if (own == 0) continue;

    // What of them is clear; on a polygon each place counts by what it gives.
    const auto viewOf = [&](const Source& one) {
      return PolygonView(emitters_[size_t(nodes_[size_t(one.node)].begin)], at);
    };
    const bool isPolygon = nodes_[size_t(source.node)].second < 0;
    std::optional<PolygonView> view;
    if (isPolygon) view.emplace(viewOf(source));
    float all = 0, open = 0, openSquares = 0;
    for (int k = 0; k < own; ++k) {
      float u = (float(k) + random.Uniform()) / float(own), chance = 1, value = 0;
      const Source picked = isPolygon ? source : this->PickPolygon(source, at, &u, &chance);
      if (!(picked.weight > 0)) continue;
      if (!isPolygon) view.emplace(viewOf(picked));
      const float v = RadicalInverse(uint32_t(first + k), shift);
      Vec3f target;
      if (!view->PickPlace({u, v}, isPolygon ? own : 1, &random, &target, &value)) continue;
      const bool isClear = !rayScene_.Occluded({at.position, at.geometricNormal}, target);
      *clear += isClear;
      all += value;
      if (!isClear) continue;
      open += value, openSquares += value * value;
      if (isPolygon) continue;
      sum += picked.exact * (part / (source.weight * chance));
      *squares += Square(picked.exact.Mean() / (source.weight * chance));
    }
    if (isPolygon && all > 0) {
      const float each = float(own) / all;
      sum += source.exact * (part / source.weight * open * each);
      *squares += openSquares * each * each;
    }
  }
  return sum;
}

DirectSample DirectLight::FromEmitters(const GatherPoint& at, int rays, uint64_t seed,
                                       int64_t* cast) const {
  DirectSample sample;
  if (emitters_.empty()) return sample;
  std::array<Source, kMostSources> sources;
  sources[0] = this->Weigh(0, at);
  const int count = rays < kRaysToOpen ? 1 : this->Sources(at, sources.data());
  float total = 0, grouped = 0;
  for (int s = 0; s < count; ++s) {
    const Source& source = sources[size_t(s)];
    total += source.weight;
    if (nodes_[size_t(source.node)].second >= 0) grouped += source.weight;
  }
  if (!(total > 0)) return sample;
  int clear = 0;
  double squares = 0;
  sample.irradiance =
      this->CastRays(at, sources.data(), count, total, rays, HashBits(seed, 1), &clear, &squares);
  sample.squares = float(squares / rays);
  sample.clear = float(clear) / float(rays);
  sample.unoccluded = total;
  sample.isScattered = grouped > kMostGrouped * total;
  *cast += rays;
  return sample;
}

Spectrum DirectLight::FromLights(const GatherPoint& at, int count, uint64_t seed,
                                 int64_t* rays) const {
  const LitPlace place{at.position, at.normal, at.geometricNormal};
  return lights_.Irradiance(place, count, seed, [&](const LightSample& sample) {
    ++*rays;
    const RayStart start{at.position, at.geometricNormal};
    return !rayScene_.Occluded(start, sample.direction, sample.distance);
  });
}

DirectSample DirectLight::Sample(const GatherPoint& at, int count, uint64_t seed,
                                 int64_t* rays) const {
  DirectSample sample = this->FromEmitters(at, count, seed, rays);
  sample.fromEmitters = sample.irradiance;
  sample.irradiance += this->FromLights(at, count, HashBits(seed, 2), rays);
  return sample;
}

}  // namespace lambert
