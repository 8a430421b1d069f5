#include "Classical/Core/CachedRadiosity.h"

#include <string>
#include <utility>

#include "Classical/Core/CacheGather.h"
#include "Classical/Core/UniformMesh.h"
#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"

namespace lambert {

namespace {

void RequireOptions(const CachedRadiosityOptions& options) {
  const std::pair<const char*, int> counts[] = {{"paths", options.paths},
                                                {"gather rays", options.gatherRays},
                                                {"emitter rays", options.emitterRays}};
  for (const auto& [name, count] : counts) {
    if (count < 1) {
      throw Error("The number of " + std::string(name) + " is " + std::to_string(count) +
                  "; it must be at least 1.");
    }
  }
}

/// Per face, bit 1 where light reaches its front, bit 2 its back: where it reaches a cell there, or
/// the side emits.
std::vector<uint8_t> LitSides(const TriangleMesh& mesh, const ElementCells& cells,
                              const ElementCache& cache) {
  std::vector<uint8_t> lit(mesh.triangles.size(), 0);
  ParallelForEach(mesh.FaceCount(), 1024, [&](int64_t face) {
    for (const Side side : {kFront, kBack}) {
      bool isLit = mesh.Emits(face, side) && !mesh.emittance[size_t(face)].IsBlack();
      cells.ForEachCell(face, [&](int32_t cell) { isLit |= cache.IsLit(cell, side); });
      if (isLit) lit[size_t(face)] |= uint8_t(1 << side);
    }
  });
  return lit;
}

/// Rays begin at this many times the length that they skip away from other surfaces' edges: a
/// surface nearer than that length does not block.
constexpr float kClearance = 8;
/// Nor further than this part of the way, so that small elements keep light apart.
constexpr float kMostInward = 0.1f;
/// Hits nearer than this part of an element are followed further: a cell is too coarse for them.
constexpr double kNearby = 0.25;

/// The receivers, drawn into their elements at least so far (m) that their rays leak through no
/// surface that meets theirs.
std::vector<LightReceiver> GatherPoints(const UniformMesh& mesh, const UniformSolution& uniform,
                                        float clearance) {
  std::vector<LightReceiver> points(uniform.receivers.size());
  ParallelForEach(int64_t(points.size()), 1024, [&](int64_t i) {
    const ElementReceiver& at = uniform.receivers[size_t(i)];
    const Vec3f inward = mesh.Centroid(at.element) - at.position;
    const float distance = Length(inward);
    const float share = distance > 0 ? std::min(kMostInward, clearance / distance) : 0;
    points[size_t(i)] = {at.position + inward * share, at.normal, at.geometric};
  });
  return points;
}

ProgressCallback ShareOf(const ProgressCallback& progress, double from, double to) {
  if (!progress) return {};
  return [progress, from, to](double fraction, const char* stage) {
    return progress(from + (to - from) * fraction, stage);
  };
}

}  // namespace

RadiositySolution SolveCachedRadiosity(const Scene& scene, const CachedRadiosityOptions& options,
                                       SolverStatistics* statistics,
                                       const ProgressCallback& progress) {
  RequireOptions(options);
  const double elementSize = ResolveElementSize(scene, options.elementSize);

  // The light of the cells.
  const RayScene rays(scene.mesh);
  const SourceLight sources(scene, rays);
  const ElementCells cells(scene.mesh, elementSize);
  ElementCache cache(scene, rays, sources, cells, options.paths, options.seed);
  cache.Fill(ShareOf(progress, 0, 0.3));

  // The points, and their light.
  const UniformMesh mesh = MakeUniformMesh(scene, elementSize);
  UniformSolution uniform = MakeUniformSolution(scene, mesh, LitSides(scene.mesh, cells, cache));
  const std::vector<LightReceiver> points =
      GatherPoints(mesh, uniform, kClearance * rays.Epsilon());
  CacheGatherOptions gather;
  gather.rays = options.gatherRays;
  gather.emitterRays = options.emitterRays;
  gather.nearby = kNearby * elementSize;
  gather.seed = HashBits(options.seed, 0x676174686572ull);
  int64_t cast = 0;
  std::vector<Spectrum> irradiance = GatherFromCache(scene, rays, sources, cache, points, gather,
                                                     &cast, ShareOf(progress, 0.3, 1));
  if (statistics) {
    cache.Account(statistics);
    statistics->rays += cast;
    statistics->stoppedBy = "error";
  }
  return DeliverLight(scene, std::move(uniform), std::move(irradiance));
}

}  // namespace lambert
