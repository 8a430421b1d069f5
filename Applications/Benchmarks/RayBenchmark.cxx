// What a ray costs: prints rays a second of one thread, by Embree and through the clusters
// themselves, for bounces from the surfaces of a scene and for segments between them.
//   lambert-ray-benchmark SCENE [RAYS]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "ClusterRays.h"
#include "Clustering/Core/FaceClustering.h"
#include "Common/Core/Error.h"
#include "Common/Core/Random.h"
#include "Common/Core/Timer.h"
#include "Scene/vtkSceneLoader.h"
#include "Visibility/Core/RayScene.h"

namespace lambert {
namespace {

struct Ray {
  Vec3f from, direction;
  float length;  ///< m; infinite for bounces
};

/// Places by area, on the front of their faces.
class Places {
 public:
  explicit Places(const TriangleMesh& mesh) : mesh_(mesh), sums_(mesh.triangles.size()) {
    double sum = 0;
    for (size_t face = 0; face < sums_.size(); ++face) {
      sums_[face] = sum += double(mesh.Area(int64_t(face)));
    }
  }
  Vec3f Pick(Random* random, Vec3f* normal) const {
    const double wanted = random->UniformDouble() * sums_.back();
    const auto face =
        std::min<int64_t>(int64_t(sums_.size()) - 1,
                          std::lower_bound(sums_.begin(), sums_.end(), wanted) - sums_.begin());
    *normal = mesh_.FrontNormal(face);
    const Vec2f b = UniformTriangle(random->Uniform(), random->Uniform());
    return PlaceOnTriangle(mesh_.Corner(face, 0), mesh_.Corner(face, 1), mesh_.Corner(face, 2), b);
  }

 private:
  const TriangleMesh& mesh_;
  std::vector<double> sums_;
};

std::vector<Ray> MakeRays(const TriangleMesh& mesh, int count, bool areSegments) {
  constexpr int kMostMisses = 1000;
  const Places places(mesh);
  Random random(1);
  int misses = 0;
  std::vector<Ray> rays;
  while (int(rays.size()) < count) {
    Vec3f normal, other;
    const Vec3f from = places.Pick(&random, &normal);
    if (areSegments) {
      const Vec3f offset = places.Pick(&random, &other) - from;
      if (!(Length(offset) > 0)) {
        if (++misses > kMostMisses) throw Error("All faces of the scene lie in one point.");
        continue;
      }
      misses = 0;
      rays.push_back({from, Normalize(offset), Length(offset)});
      continue;
    }
    Vec3f u, v;
    CoordinateSystem(normal, &u, &v);
    const Vec3f d = CosineHemisphere(random.Uniform(), random.Uniform());
    rays.push_back(
        {from, u * d.x + v * d.y + normal * d.z, std::numeric_limits<float>::infinity()});
  }
  return rays;
}

/// Million rays a second, and the sum of what they met.
template <class Cast>
void Measure(const char* name, const std::vector<Ray>& rays, const Cast& cast) {
  double best = std::numeric_limits<double>::infinity();
  int64_t met = 0;
  for (int run = 0; run < 3; ++run) {
    const Timer timer;
    met = 0;
    for (const Ray& ray : rays) met += cast(ray);
    best = std::min(best, timer.Seconds());
  }
  std::printf("  %-28s %8.3f M/s, %lld met\n", name, double(rays.size()) / best / 1e6,
              static_cast<long long>(met));
}

void Run(const std::string& fileName, int count) {
  Scene scene = LoadScene({fileName});
  const ClusterTree tree = ClusterFaces(&scene.mesh, scene.parts);
  Timer timer;
  const RayScene embree(scene.mesh);
  std::printf("%s: %lld faces; Embree's tree %.3f s\n", fileName.c_str(),
              static_cast<long long>(scene.mesh.FaceCount()), timer.Seconds());
  constexpr int kFacesOfLeaf = 4;
  timer.Restart();
  const ClusterRays aligned(scene.mesh, tree, ClusterRays::Boxes::AxisAligned, kFacesOfLeaf);
  std::printf("array of boxes %.3f s, %.1f MB; ", timer.Seconds(), double(aligned.Bytes()) / 1e6);
  timer.Restart();
  const ClusterRays oriented(scene.mesh, tree, ClusterRays::Boxes::Oriented, kFacesOfLeaf);
  std::printf("of oriented ones %.3f s, %.1f MB\n", timer.Seconds(),
              double(oriented.Bytes()) / 1e6);

  const float skip = embree.Epsilon();
  std::printf("bounces\n");
  const std::vector<Ray> bounces = MakeRays(scene.mesh, count, false);
  Measure("Embree", bounces,
          [&](const Ray& r) { return embree.Closest(r.from, r.direction).face >= 0; });
  for (const auto& [name, rays] : {std::pair("boxes of clusters", &aligned),
                                   std::pair("oriented boxes of clusters", &oriented)}) {
    const ClusterRays& clusters = *rays;
    Measure(name, bounces, [&](const Ray& r) {
      return clusters.Closest(r.from, r.direction, skip, r.length) >= 0;
    });
  }
  std::printf("segments\n");
  const std::vector<Ray> segments = MakeRays(scene.mesh, count, true);
  Measure("Embree", segments,
          [&](const Ray& r) { return embree.Occluded(r.from, r.direction, r.length); });
  for (const auto& [name, rays] : {std::pair("boxes of clusters", &aligned),
                                   std::pair("oriented boxes of clusters", &oriented)}) {
    const ClusterRays& clusters = *rays;
    Measure(name, segments, [&](const Ray& r) {
      return clusters.Occluded(r.from, r.direction, skip, r.length - skip);
    });
  }
}

}  // namespace
}  // namespace lambert

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "lambert-ray-benchmark SCENE [RAYS]\n");
    return 2;
  }
  try {
    constexpr int kRays = 200000;
    lambert::Run(argv[1], argc > 2 ? std::max(1, std::atoi(argv[2])) : kRays);
  } catch (const lambert::Error& error) {
    std::fprintf(stderr, "lambert-ray-benchmark: %s\n", error.what());
    return 1;
  }
  return 0;
}
