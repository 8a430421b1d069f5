#include "Classical/Core/CachedRadiosity.h"

#include <numeric>
#include <string>
#include <utility>

#include "Classical/Core/CacheGather.h"
#include "Classical/Core/UniformMesh.h"
#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Scene/Core/DoubledFaces.h"

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

/// What the solver has made so far.
struct FilledCache {
  const Scene& scene;
  const RayScene& rays;
  const SourceLight& sources;
  const ElementCells& cells;
  const ElementCache& cache;
};

/// A few rays from the middle of a small face, whose cell may be dark elsewhere: do they find
/// light?
bool FindsLight(const FilledCache& filled, int64_t face, Side side, uint64_t seed, int64_t* cast) {
  constexpr int kRays = 4;
  const TriangleMesh& mesh = filled.scene.mesh;
  const Vec3f normal = mesh.FrontNormal(face) * (side == kFront ? 1.f : -1.f);
  if (LengthSquared(normal) == 0) return false;
  const Vec3f middle = (mesh.Corner(face, 0) + mesh.Corner(face, 1) + mesh.Corner(face, 2)) / 3.f;
  const LightReceiver at{middle, normal, normal};
  Random random(HashBits(seed, uint64_t(face) * 2 + side));
  if (!filled.sources.FromEmitters(at, 1, &random, cast).IsBlack()) return true;
  if (!filled.sources.FromLights(at, cast).IsBlack()) return true;
  Vec3f s, t;
  CoordinateSystem(normal, &s, &t);
  for (int ray = 0; ray < kRays; ++ray, ++*cast) {
    const float u = random.Uniform(), v = (float(ray) + random.Uniform()) / kRays;
    const Vec3f local = CosineHemisphere(u, v);
    const Vec3f direction = Normalize(s * local.x + t * local.y + normal * local.z);
    const RayHit hit = filled.rays.Closest(middle, direction);
    if (hit.face < 0) {
      if (!filled.sources.Sky(direction).IsBlack()) return true;
      continue;
    }
    const Side met = Dot(mesh.VectorArea(hit.face), direction) < 0 ? kFront : kBack;
    if (filled.cache.IsLit(filled.cells.At(hit.face, hit.barycentric), met)) return true;
  }
  return false;
}

/// Per face, bit 1 where light reaches its front, bit 2 its back: where it reaches a cell there,
/// the side emits, or the face by itself finds light where its cells do not.
std::vector<uint8_t> LitSides(const FilledCache& filled, uint64_t seed, int64_t* cast) {
  const TriangleMesh& mesh = filled.scene.mesh;
  const DoubledFaces doubled(mesh);
  std::vector<uint8_t> lit(mesh.triangles.size(), 0);
  std::vector<uint8_t> castByFace(mesh.triangles.size(), 0);
  ParallelForEach(mesh.FaceCount(), 256, [&](int64_t face) {
    int64_t rays = 0;
    for (const Side side : {kFront, kBack}) {
      if (doubled.IsHidden(face, side)) continue;
      bool isLit = mesh.Emits(face, side) && !mesh.emittance[size_t(face)].IsBlack();
      bool isShared = false;
      filled.cells.ForEachCell(face, [&](int32_t cell) {
        isLit |= filled.cache.IsLit(cell, side);
        isShared |= filled.cells.IsShared(cell);
      });
      if (!isLit && isShared) isLit = FindsLight(filled, face, side, seed, &rays);
      if (isLit) lit[size_t(face)] |= uint8_t(1 << side);
    }
    castByFace[size_t(face)] = uint8_t(std::min<int64_t>(255, rays));
  });
  *cast += std::accumulate(castByFace.begin(), castByFace.end(), int64_t(0));
  return lit;
}

/// Hits nearer than this part of an element are followed further: a cell is too coarse for them.
constexpr double kNearby = 0.25;

/// The receivers, drawn into their elements.
std::vector<LightReceiver> GatherPoints(const UniformMesh& mesh, const UniformSolution& uniform,
                                        const RayScene& rays) {
  std::vector<LightReceiver> points(uniform.receivers.size());
  ParallelForEach(int64_t(points.size()), 1024, [&](int64_t i) {
    const ElementReceiver& at = uniform.receivers[size_t(i)];
    points[size_t(i)] = {DrawnInward(at.position, mesh.Centroid(at.element), rays), at.normal,
                         at.geometric};
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
  const double outputSize =
      options.outputSize == 0 ? elementSize : ResolveElementSize(scene, options.outputSize);

  // The light of the cells.
  const RayScene rays(scene.mesh);
  const SourceLight sources(scene, rays);
  const ElementCells cells(scene.mesh, elementSize);
  ElementCache cache(scene, rays, sources, cells, options.paths, options.seed);
  cache.Fill(ShareOf(progress, 0, 0.3));

  // The points, and their light.
  const UniformMesh mesh = MakeUniformMesh(scene, outputSize);
  int64_t cast = 0;
  UniformSolution uniform = MakeUniformSolution(
      scene, mesh, LitSides({scene, rays, sources, cells, cache}, options.seed, &cast));
  const std::vector<LightReceiver> points = GatherPoints(mesh, uniform, rays);
  CacheGatherOptions gather;
  gather.rays = options.gatherRays;
  gather.emitterRays = options.emitterRays;
  gather.nearby = kNearby * elementSize;
  gather.seed = HashBits(options.seed, 0x676174686572ull);
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
