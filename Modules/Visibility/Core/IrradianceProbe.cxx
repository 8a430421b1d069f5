#include "Visibility/Core/IrradianceProbe.h"

#include <cstring>
#include <limits>

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"
#include "Scene/Core/LightSource.h"
#include "Scene/Core/SceneLimits.h"
#include "Visibility/Core/SolutionLookup.h"

namespace lambert {

namespace {

/// A probe is inside where it sees no source of light, this share of all directions and of its own
/// hemisphere ends on sides that no light was found to reach, and next to nothing escapes. Less
/// than all, because one large face, such as a floor, counts as lit under the thing that stands on
/// it.
constexpr double kDarkSphere = 0.6, kDarkHemisphere = 0.4, kEscaping = 0.02;
constexpr float kCosineOfSameFacing = 0.5f;  ///< 60 degrees

struct Emitter {
  int32_t face;
  float area;
};

/// What is needed to read any probe.
class ProbeReader {
 public:
  ProbeReader(const Scene& scene, const RayScene& rays, const RadiositySolution& solution,
              const IrradianceProbeOptions& options);
  ProbeReading Read(const ProbePoint& probe) const;

 private:
  /// Light that a gather found, and what its rays ended on.
  struct Gathered {
    Spectrum indirect, direct;
    double darkHemisphere = 0;
  };

  bool ReadSurface(const ProbePoint& probe, Spectrum* irradiance) const;
  Gathered Gather(const ProbePoint& probe, Random* random) const;
  std::vector<float> ChooseEmitters(const ProbePoint& probe) const;
  Spectrum FromEmitters(const ProbePoint& probe, const std::vector<float>& shares,
                        Random* random) const;
  Spectrum FromLights(const ProbePoint& probe) const;
  bool SeesDarknessAllAround(const Vec3f& position, Random* random) const;
  float Weight(double own, double ownRays, double other, double otherRays) const {
    const double a = own * ownRays, b = other * otherRays;
    return float(a * a / (a * a + b * b));
  }
  double EmitterDensity(size_t number, const std::vector<float>& shares, float cosine,
                        float distance) const {
    return cosine > 0 ? shares[number] * double(distance) * distance /
                            (double(cosine) * emitters_[number].area)
                      : 0;
  }

