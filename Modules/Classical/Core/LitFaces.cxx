#include "Classical/Core/LitFaces.h"

#include <algorithm>

#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"

namespace lambert {

namespace {

constexpr int kRaysPerElement = 8;
constexpr int kRaysPerSide = 64;

/// What the rays of one side of a face met.
struct FaceView {
  std::vector<int32_t> seen;  ///< sides, 2 x face + side; sorted, unique
  bool seesLight = false;     ///< a light without geometry, or the sky
  int64_t rays = 0;
};

bool SeesLamp(const Scene& scene, const RayScene& rayScene, const Vec3f& x, const Vec3f& n) {
  for (const Light& light : scene.lights) {
    if (light.type == LightType::Sky || light.intensity.IsBlack()) continue;
    const bool isFar = light.type == LightType::Directional;
    const Vec3f toward = isFar ? -light.direction : light.position - x;
    if (Dot(toward, n) <= 0 || light.ConeFactor(-Normalize(toward)) <= 0) continue;
    const bool blocked =
        isFar ? rayScene.OccludedDirection(x, toward) : rayScene.Occluded(x, light.position);
    if (!blocked) return true;
  }
  return false;
}

/// Elements [begin, end) of one face look around from one of its sides.
FaceView LookAround(const Scene& scene, const UniformMesh& mesh, int64_t begin, int64_t end,
                    Side side, const RayScene& rayScene, bool hasSky) {
  FaceView view;
  const int64_t elements = end - begin;
  const int rays = int(std::max<int64_t>(kRaysPerElement, kRaysPerSide / elements));
  for (int64_t element = begin; element < end; ++element) {
    Random random(HashBits(uint64_t(element), uint64_t(side)));
    const Vec3f n = Normalize(mesh.VectorArea(element)) * (side == kBack ? -1.f : 1.f);
    if (n == Vec3f()) continue;
    Vec3f u, v;
    CoordinateSystem(n, &u, &v);
    for (int ray = 0; ray < rays; ++ray) {
      const Vec2f b = UniformTriangle(random.Uniform(), random.Uniform());
      const Vec3f& p = mesh.Corner(element, 0);
      const Vec3f x = p + (mesh.Corner(element, 1) - p) * b.x + (mesh.Corner(element, 2) - p) * b.y;
      const Vec3f d = CosineHemisphere(random.Uniform(), random.Uniform());
      const Vec3f direction = u * d.x + v * d.y + n * d.z;
      ++view.rays;
      view.seesLight = view.seesLight || SeesLamp(scene, rayScene, x, n);
      const RayHit hit = rayScene.Closest(x, direction);
      if (hit.face < 0) {
        view.seesLight = view.seesLight || hasSky;
        continue;
      }
      const bool fromFront = Dot(direction, scene.mesh.VectorArea(hit.face)) < 0;
      view.seen.push_back(2 * hit.face + (fromFront ? kFront : kBack));
    }
  }
  std::sort(view.seen.begin(), view.seen.end());
  view.seen.erase(std::unique(view.seen.begin(), view.seen.end()), view.seen.end());
  return view;
}

/// First element of each face, and one more at the end.
std::vector<int64_t> FirstElements(const UniformMesh& mesh, int64_t faces) {
  std::vector<int64_t> first(size_t(faces) + 1, 0);
  for (const int32_t face : mesh.face) ++first[size_t(face) + 1];
  for (size_t face = 0; face < size_t(faces); ++face) first[face + 1] += first[face];
  return first;
}

}  // namespace

std::vector<uint8_t> FindLitFaces(const Scene& scene, const UniformMesh& mesh,
                                  const RayScene& rayScene, int64_t* rays) {
  // Every side looks around.
  const int64_t faces = scene.mesh.FaceCount();
  const bool hasSky = std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& l) {
    return l.type == LightType::Sky && !l.intensity.IsBlack();
  });
  const std::vector<int64_t> first = FirstElements(mesh, faces);
  std::vector<FaceView> views(static_cast<size_t>(2 * faces));
  ParallelForEach(2 * faces, 1, [&](int64_t i) {
    const size_t face = size_t(i / 2);
    views[size_t(i)] =
        LookAround(scene, mesh, first[face], first[face + 1], Side(i % 2), rayScene, hasSky);
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
  std::vector<uint8_t> lit(static_cast<size_t>(faces), 0);
  std::vector<int32_t> spreading;
  const auto light = [&](int32_t i) {
    const uint8_t bit = uint8_t(1 << (i % 2));
    if (lit[size_t(i / 2)] & bit) return;
    lit[size_t(i / 2)] |= bit;
    spreading.push_back(i);
  };
  for (int32_t i = 0; i < int32_t(views.size()); ++i) {
    const bool emits =
        scene.mesh.Emits(i / 2, Side(i % 2)) && !scene.mesh.emittance[size_t(i / 2)].IsBlack();
    if (emits || views[size_t(i)].seesLight) light(i);
  }
  while (!spreading.empty()) {
    const int32_t i = spreading.back();
    spreading.pop_back();
    for (const int32_t j : neighbours[size_t(i)]) light(j);
  }
  return lit;
}

}  // namespace lambert
