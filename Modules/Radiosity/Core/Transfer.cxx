#include "Radiosity/Core/Transfer.h"

#include <array>

#include "Common/Core/PolygonIrradiance.h"
#include "Common/Core/Random.h"
#include "Common/Core/SphericalTriangle.h"

namespace lambert {

namespace {

constexpr int kSkyDirections = 64;
/// A cluster that shows less of its area than this to a direction is not made brighter to keep its
/// power.
constexpr float kLeastFacing = 0.05f;

/// Directions over the hemisphere about +z with equal solid angle (spherical Fibonacci lattice).
const std::array<Vec3f, kSkyDirections>& SkyDirections() {
  static const std::array<Vec3f, kSkyDirections> directions = [] {
    std::array<Vec3f, kSkyDirections> d;
    const double golden = kPi * (3 - std::sqrt(5.0));
    for (int i = 0; i < kSkyDirections; ++i) {
      const double z = (i + 0.5) / kSkyDirections, r = std::sqrt(1 - z * z);
      d[size_t(i)] =
          Vec3f(float(r * std::cos(golden * i)), float(r * std::sin(golden * i)), float(z));
    }
    return d;
  }();
  return directions;
}

bool HasHorizon(const Vec3f& horizon) { return horizon != Vec3f(); }

/// A cluster as small discs at its samples; a volume sends its light into all directions alike.
Vec3f ClusterTransfer(const Element& source, const Vec3f& x, const Vec3f& horizon) {
  const float share = source.area / kSamplesPerElement;
  Vec3f sum;
  for (const SurfaceSample& sample : source.samples) {
    const Vec3f offset = sample.position - x;
    const float squared = LengthSquared(offset);
    if (!(squared > 0) || (HasHorizon(horizon) && Dot(offset, horizon) <= 0)) continue;
    const Vec3f direction = offset / std::sqrt(squared);
    const float cosine = source.IsVolume() ? 0.25f : -Dot(direction, sample.normal);
    if (cosine <= 0) continue;
    sum += direction * (cosine * share / (float(kPi) * squared + cosine * share));
  }
  const float length = Length(sum);
  return length > 1 ? sum / length : sum;
}

/// Light per unit of the strength that a light's element has.
float PerUnit(const Spectrum& light, const Spectrum& strength) {
  const int band = strength.r >= strength.MaxBand() ? 0 : strength.g >= strength.MaxBand() ? 1 : 2;
  return strength[band] > 0 ? light[band] / strength[band] : 0;
}

Vec3f LightTransfer(const LightSource& light, const Element& source, const Vec3f& x,
                    const Vec3f& horizon) {
  const LightSample middle = light.Sample(x, {});
  if (HasHorizon(horizon) && Dot(middle.direction, horizon) <= 0) return {};
  return middle.direction * PerUnit(middle.irradiance, source.emittance);
}

/// A source looks large from `x` where it is nearer than this many of its radii.
constexpr float kLargeWithin = 2;

/// Sample `k` of a polygon that looks large from `x`: uniform in solid angle, so that its near part
/// gets its share.
Vec3f SolidAngleTarget(const ElementHierarchy& hierarchy, const Element& source, int k,
                       const Vec3f& x) {
  Vec3f corners[kMaximumPolygonCorners];
  const int count = hierarchy.PolygonCorners(source, corners);
  Vec3d toward[kMaximumPolygonCorners];
  for (int i = 0; i < count; ++i) toward[i] = Normalize(Vec3d(corners[i]) - Vec3d(x));

  // A triangle of the fan, then a direction within it.
  double angles[kMaximumPolygonCorners] = {}, total = 0;
  for (int i = 2; i < count; ++i) {
    total += angles[i] = SolidAngle(toward[0], toward[i - 1], toward[i]);
  }
  double left = (k + 0.5) / kSamplesPerElement * total;
  int triangle = 2;
  while (triangle + 1 < count && left >= angles[triangle]) left -= angles[triangle++];
  const double share = angles[triangle] > 0 ? std::min(1.0, left / angles[triangle]) : 0;
  if (!(angles[triangle] > 1e-9)) return source.samples[size_t(k)].position;
  const Vec3d direction = SphericalTriangle(toward[0], toward[triangle - 1], toward[triangle])
                              .Sample(share, double(RadicalInverse(uint32_t(k), 0.25f)));

  // To where it meets the polygon's plane.
  const Vec3d normal(source.axis);
  const double slope = Dot(direction, normal);
  const double height = Dot(Vec3d(corners[0]) - Vec3d(x), normal);
  if (!(slope * height > 0)) return source.samples[size_t(k)].position;
  return Vec3f(Vec3d(x) + direction * (height / slope));
}

/// Where a ray from `x` toward sample `k` of a surface ends, and how much it counts; false where
/// that sample cannot be seen from there.
bool RayTarget(const ElementHierarchy& hierarchy, const Element& source, int k, const Vec3f& x,
               const Vec3f& horizon, Vec3f* target, float* weight) {
  *weight = 1;
  const bool isLarge =
      source.IsPolygon() && LengthSquared(source.frame.center - x) <
                                kLargeWithin * kLargeWithin * source.radius * source.radius;
  const SurfaceSample& sample = source.samples[size_t(k)];
  *target = isLarge ? SolidAngleTarget(hierarchy, source, k, x) : sample.position;
  const Vec3f offset = *target - x;
  if (!(Dot(offset, sample.normal) < 0)) return false;
  if (!HasHorizon(horizon)) return true;
  const float height = Dot(offset, horizon);
  if (isLarge) *weight = height / Length(offset);
  return height > 0;
}

/// Sample `k` of `count` of a light, spread evenly.
LightSample SampleOf(const LightSource& light, int k, int count, const Vec3f& x) {
  return light.Sample(x, {(float(k) + 0.5f) / float(count), RadicalInverse(uint32_t(k), 0.25f)});
}

/// Visible part of a light that is small.
float VisibleFraction(const LightSource& light, const RayScene& rayScene, const Vec3f& x,
                      const Vec3f& horizon, int64_t* rays) {
  int cast = 0, clear = 0;
  const int samples = std::min(kSamplesPerElement, light.Samples());
  for (int k = 0; k < samples; ++k) {
    const LightSample sample = SampleOf(light, k, samples, x);
    if (HasHorizon(horizon) && !(Dot(sample.direction, horizon) > 0)) continue;
    ++cast;
    clear += rayScene.Occluded(x, sample.direction, sample.distance) ? 0 : 1;
  }
  *rays += cast;
  return cast > 0 ? float(clear) / float(cast) : 1;
}

}  // namespace

Vec3f UnoccludedTransfer(const ElementHierarchy& hierarchy, const Element& source, const Vec3f& x,
                         const Vec3f& horizon) {
  if (source.kind == ElementKind::Light) {
    return LightTransfer(hierarchy.LightOf(source), source, x, horizon);
  }
  if (!source.IsPolygon()) return ClusterTransfer(source, x, horizon);
  Vec3f corners[kMaximumPolygonCorners];
  const int count = hierarchy.PolygonCorners(source, corners);
  return Vec3f(HasHorizon(horizon) ? PolygonIrradianceAbove(corners, count, x, horizon)
                                   : PolygonIrradiance(corners, count, x));
}

float VisibleFraction(const ElementHierarchy& hierarchy, const RayScene& rayScene,
                      const Element& source, const Vec3f& x, const Vec3f& horizon, int64_t* rays) {
  if (source.kind == ElementKind::Light) {
    return VisibleFraction(hierarchy.LightOf(source), rayScene, x, horizon, rays);
  }
  float cast = 0, clear = 0;
  for (int k = 0; k < kSamplesPerElement; ++k) {
    Vec3f target;
    float weight;
    if (!RayTarget(hierarchy, source, k, x, horizon, &target, &weight)) continue;
    ++*rays;
    cast += weight;
    if (!rayScene.Occluded(x, target)) clear += weight;
  }
  return cast > 0 ? clear / cast : 1;
}

Vec3f SkyTransfer(const LightSource& sky, const RayScene& rayScene, const Element& source,
                  const Vec3f& x, const Vec3f& horizon, float* visible, int64_t* rays) {
  // What fills the sky.
  Vec3f u, v, sum;
  CoordinateSystem(horizon, &u, &v);
  float open = 0, all = 0;
  for (const Vec3f& d : SkyDirections()) {
    const Vec3f direction = u * d.x + v * d.y + horizon * d.z;
    const float radiance = PerUnit(sky.Radiance(direction), source.emittance);
    all += d.z * radiance;
    if (rayScene.OccludedDirection(x, direction)) continue;
    open += d.z * radiance;
    sum += direction * radiance;
  }
  *rays += kSkyDirections;
  constexpr float kPerDirection = float(2 * kPi / kSkyDirections);
  sum *= kPerDirection;

  // Its small bright parts.
  for (int k = 0; k < sky.Samples(); ++k) {
    const LightSample sample = SampleOf(sky, k, sky.Samples(), x);
    const float cosine = Dot(sample.direction, horizon);
    if (cosine <= 0) continue;
    const float irradiance = PerUnit(sample.irradiance, source.emittance) / float(sky.Samples());
    ++*rays;
    all += cosine * irradiance / kPerDirection;
    if (rayScene.Occluded(x, sample.direction, sample.distance)) continue;
    open += cosine * irradiance / kPerDirection;
    sum += sample.direction * irradiance;
  }
  *visible = all > 0 ? open / all : 1;
  return sum;
}

namespace {

/// Visible part of the source from one sample of the receiver: by the partner sample, or by all.
float PartnerVisibility(const ElementHierarchy& hierarchy, const RayScene& rayScene,
                        const Element& source, int partner, const Vec3f& x, const Vec3f& horizon,
                        int64_t* rays) {
  for (int j = 0; j < kSamplesPerElement; ++j) {
    Vec3f target;
    float weight;
    const int k = (partner + j) % kSamplesPerElement;
    if (!RayTarget(hierarchy, source, k, x, horizon, &target, &weight)) continue;
    ++*rays;
    return rayScene.Occluded(x, target) ? 0.f : 1.f;
  }
  return 1;
}

/// The vector along `transfer` that gives a receiver with normals of many directions the irradiance
/// that its samples, each with its own normal, receive: the samples that turn away must not thin
/// out the light of those that do not.
Vec3f KeepPower(const Element& receiver, const Vec3f& transfer, float received) {
  const Vec3f direction = Normalize(transfer);
  float facing = 0;
  if (receiver.IsVolume()) {
    for (const SurfaceSample& sample : receiver.samples) {
      facing += std::max(0.f, Dot(sample.normal, direction)) / kSamplesPerElement;
    }
  } else {
    facing = FacingFraction(receiver, direction);
  }
  return direction * std::min(received / std::max(facing, kLeastFacing), 1.f);
}

TransferEstimate EstimateSkyTransfer(const LightSource& sky, const RayScene& rayScene,
                                     const Element& source, const Element& receiver) {
  TransferEstimate estimate;
  for (const SurfaceSample& sample : receiver.samples) {
    const Vec3f& horizon = receiver.IsPolygon() ? receiver.axis : sample.normal;
    float open = 0;
    estimate.transfer +=
        SkyTransfer(sky, rayScene, source, sample.position, horizon, &open, &estimate.rays);
    estimate.visibility += open / kSamplesPerElement;
  }
  estimate.transfer /= float(kSamplesPerElement);
  return estimate;
}

}  // namespace

TransferEstimate EstimateTransfer(const ElementHierarchy& hierarchy, const RayScene& rayScene,
                                  const Element& source, const Element& receiver, bool thorough) {
  const bool isLight = source.kind == ElementKind::Light;
  if (isLight && hierarchy.LightOf(source).FillsSky()) {
    return EstimateSkyTransfer(hierarchy.LightOf(source), rayScene, source, receiver);
  }
  TransferEstimate estimate;
  float weight = 0, visibleWeight = 0, received = 0;
  for (int k = 0; k < kSamplesPerElement; ++k) {
    const SurfaceSample& sample = receiver.samples[size_t(k)];
    const Vec3f& horizon = receiver.IsPolygon() ? receiver.axis : sample.normal;
    const Vec3f kernel = UnoccludedTransfer(hierarchy, source, sample.position, horizon);
    const float size = Length(kernel);
    if (!(size > 0)) continue;
    const float visible =
        thorough || isLight
            ? VisibleFraction(hierarchy, rayScene, source, sample.position, horizon, &estimate.rays)
            : PartnerVisibility(hierarchy, rayScene, source, k, sample.position, horizon,
                                &estimate.rays);
    estimate.transfer += kernel * (visible / kSamplesPerElement);
    received += Dot(kernel, horizon) * (visible / kSamplesPerElement);
    weight += size;
    visibleWeight += size * visible;
  }
  estimate.visibility = weight > 0 ? visibleWeight / weight : 0;
  if (!receiver.IsPolygon()) estimate.transfer = KeepPower(receiver, estimate.transfer, received);
  return estimate;
}

}  // namespace lambert