  const Scene& scene_;
  const RayScene& rays_;
  const IrradianceProbeOptions& options_;
  SolutionLookup lookup_;
  std::vector<Emitter> emitters_;
  std::vector<int32_t> emitterOfFace_;
  LightSources lights_;
};

Side SideFacing(const Vec3f& front, const Vec3f& direction) {
  return Dot(front, direction) < 0 ? kFront : kBack;
}

ProbeReader::ProbeReader(const Scene& scene, const RayScene& rays,
                         const RadiositySolution& solution, const IrradianceProbeOptions& options)
    : scene_(scene),
      rays_(rays),
      options_(options),
      lookup_(solution, scene.mesh.FaceCount()),
      emitterOfFace_(size_t(scene.mesh.FaceCount()), -1),
      lights_(scene.lights) {
  const TriangleMesh& mesh = scene.mesh;
  for (int32_t face = 0; face < int32_t(mesh.FaceCount()); ++face) {
    if (!(mesh.Emits(face, kFront) || mesh.Emits(face, kBack))) continue;
    const float area = mesh.Area(face);
    if (mesh.emittance[size_t(face)].IsBlack() || !(area > 0)) continue;
    emitterOfFace_[size_t(face)] = int32_t(emitters_.size());
    emitters_.push_back({face, area});
  }
}

/// The reading is a function of the probe's own numbers, so that the same point reads the same in
/// any list.
uint64_t SeedOf(const ProbePoint& probe) {
  uint64_t seed = 0;
  for (int axis = 0; axis < 3; ++axis) {
    uint32_t position = 0, normal = 0;
    std::memcpy(&position, &probe.position[axis], sizeof position);
    std::memcpy(&normal, &probe.normal[axis], sizeof normal);
    seed = HashBits(seed, (uint64_t(position) << 32) | normal);
  }
  return seed;
}

ProbeReading ProbeReader::Read(const ProbePoint& given) const {
  const ProbePoint probe{given.position, Vec3f(Normalize(Vec3d(given.normal)))};
  ProbeReading reading;
  if (!options_.forceGather && ReadSurface(probe, &reading.irradiance)) {
    reading.kind = ProbeKind::Surface;
    return reading;
  }
  Random random(SeedOf(probe));
  const Gathered gathered = Gather(probe, &random);
  const bool dark = gathered.direct.IsBlack() && gathered.darkHemisphere >= kDarkHemisphere;
  if (dark && SeesDarknessAllAround(probe.position, &random)) {
    reading.kind = ProbeKind::Inside;
    return reading;
  }
  reading.irradiance = gathered.direct + gathered.indirect;
  return reading;
}

/// Squared distance of p from triangle abc.
double SquaredDistance(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const auto toSegment = [&p](const Vec3d& from, const Vec3d& to) {
    const Vec3d edge = to - from;
    const double length = LengthSquared(edge);
    const double t = length > 0 ? std::clamp(Dot(p - from, edge) / length, 0.0, 1.0) : 0.0;
    return LengthSquared(from + edge * t - p);
  };
  const Vec3d normal = Normalize(Cross(b - a, c - a));
  const bool above = Dot(Cross(b - a, p - a), normal) >= 0 &&
                     Dot(Cross(c - b, p - b), normal) >= 0 && Dot(Cross(a - c, p - c), normal) >= 0;
  if (above && LengthSquared(normal) > 0) return Dot(p - a, normal) * Dot(p - a, normal);
  return std::min(toSegment(a, b), std::min(toSegment(b, c), toSegment(c, a)));
}

/// The delivered solution, where the probe lies on a modelled side that faces its way; the nearest
/// such side, and of equally near ones that which faces it best.
bool ProbeReader::ReadSurface(const ProbePoint& probe, Spectrum* irradiance) const {
  const TriangleMesh& mesh = scene_.mesh;
  const float reach = rays_.Epsilon();
  double nearest = std::numeric_limits<double>::infinity(), facing = 0;
  int32_t found = -1;
  Side foundSide = kFront;
  for (const int32_t face : rays_.FacesNear(probe.position, reach)) {
    const float cosine = Dot(mesh.FrontNormal(face), probe.normal);
    const Side side = cosine > 0 ? kFront : kBack;
    if (std::abs(cosine) < kCosineOfSameFacing || !lookup_.Models(face, side)) continue;
    const double distance =
        SquaredDistance(Vec3d(probe.position), Vec3d(mesh.Corner(face, 0)),
                        Vec3d(mesh.Corner(face, 1)), Vec3d(mesh.Corner(face, 2)));
    if (distance > double(reach) * reach || distance > nearest) continue;
    if (distance == nearest && std::abs(cosine) <= facing) continue;
    nearest = distance, facing = std::abs(cosine);
    found = face, foundSide = side;
  }
  if (found < 0) return false;
  *irradiance = lookup_.Irradiance(lookup_.Find(found, foundSide, probe.position));
  return true;
}

ProbeReader::Gathered ProbeReader::Gather(const ProbePoint& probe, Random* random) const {
  const TriangleMesh& mesh = scene_.mesh;
  const std::vector<float> shares = ChooseEmitters(probe);
  Gathered gathered;
  gathered.direct = FromEmitters(probe, shares, random) + FromLights(probe);

  // Cosine-weighted rays, stratified (Hammersley points under one random shift).
  Vec3f s, t;
  CoordinateSystem(probe.normal, &s, &t);
  const float shift0 = random->Uniform(), shift1 = random->Uniform();
  const float perRay = 1 / float(options_.rays);
  for (int i = 0; i < options_.rays; ++i) {
    const float u = (float(i) + shift0) * perRay;
    const Vec3f local = CosineHemisphere(u, RadicalInverse(uint32_t(i), shift1));
    const Vec3f direction = s * local.x + t * local.y + probe.normal * local.z;
    const RayHit hit = rays_.Closest(probe.position, direction);
    if (hit.face < 0) {
      gathered.direct += lights_.Radiance(direction) * (float(kPi) * perRay);
      continue;
    }

    // Radiosity of the side that was hit; its own emission is weighted against the choice of
    // emitters.
    const Vec3f front = hit.front;
    const Side side = SideFacing(front, direction);
    const bool emits = mesh.Emits(hit.face, side);
    const Spectrum emittance = emits ? mesh.emittance[size_t(hit.face)] : Spectrum(0.f);
    const Vec3f place = probe.position + direction * hit.distance;
    const Spectrum radiosity = lookup_.Radiosity(lookup_.Find(hit.face, side, place));
    for (int band = 0; band < 3; ++band) {
      gathered.indirect[band] += std::max(0.f, radiosity[band] - emittance[band]) * perRay;
    }
    const int32_t number = emits ? emitterOfFace_[size_t(hit.face)] : -1;
    if (number >= 0) {
      const double density =
          EmitterDensity(size_t(number), shares, std::abs(Dot(front, direction)), hit.distance);
      gathered.direct += emittance * (perRay * Weight(local.z / kPi, options_.rays, density,
                                                      options_.emitterRays));
    }
    if (!emits && !lookup_.Models(hit.face, side)) gathered.darkHemisphere += perRay;
  }
  return gathered;
}

/// The share of the emitter rays that goes to each emitting face: by power, squared distance and
/// the best cosine at the probe. Any choice gives the same mean; this one little noise.
std::vector<float> ProbeReader::ChooseEmitters(const ProbePoint& probe) const {
  const TriangleMesh& mesh = scene_.mesh;
  std::vector<float> shares(emitters_.size(), 0.f);
  double total = 0;
  for (size_t i = 0; i < emitters_.size(); ++i) {
    const int32_t face = emitters_[i].face;
    const Vec3f front = mesh.FrontNormal(face);
    const bool seesFront = Dot(front, probe.position - mesh.Corner(face, 0)) > 0;
    if (!mesh.Emits(face, seesFront ? kFront : kBack)) continue;
    float cosine = 0, nearest = std::numeric_limits<float>::infinity();
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3f offset = mesh.Corner(face, corner) - probe.position;
      cosine = std::max(cosine, Dot(probe.normal, Normalize(offset)));
      nearest = std::min(nearest, LengthSquared(offset));
    }
    const float scale = std::max(nearest, emitters_[i].area);
    if (!(cosine > 0)) continue;
    shares[i] = mesh.emittance[size_t(face)].Mean() * emitters_[i].area * cosine / scale;
    total += shares[i];
  }
  for (float& share : shares) share = total > 0 ? float(share / total) : 0;
  return shares;
}

Spectrum ProbeReader::FromEmitters(const ProbePoint& probe, const std::vector<float>& shares,
                                   Random* random) const {
  const TriangleMesh& mesh = scene_.mesh;
  Spectrum sum;
  const double shift = random->UniformDouble();
  const float shift1 = random->Uniform(), shift2 = random->Uniform();
  double below = 0;
  int i = 0;
  for (size_t number = 0; number < shares.size(); ++number) {
    below += shares[number];
    // Stratified: emitter `number` gets the rays whose place in [0,1) falls into its share.
    for (; i < options_.emitterRays && (i + shift) < below * options_.emitterRays; ++i) {
      const int32_t face = emitters_[number].face;
      const Vec2f b = UniformTriangle(RadicalInverse(uint32_t(i), shift1),
                                      float(std::fmod(i * 0.6180339887498949 + shift2, 1.0)));
      const Vec3f place =
          PlaceOnTriangle(mesh.Corner(face, 0), mesh.Corner(face, 1), mesh.Corner(face, 2), b);
      const float distance = Length(place - probe.position);
      if (!(distance > rays_.Epsilon())) continue;
      const Vec3f direction = (place - probe.position) / distance;
      const float cosine = Dot(probe.normal, direction);
      const Vec3f front = mesh.FrontNormal(face);
      if (cosine <= 0 || !mesh.Emits(face, SideFacing(front, direction))) continue;
      const double density =
          EmitterDensity(number, shares, std::abs(Dot(front, direction)), distance);
      if (!(density > 0) || rays_.Occluded(probe.position, place)) continue;
      const float weight = Weight(density, options_.emitterRays, cosine / kPi, options_.rays);
      sum += mesh.emittance[size_t(face)] *
             float(cosine / kPi * weight / (density * options_.emitterRays));
    }
  }
  return sum;
}

Spectrum ProbeReader::FromLights(const ProbePoint& probe) const {
  const LitPlace place{probe.position, probe.normal, probe.normal};
  return lights_.Irradiance(
      place, options_.emitterRays, SeedOf(probe), [&](const LightSample& sample) {
        return !rays_.Occluded(probe.position, sample.direction, sample.distance);
      });
}

/// True where most directions of the whole sphere end on sides that no light was found to reach.
bool ProbeReader::SeesDarknessAllAround(const Vec3f& position, Random* random) const {
  const int count = 256;
  const float shift0 = random->Uniform(), shift1 = random->Uniform();
  int dark = 0, escaping = 0;
  for (int i = 0; i < count; ++i) {
    const float z = 1 - 2 * (float(i) + shift0) / count;
    const float radius = std::sqrt(std::max(0.f, 1 - z * z));
    const float angle = float(2 * kPi) * RadicalInverse(uint32_t(i), shift1);
    const Vec3f direction(radius * std::cos(angle), radius * std::sin(angle), z);
    const RayHit hit = rays_.Closest(position, direction);
    if (hit.face < 0) {
      ++escaping;
      continue;
    }
    const Side side = SideFacing(hit.front, direction);
    if (!scene_.mesh.Emits(hit.face, side) && !lookup_.Models(hit.face, side)) ++dark;
  }
  return dark >= kDarkSphere * count && escaping <= kEscaping * count;
}

void CheckInput(const std::vector<ProbePoint>& points, const IrradianceProbeOptions& options) {
  if (options.rays < 1 || options.emitterRays < 1) {
    throw Error("A probe needs at least one gather ray and one emitter ray.");
  }
  for (size_t i = 0; i < points.size(); ++i) {
    const std::string row = "Probe row " + std::to_string(i + 1);
    if (!IsWithinReach(points[i].position)) {
      throw Error(row + " has a coordinate that is not a finite number or beyond 1e15 m.");
    }
    if (!IsFinite(points[i].normal) || !(LengthSquared(Vec3d(points[i].normal)) > 0)) {
      throw Error(row +
                  " has a normal that is zero or not finite; give the direction that the "
                  "facet faces.");
    }
  }
}

}  // namespace

const char* ProbeKindName(ProbeKind kind) {
  return kind == ProbeKind::Surface ? "surface" : kind == ProbeKind::Space ? "space" : "inside";
}

std::vector<ProbeReading> ReadIrradianceProbes(const Scene& scene, const RayScene& rays,
                                               const RadiositySolution& solution,
                                               const std::vector<ProbePoint>& points,
                                               const IrradianceProbeOptions& options,
                                               const ProgressCallback& progress) {
  CheckInput(points, options);
  const ProbeReader reader(scene, rays, solution, options);
  std::vector<ProbeReading> readings(points.size());
  const int64_t count = int64_t(points.size()), block = 4096;
  for (int64_t begin = 0; begin < count; begin += block) {
    if (!Report(progress, double(begin) / double(count), "Reading probes")) throw Cancelled();
    ParallelForEach(std::min(block, count - begin), 4, [&](int64_t i) {
      readings[size_t(begin + i)] = reader.Read(points[size_t(begin + i)]);
    });
  }
  if (!Report(progress, 1, "Reading probes")) throw Cancelled();
  return readings;
}

}  // namespace lambert
