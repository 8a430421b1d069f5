// Laws that hold for every scene, on seeded heaps of triangles as bad as real files hold them.
#include <gtest/gtest.h>

#include <cmath>

#include "Common/Core/Parallel.h"
#include "SolverScenes.h"

namespace lambert {
namespace {

using testing::RandomVector;
using testing::SolvedScene;
using testing::SolveScene;

Vec3f Centered(Random* random) { return RandomVector(random) * 2.f - Vec3f(1, 1, 1); }

/// 100 to 300 triangles about the origin: loose ones that cross, ones that touch the last at an
/// edge, ones nearly parallel to it, and slivers; every tenth emits. Odd seeds have a closed room
/// around them.
Scene Heap(uint64_t seed) {
  Scene scene;
  TriangleMesh& mesh = scene.mesh;
  Random random(seed);
  const int count = 100 + int(random.Bits() % 200);
  Vec3f a, b, c;
  for (int i = 0; i < count; ++i) {
    const uint64_t kind = i == 0 ? 0 : random.Bits() % 4;
    if (kind == 0) {
      a = Centered(&random), b = a + Centered(&random) * 0.5f, c = a + Centered(&random) * 0.5f;
    } else if (kind == 1) {  // touches the last
      c = a + Centered(&random) * 0.5f;
    } else if (kind == 2) {  // nearly parallel to the last, and near it
      const Vec3f n = Normalize(Cross(b - a, c - a)) * (0.002f + 0.02f * random.Uniform());
      a += n + Centered(&random) * 1e-3f, b += n, c += n;
    } else {  // a sliver
      a = Centered(&random), b = a + Centered(&random);
      c = a + (b - a) * random.Uniform() + Centered(&random) * 1e-3f;
    }
    const Spectrum reflectance = Spectrum(RandomVector(&random).x, random.Uniform(), 0.5f) * 0.9f;
    const bool emits = i % 10 == 0;
    testing::AddTriangle(&mesh, a, b, c, reflectance, Spectrum(emits ? 5.f * random.Uniform() : 0));
  }
  if (seed % 2) {
    testing::AddBox(&mesh, {-2, -2, -2}, {2, 2, 2}, testing::BoxMaterials(0.6f), true, 1, 1);
  }
  testing::CompleteTables(&scene);
  return scene;
}

class HeapTest : public ::testing::TestWithParam<int> {};

TEST_P(HeapTest, ObeysTheLaws) {
  SetThreadCount(1);
  const SolvedScene one = SolveScene(Heap(uint64_t(GetParam())), 0.8);
  SetThreadCount(2);
  const SolvedScene two = SolveScene(Heap(uint64_t(GetParam())), 0.8);
  SetThreadCount(0);

  // The same bits for one thread and two.
  ASSERT_EQ(one.solution.irradiance.size(), two.solution.irradiance.size());
  EXPECT_TRUE(one.solution.irradiance == two.solution.irradiance);
  EXPECT_TRUE(one.solution.radiosity == two.solution.radiosity);
  EXPECT_TRUE(one.solution.mesh.triangles == two.solution.mesh.triangles);
  EXPECT_EQ(one.statistics.rays, two.statistics.rays);
  EXPECT_EQ(one.statistics.absorbed, two.statistics.absorbed);

  // No place is brighter than a furnace of the brightest emitter and the lightest surface, of any
  // band: rounding apart.
  const TriangleMesh& mesh = one.scene.mesh;
  Spectrum exitance, reflectance;
  for (size_t face = 0; face < mesh.triangles.size(); ++face) {
    for (int band = 0; band < 3; ++band) {
      exitance[band] = std::max(exitance[band], mesh.emittance[face][band]);
      reflectance[band] = std::max(reflectance[band], mesh.reflectance[face][band]);
    }
  }
  for (const Spectrum& e : one.solution.irradiance) {
    ASSERT_TRUE(e.IsFinite());
    for (int band = 0; band < 3; ++band) {
      ASSERT_GE(e[band], 0);
      ASSERT_LE(e[band], 1.0001f * exitance[band] / (1 - reflectance[band]));
    }
  }
  for (const Spectrum& b : one.solution.radiosity) {
    ASSERT_TRUE(b.IsFinite());
    for (int band = 0; band < 3; ++band) ASSERT_GE(b[band], 0);
  }

  const SolverStatistics& s = one.statistics;
  for (int band = 0; band < 3; ++band) ASSERT_GT(s.emitted[band], 0);
}
INSTANTIATE_TEST_SUITE_P(Seeds, HeapTest, ::testing::Range(1, 21));

// Light goes somewhere, in closed heaps and in open ones. At a request of 0.2 a closed heap of
// crossing and touching triangles loses up to 5 % of it; the loss falls with the request (seed
// 7: 4.8, 3.7 and 1.8 % at 0.2, 0.1 and 0.05). Escape is found by 32768 rays: three standard
// deviations are under 1 %.
class HeapEnergyTest : public ::testing::TestWithParam<int> {};

TEST_P(HeapEnergyTest, IsKept) {
  const SolverStatistics s = SolveScene(Heap(uint64_t(GetParam())), 0.2).statistics;
  for (int band = 0; band < 3; ++band) {
    ASSERT_GT(s.emitted[band], 0);
    EXPECT_NEAR((s.absorbed[band] + s.escaped[band]) / s.emitted[band], 1, 0.05 + 0.01);
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, HeapEnergyTest, ::testing::Range(1, 9));

}  // namespace
}  // namespace lambert
