#include "Reference/Core/PathTracedIrradiance.h"

#include <array>
#include <limits>

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"
#include "Reference/Core/ReferenceRays.h"
#include "Scene/Core/LightSource.h"
#include "Visibility/Core/EmitterTree.h"

namespace lambert {

namespace {

using Vertex = ReferenceVertex;

double Fraction(double x) { return x - std::floor(x); }

/// Numbers in [0,1) that decide about one bounce of a path.
struct BounceNumbers {
  double roulette;
  double emitter[3];    ///< the place on an emitter
  double direction[2];  ///< the ray that goes on
};

BounceNumbers RandomBounce(Random* random) {
  BounceNumbers bounce;
  bounce.roulette = random->UniformDouble();
  for (double& u : bounce.emitter) u = random->UniformDouble();
  for (double& u : bounce.direction) u = random->UniformDouble();
  return bounce;
}

/// What decides about the receiver and the first bounce of its paths: additive recurrences under
/// random shifts, so that the paths of one receiver spread evenly.
class PathPointSet {
 public:
  explicit PathPointSet(uint64_t seed) {
    Random random(seed);
    for (double& shift : shifts_) shift = random.UniformDouble();
  }
  /// Without roulette: a receiver receives.
  BounceNumbers AtReceiver(int path) const {
    return {0, {At(path, 0), At(path, 1), At(path, 2)}, {At(path, 3), At(path, 4)}};
  }
  /// The sample of lights without geometry at the receiver.
  Vec2f OfLights(int path) const { return {float(At(path, 11)), float(At(path, 12))}; }
  BounceNumbers AtFirstBounce(int path) const {
    return {At(path, 5), {At(path, 6), At(path, 7), At(path, 8)}, {At(path, 9), At(path, 10)}};
  }

 private:
  double At(int path, size_t dimension) const {
    // The generalized golden ratios of 3 and 2 dimensions (Roberts 2018) at the receiver; fractions
    // of the square roots of primes (Richtmyer 1951) at the bounce.
    static constexpr double kSteps[13] = {
        0.8191725133961645, 0.6710436067037893, 0.5497004779019703, 0.7548776662466927,
        0.5698402909980532, 0.3166247903553998, 0.4142135623730950, 0.7320508075688772,
        0.2360679774997897, 0.6457513110645906, 0.6055512754639893, 0.7548776662466927,
        0.5698402909980532};
    return Fraction(shifts_[dimension] + path * kSteps[dimension]);
  }

  double shifts_[13];
};

/// Power heuristic of multiple importance sampling (Veach 1997, equation 9.13 with exponent 2).
float PowerHeuristic(float density, float other) {
  const float ratio = other / density;
  return 1 / (1 + ratio * ratio);
}

/// Mean and standard error over independent replicates.
class ReplicateMean {
 public:
  void Add(const std::array<double, 3>& value) {
    ++count_;
    for (size_t band = 0; band < 3; ++band) {
      const double delta = value[band] - mean_[band];
      mean_[band] += delta / count_;
      squares_[band] += delta * (value[band] - mean_[band]);
    }
  }
  IrradianceEstimate Estimate() const {
    IrradianceEstimate estimate;
    for (int band = 0; band < 3; ++band) {
      estimate.irradiance[band] = float(mean_[size_t(band)]);
      estimate.standardError[band] =
          float(std::sqrt(squares_[size_t(band)] / (double(count_) * (count_ - 1))));
    }
    return estimate;
  }

 private:
  int count_ = 0;
  std::array<double, 3> mean_{}, squares_{};
};

}  // namespace

struct PathTracedIrradiance::Implementation {
  explicit Implementation(const Scene& scene);

