#include "Classical/Core/CacheGather.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"

namespace lambert {

namespace {

/// Rays that are traced together.
constexpr int kRaysPerBatch = 1024;
/// A ray is followed over so many near hits at the most. One mends the corners of rooms; more cost
/// as much again within small things, where they mend little.
constexpr int kMostHops = 1;

class CacheGatherer {
 public:
  CacheGatherer(const Scene& scene, const RayScene& rays, const SourceLight& sources,
                const ElementCache& cache, const std::vector<LightReceiver>& points,
                const CacheGatherOptions& options)
      : scene_(scene),
        rays_(rays),
        sources_(sources),
        cache_(cache),
        points_(points),
        options_(options) {}

  /// Gathers at points_[order[0]], ... Results go to their own places of `irradiance`.
  void Gather(const int32_t* order, int count, Spectrum* irradiance, int64_t* cast);

 private:
  /// What a ray is for.
  struct Trail {
    int32_t point;        ///< that the light goes to
    Spectrum throughput;  ///< of what the ray brings there
  };

  void StartRays(int32_t point);
  Side SideOf(const RayHit& hit, const Vec3f& direction) const {
    return Dot(scene_.mesh.VectorArea(hit.face), direction) < 0 ? kFront : kBack;
  }
  /// What comes along a ray, as radiosity, W/m2.
  Spectrum Read(int32_t ray) const;
  void Follow(int32_t ray, uint64_t hop, Spectrum* irradiance, int64_t* cast);

