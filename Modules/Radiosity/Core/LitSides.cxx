#include "Radiosity/Core/LitSides.h"

#include <algorithm>

#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"
#include "Scene/Core/DoubledFaces.h"
#include "Scene/Core/LightSource.h"
#include "Visibility/Core/EmitterTree.h"

namespace lambert {

namespace {

constexpr int kRaysPerSide = 64;
/// Large surfaces get more rays: one to this many faces.
constexpr int kFacesPerRay = 64;
constexpr int kMaximumRaysPerSide = 4096;

/// What the rays of one side met.
struct SideView {
  std::vector<int32_t> seen;  ///< sides, 2 x surface + side; sorted, unique
  bool seesLight = false;     ///< a light without geometry, or the sky
  int64_t rays = 0;
};

/// Whether a ray leaves a surface without passing what is nearer than rays skip: through the next
/// facet of one that is finely curved it would find what lies on its other side. What covers the
/// place as a whole is passed.
bool LeavesFreely(const RayScene& rayScene, const RayStart& from, const Vec3f& direction) {
  return !rayScene.OccludedNear(from, direction) || rayScene.OccludedNear(from, from.normal);
}

bool SeesLight(const LightSources& lights, const RayScene& rayScene, const RayStart& from) {
  const auto isOpen = [&](const LightSample& sample) {
    return !rayScene.Occluded(from, sample.direction, sample.distance) &&
           LeavesFreely(rayScene, from, sample.direction);
  };
  const auto& [x, n] = from;
  return !lights.Irradiance({x, n, n}, 1, SeedOfPlace(x), isOpen).IsBlack();
}

/// The emitting side, 2 x surface + side, of an emitter that is seen from a place; -1 where the one
/// that is picked is not. Finds lamps that are too small for rays in all directions.
int32_t SeenEmitter(const TriangleMesh& mesh, const RayScene& rayScene, const EmitterTree& emitters,
                    const RayStart& from, Random* random) {
  const auto& [x, n] = from;
  const double u[3] = {random->UniformDouble(), random->UniformDouble(), random->UniformDouble()};
  const EmitterTree::Sample sample = emitters.Pick(x, n, u);
  if (sample.face < 0 || !(sample.density > 0) || Dot(n, sample.direction) <= 0) return -1;
  const Side side = Dot(mesh.VectorArea(sample.face), sample.direction) < 0 ? kFront : kBack;
  if (!mesh.Emits(sample.face, side)) return -1;
  if (rayScene.Occluded(from, x + sample.direction * sample.distance)) return -1;
  if (!LeavesFreely(rayScene, from, sample.direction)) return -1;
  return 2 * mesh.surfaceId[size_t(sample.face)] + side;
}

SideView LookAround(const Scene& scene, const ClusterNode& root, int32_t side,
                    const RayScene& rayScene, const EmitterTree& emitters,
                    const LightSources& lights) {
  const TriangleMesh& mesh = scene.mesh;
  SideView view;
  int32_t emitter = -1;
  const int rays =
      std::min(kMaximumRaysPerSide, std::max(kRaysPerSide, root.faceCount / kFacesPerRay));
  Random random(HashBits(uint64_t(root.firstFace), uint64_t(side)));
  for (int ray = 0; ray < rays; ++ray) {
    // Half the places by face, half of them by rank along the tree: slivers and large faces both
    // get some.
    const int64_t face =
        root.firstFace +
        std::min<int64_t>(root.faceCount - 1,
                          int64_t((ray + random.UniformDouble()) / rays * root.faceCount));
    Vec3f n = mesh.FrontNormal(face);
    if (n == Vec3f()) continue;
    if (side == kBack) n = -n;
    const Vec2f b = UniformTriangle(random.Uniform(), random.Uniform());
    const RayStart from = {
        PlaceOnTriangle(mesh.Corner(face, 0), mesh.Corner(face, 1), mesh.Corner(face, 2), b), n};
    Vec3f u, v;
    CoordinateSystem(n, &u, &v);
    const Vec3f d = CosineHemisphere(random.Uniform(), random.Uniform());
    const Vec3f direction = u * d.x + v * d.y + n * d.z;
    ++view.rays;
    view.seesLight = view.seesLight || SeesLight(lights, rayScene, from);
    if (!view.seesLight && emitter < 0 && !emitters.IsEmpty()) {
      ++view.rays;
      emitter = SeenEmitter(mesh, rayScene, emitters, from, &random);
    }
    if (!LeavesFreely(rayScene, from, direction)) continue;
    const RayHit hit = rayScene.Closest(from, direction);
    if (hit.face < 0) {
      view.seesLight = view.seesLight || !lights.Radiance(direction).IsBlack();
      continue;
    }
    const bool fromFront = Dot(direction, mesh.VectorArea(hit.face)) < 0;
    view.seen.push_back(2 * mesh.surfaceId[size_t(hit.face)] + (fromFront ? kFront : kBack));
  }
  if (emitter >= 0) view.seen.push_back(emitter);
  std::sort(view.seen.begin(), view.seen.end());
  view.seen.erase(std::unique(view.seen.begin(), view.seen.end()), view.seen.end());
  return view;
}

/// Whether all of a side lies under the fronts of doubled faces.
bool IsHidden(const DoubledFaces& doubled, const ClusterNode& root, Side side) {
  if (doubled.IsEmpty()) return false;
  for (int32_t face = root.firstFace; face < root.firstFace + root.faceCount; ++face) {
    if (!doubled.IsHidden(face, side)) return false;
  }
  return true;
}

bool SideEmits(const TriangleMesh& mesh, const ClusterNode& root, Side side) {
  for (int32_t face = root.firstFace; face < root.firstFace + root.faceCount; ++face) {
    if (mesh.Emits(face, side) && !mesh.emittance[size_t(face)].IsBlack()) return true;
  }
  return false;
}

}  // namespace

std::vector<uint8_t> FindLitSides(const Scene& scene, const ClusterTree& tree,
                                  const RayScene& rayScene, int64_t* rays) {
  // Every side looks around.
  const int64_t surfaces = int64_t(tree.surfaceRoots.size());
  const LightSources lights(scene.lights);
  const EmitterTree emitters(scene.mesh);
  const DoubledFaces doubled(scene.mesh);
  std::vector<SideView> views(static_cast<size_t>(2 * surfaces));
  ParallelForEach(2 * surfaces, 4, [&](int64_t i) {
    const ClusterNode& root = tree.nodes[size_t(tree.surfaceRoots[size_t(i / 2)])];
    if (IsHidden(doubled, root, Side(i % 2))) return;
    views[size_t(i)] = LookAround(scene, root, int32_t(i % 2), rayScene, emitters, lights);
  });

  // Seeing is mutual.
  std::vector<std::vector<int32_t>> neighbours(views.size());
  for (size_t i = 0; i < views.size(); ++i) {
    *rays += views[i].rays;
    for (const int32_t j : views[i].seen) {
      neighbours[i].push_back(j);
      neighbours[size_t(j)].push_back(int32_t(i));
    }
  }

  // Light spreads from the sources.
  std::vector<uint8_t> lit(views.size(), 0);
  std::vector<int32_t> front;
  for (int32_t i = 0; i < int32_t(views.size()); ++i) {
    const ClusterNode& root = tree.nodes[size_t(tree.surfaceRoots[size_t(i / 2)])];
    if (views[size_t(i)].seesLight || SideEmits(scene.mesh, root, Side(i % 2))) front.push_back(i);
  }
  for (const int32_t i : front) lit[size_t(i)] = 1;
  while (!front.empty()) {
    const int32_t i = front.back();
    front.pop_back();
    for (const int32_t j : neighbours[size_t(i)]) {
      if (lit[size_t(j)]) continue;
      lit[size_t(j)] = 1;
      front.push_back(j);
    }
  }
  std::vector<uint8_t> litSides(static_cast<size_t>(surfaces));
  for (size_t s = 0; s < litSides.size(); ++s) {
    litSides[s] = uint8_t(lit[2 * s] | (lit[2 * s + 1] << 1));
  }
  return litSides;
}

}  // namespace lambert