  IrradianceEstimate EstimateAt(const ReceiverPoint& point, uint64_t index,
                                const PathTracedIrradianceOptions& options) const;
  std::array<double, 3> SumOfPaths(const Vertex& receiver, uint64_t seed, PathRange paths,
                                   int maximumDepth, int64_t* rayCount) const;
  Spectrum Path(const Vertex& receiver, const PathPointSet& points, int path, uint64_t seed,
                int maximumDepth, int64_t* rayCount) const;
  Spectrum FromEmitters(const Vertex& at, const double u[3], int64_t* rayCount) const;
  Spectrum FromLight(const Vertex& at, const LightSource& light, const Vec2f& u,
                     int64_t* rayCount) const;
  Spectrum FromSteadyLights(const Vertex& at, int64_t* rayCount) const;
  Spectrum FromSpreadLights(const Vertex& at, const Vec2f& u, int64_t* rayCount) const;
  Spectrum FromOneLight(const Vertex& at, Random* random, int64_t* rayCount) const;

  const Scene& scene;
  ReferenceRays rays;
  EmitterTree emitters;
  LightSources lights;
};

PathTracedIrradiance::Implementation::Implementation(const Scene& scene_)
    : scene(scene_), rays(scene_.mesh), emitters(scene_.mesh), lights(scene_.lights) {}

// Light straight from its sources.

/// One sample of the irradiance from emitting faces, weighted against the cosine rays that may hit
/// them too.
Spectrum PathTracedIrradiance::Implementation::FromEmitters(const Vertex& at, const double u[3],
                                                            int64_t* rayCount) const {
  if (emitters.IsEmpty()) return {};
  const EmitterTree::Sample sample = emitters.Pick(at.position, at.normal, u);
  if (sample.face < 0 || !(sample.density > 0) || sample.distance < rays.Nearest()) return {};
  const float cosine = Dot(at.normal, sample.direction);
  if (cosine <= 0 || Dot(at.geometric, sample.direction) <= 0) return {};
  const Vec3f toward = scene.mesh.VectorArea(sample.face);
  const Side side = Dot(toward, sample.direction) < 0 ? kFront : kBack;
  if (!scene.mesh.Emits(sample.face, side)) return {};
  ++*rayCount;
  if (rays.Blocked(at, sample.direction, sample.distance)) return {};
  const float weight = PowerHeuristic(sample.density, cosine / float(kPi));
  const Spectrum radiance = scene.mesh.emittance[size_t(sample.face)] / float(kPi);
  return radiance * (cosine * weight / sample.density);
}

namespace {

/// What a sample gives where nothing is in the way.
Spectrum Unshadowed(const Vertex& at, const LightSample& sample) {
  const float cosine = Dot(at.normal, sample.direction);
  if (cosine <= 0 || Dot(at.geometric, sample.direction) <= 0) return {};
  return sample.irradiance * cosine;
}

}  // namespace

Spectrum PathTracedIrradiance::Implementation::FromLight(const Vertex& at, const LightSource& light,
                                                         const Vec2f& u, int64_t* rayCount) const {
  const LightSample sample = light.Sample(at.position, u);
  const Spectrum irradiance = Unshadowed(at, sample);
  if (irradiance.IsBlack()) return {};
  ++*rayCount;
  return rays.Blocked(at, sample.direction, sample.distance) ? Spectrum() : irradiance;
}

/// Lights whose samples are all alike need one ray, whatever the number of paths.
Spectrum PathTracedIrradiance::Implementation::FromSteadyLights(const Vertex& at,
                                                                int64_t* rayCount) const {
  Spectrum sum;
  for (const auto& light : lights) {
    if (light->Samples() == 1) sum += FromLight(at, *light, {}, rayCount);
  }
  return sum;
}

/// A sample of each of the others.
Spectrum PathTracedIrradiance::Implementation::FromSpreadLights(const Vertex& at, const Vec2f& u,
                                                                int64_t* rayCount) const {
  Spectrum sum;
  for (const auto& light : lights) {
    if (light->Samples() > 1) sum += FromLight(at, *light, u, rayCount);
  }
  return sum;
}

/// One light, chosen by what its sample would give if nothing stood between.
Spectrum PathTracedIrradiance::Implementation::FromOneLight(const Vertex& at, Random* random,
                                                            int64_t* rayCount) const {
  if (!lights.HaveSamples()) return {};
  Random sampling(SeedOfPlace(at.position));
  const float u0 = sampling.Uniform(), u1 = sampling.Uniform();
  const auto shareOf = [&](const auto& light) {
    return double(Unshadowed(at, light->Sample(at.position, {u0, u1})).Mean());
  };
  double total = 0;
  for (const auto& light : lights) total += shareOf(light);
  if (!(total > 0)) return {};
  double rest = random->UniformDouble() * total;
  for (const auto& light : lights) {
    const double share = shareOf(light);
    rest -= share;
    if (rest < 0) return FromLight(at, *light, {u0, u1}, rayCount) * float(total / share);
  }
  return {};
}

// Paths.

/// Light that reaches the receiver over one path, but for that of steady lights straight to it.
Spectrum PathTracedIrradiance::Implementation::Path(const Vertex& receiver,
                                                    const PathPointSet& points, int path,
                                                    uint64_t seed, int maximumDepth,
                                                    int64_t* rayCount) const {
  const TriangleMesh& mesh = scene.mesh;
  Random random(HashBits(seed, uint64_t(path)));
  BounceNumbers numbers = points.AtReceiver(path);
  Spectrum sum = FromEmitters(receiver, numbers.emitter, rayCount) +
                 FromSpreadLights(receiver, points.OfLights(path), rayCount);
  Spectrum throughput(1.f);
  Vertex at = receiver;
  for (int depth = 0;; ++depth) {
    // A cosine-weighted ray about the normal, within the geometric hemisphere.
    Vec3f s, t;
    CoordinateSystem(at.normal, &s, &t);
    const Vec3f local = CosineHemisphere(float(numbers.direction[0]), float(numbers.direction[1]));
    const Vec3f direction = s * local.x + t * local.y + at.normal * local.z;
    if (Dot(direction, at.geometric) <= 0) return sum;

    // It escapes to the sky, or meets a side of a face. What that emits is weighted against the
    // choice of emitters.
    ReferenceHit hit;
    ++*rayCount;
    if (!rays.Closest(at, direction, &hit)) {
      return sum + throughput * lights.Radiance(direction) * float(kPi);
    }
    if (mesh.Emits(hit.face, hit.side)) {
      const float density =
          emitters.Density(at.position, at.normal, hit.face, direction, hit.distance);
      const float weight = PowerHeuristic(local.z / float(kPi), density);
      sum += throughput * mesh.emittance[size_t(hit.face)] * weight;
    }
    if (depth == maximumDepth) return sum;

    // Diffuse reflection; roulette keeps the throughput near 0.4.
    numbers = depth == 0 ? points.AtFirstBounce(path) : RandomBounce(&random);
    throughput = throughput * mesh.reflectance[size_t(hit.face)];
    const float survival = std::min(1.f, 2.5f * throughput.MaxBand());
    if (!(numbers.roulette < double(survival))) return sum;
    throughput *= 1 / survival;

    // The next receiver is the place that was hit.
    at = hit.vertex;
    sum += throughput *
           (FromEmitters(at, numbers.emitter, rayCount) + FromOneLight(at, &random, rayCount));
  }
}

std::array<double, 3> PathTracedIrradiance::Implementation::SumOfPaths(const Vertex& receiver,
                                                                       uint64_t seed,
                                                                       PathRange paths,
                                                                       int maximumDepth,
                                                                       int64_t* rayCount) const {
  const PathPointSet points(seed);
  std::array<double, 3> sum{};
  for (int path = paths.begin; path < paths.end; ++path) {
    const Spectrum light = Path(receiver, points, path, seed, maximumDepth, rayCount);
    for (size_t band = 0; band < 3; ++band) sum[band] += double(light[int(band)]);
  }
  return sum;
}

namespace {

/// False where the point is no place for light to arrive at. A point without a normal of its own
/// takes the geometric one.
bool MakeReceiver(const ReceiverPoint& point, Vertex* receiver) {
  *receiver = {point.position, Normalize(point.normal), Normalize(point.geometricNormal)};
  if (LengthSquared(receiver->geometric) == 0) receiver->geometric = receiver->normal;
  if (LengthSquared(receiver->normal) == 0) receiver->normal = receiver->geometric;
  return LengthSquared(receiver->normal) > 0 && IsFinite(receiver->position);
}

}  // namespace

IrradianceEstimate PathTracedIrradiance::Implementation::EstimateAt(
    const ReceiverPoint& point, uint64_t index, const PathTracedIrradianceOptions& options) const {
  Vertex receiver;
  if (!MakeReceiver(point, &receiver)) return {};

  // Replicates of one point set under independent random shifts: their spread is an honest error.
  const int replicates = std::min(16, options.samples);
  const int samples = (options.samples + replicates - 1) / replicates;
  int64_t rayCount = 0;
  ReplicateMean mean;
  for (int replicate = 0; replicate < replicates; ++replicate) {
    const uint64_t seed = HashBits(options.seed, HashBits(index, uint64_t(replicate)));
    std::array<double, 3> light =
        SumOfPaths(receiver, seed, {0, samples}, options.maximumDepth, &rayCount);
    for (double& band : light) band /= samples;
    mean.Add(light);
  }
  IrradianceEstimate estimate = mean.Estimate();
  estimate.irradiance += FromSteadyLights(receiver, &rayCount);
  return estimate;
}

PathTracedIrradiance::PathTracedIrradiance(const Scene& scene)
    : implementation_(new Implementation(scene)) {}
PathTracedIrradiance::~PathTracedIrradiance() = default;

std::vector<IrradianceEstimate> PathTracedIrradiance::Estimate(
    const std::vector<ReceiverPoint>& points, const PathTracedIrradianceOptions& options,
    const ProgressCallback& progress) const {
  if (options.samples < 2) {
    throw Error("A path trace needs at least 2 samples a point; " +
                std::to_string(options.samples) + " were asked for.");
  }
  std::vector<IrradianceEstimate> estimates(points.size());
  const int64_t count = int64_t(points.size());
  const int64_t block = std::max<int64_t>(64, (int64_t(1) << 18) / options.samples);
  for (int64_t begin = 0; begin < count; begin += block) {
    if (!Report(progress, double(begin) / double(count), "Tracing paths")) throw Cancelled();
    ParallelFor(std::min(block, count - begin), 1, [&](int64_t from, int64_t to) {
      FlushDenormals flush;
      for (int64_t i = begin + from; i < begin + to; ++i) {
        estimates[size_t(i)] = implementation_->EstimateAt(points[size_t(i)], uint64_t(i), options);
      }
    });
  }
  if (!Report(progress, 1, "Tracing paths")) throw Cancelled();
  return estimates;
}

std::array<double, 3> PathTracedIrradiance::SumOfPaths(const ReceiverPoint& point, uint64_t seed,
                                                       PathRange paths, int64_t* rays) const {
  Vertex receiver;
  if (!MakeReceiver(point, &receiver) || paths.end <= paths.begin) return {};
  const int maximumDepth = PathTracedIrradianceOptions().maximumDepth;
  std::array<double, 3> sum =
      implementation_->SumOfPaths(receiver, seed, paths, maximumDepth, rays);
  const Spectrum steady = implementation_->FromSteadyLights(receiver, rays);
  for (size_t band = 0; band < 3; ++band) {
    sum[band] += double(steady[int(band)]) * (paths.end - paths.begin);
  }
  return sum;
}

}  // namespace lambert