  const Scene& scene_;
  const RayScene& rays_;
  const SourceLight& sources_;
  const ElementCache& cache_;
  const std::vector<LightReceiver>& points_;
  const CacheGatherOptions& options_;
  RayBatch batch_, next_;
  std::vector<Trail> trails_, nextTrails_;
};

/// Cosine-weighted rays, a Hammersley set under a random shift of the point's own.
void CacheGatherer::StartRays(int32_t point) {
  const LightReceiver& at = points_[size_t(point)];
  Random random(HashBits(options_.seed, uint64_t(point)));
  const float shift0 = random.Uniform(), shift1 = random.Uniform();
  Vec3f s, t;
  CoordinateSystem(at.normal, &s, &t);
  for (int i = 0; i < options_.rays; ++i) {
    const float u = (float(i) + shift0) / float(options_.rays);
    const Vec3f local = CosineHemisphere(u, RadicalInverse(uint32_t(i), shift1));
    const Vec3f direction = Normalize(s * local.x + t * local.y + at.normal * local.z);
    if (Dot(direction, at.geometric) <= 0) continue;
    batch_.Add(at.position, direction);
    trails_.push_back({point, Spectrum(1 / float(options_.rays))});
  }
}

Spectrum CacheGatherer::Read(int32_t ray) const {
  const RayHit& hit = batch_.Hit(ray);
  if (hit.face < 0) return sources_.Sky(batch_.Direction(ray)) * float(kPi);
  return cache_.Reflected(hit.face, SideOf(hit, batch_.Direction(ray)), hit.barycentric);
}

/// Near by, a cell is too coarse: the direct light of the place itself, and one more ray.
void CacheGatherer::Follow(int32_t ray, uint64_t hop, Spectrum* irradiance, int64_t* cast) {
  const TriangleMesh& mesh = scene_.mesh;
  const RayHit& hit = batch_.Hit(ray);
  const Trail& trail = trails_[size_t(ray)];
  const Side side = SideOf(hit, batch_.Direction(ray));
  const Vec3f normal = hit.front * (side == kFront ? 1.f : -1.f);
  const Vec3f middle =
      (mesh.Corner(hit.face, 0) + mesh.Corner(hit.face, 1) + mesh.Corner(hit.face, 2)) / 3.f;
  const LightReceiver at{DrawnInward(batch_.HitPosition(ray), middle, rays_), normal, normal};
  Random random(HashBits(HashBits(options_.seed, uint64_t(trail.point)),
                         (hop + 1) << 32 | uint64_t(hit.face)));
  const Spectrum throughput = trail.throughput * mesh.reflectance[size_t(hit.face)];
  if (throughput.IsBlack()) return;
  irradiance[trail.point] +=
      throughput * (sources_.FromEmitters(at, 1, &random, cast) + sources_.FromLights(at, cast));
  Vec3f s, t;
  CoordinateSystem(normal, &s, &t);
  const float u = random.Uniform(), v = random.Uniform();
  const Vec3f local = CosineHemisphere(u, v);
  next_.Add(at.position, Normalize(s * local.x + t * local.y + normal * local.z));
  nextTrails_.push_back({trail.point, throughput});
}

void CacheGatherer::Gather(const int32_t* order, int count, Spectrum* irradiance, int64_t* cast) {
  // Straight from the sources.
  batch_.Clear();
  trails_.clear();
  for (int i = 0; i < count; ++i) {
    const int32_t point = order[i];
    Random random(HashBits(options_.seed, ~uint64_t(point)));
    const LightReceiver& at = points_[size_t(point)];
    irradiance[point] = sources_.FromEmitters(at, options_.emitterRays, &random, cast) +
                        sources_.FromLights(at, cast);
    StartRays(point);
  }

  // By rays that end in the cache at the first hit that is not near.
  for (int hop = 0; hop <= kMostHops && batch_.Size() > 0; ++hop) {
    batch_.Trace(rays_);
    *cast += batch_.Size();
    next_.Clear();
    nextTrails_.clear();
    for (int32_t ray = 0; ray < batch_.Size(); ++ray) {
      const RayHit& hit = batch_.Hit(ray);
      const Trail& trail = trails_[size_t(ray)];
      if (hit.face < 0 || double(hit.distance) >= options_.nearby || hop == kMostHops) {
        irradiance[trail.point] += trail.throughput * Read(ray);
      } else {
        Follow(ray, uint64_t(hop) << 16 | uint64_t(ray), irradiance, cast);
      }
    }
    std::swap(batch_, next_);
    std::swap(trails_, nextTrails_);
  }
}

}  // namespace

Vec3f DrawnInward(const Vec3f& position, const Vec3f& middle, const RayScene& rays) {
  constexpr float kClearance = 8;
  constexpr float kMostInward = 0.1f;
  const Vec3f inward = middle - position;
  const float distance = Length(inward), clearance = kClearance * rays.Epsilon();
  return position + inward * (distance > 0 ? std::min(kMostInward, clearance / distance) : 0);
}

std::vector<Spectrum> GatherFromCache(const Scene& scene, const RayScene& rays,
                                      const SourceLight& sources, const ElementCache& cache,
                                      const std::vector<LightReceiver>& points,
                                      const CacheGatherOptions& options, int64_t* cast,
                                      const ProgressCallback& progress) {
  // Neighbours together.
  std::vector<Vec3f> positions, normals;
  for (const LightReceiver& point : points) {
    positions.push_back(point.position);
    normals.push_back(point.normal);
  }
  const std::vector<int32_t> order = CoherentOrder(positions, normals);

  // Batches, a stretch of them between two reports.
  std::vector<Spectrum> irradiance(points.size());
  const int64_t count = int64_t(points.size());
  const int64_t perBatch = std::max(1, kRaysPerBatch / options.rays);
  const int64_t batches = (count + perBatch - 1) / perBatch;
  constexpr int64_t kStretch = 1024;
  std::vector<int64_t> castByBatch(size_t(batches), 0);
  for (int64_t first = 0; first < batches; first += kStretch) {
    if (!Report(progress, double(first) / double(batches), "Gathering")) throw Cancelled();
    ParallelFor(std::min(kStretch, batches - first), 4, [&](int64_t begin, int64_t end) {
      CacheGatherer gatherer(scene, rays, sources, cache, points, options);
      for (int64_t batch = first + begin; batch < first + end; ++batch) {
        const int64_t from = batch * perBatch, to = std::min(count, from + perBatch);
        gatherer.Gather(&order[size_t(from)], int(to - from), irradiance.data(),
                        &castByBatch[size_t(batch)]);
      }
    });
  }
  *cast += std::accumulate(castByBatch.begin(), castByBatch.end(), int64_t(0));
  return irradiance;
}

}  // namespace lambert
