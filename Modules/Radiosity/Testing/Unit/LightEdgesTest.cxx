// Where the edge of a shadow is found along a segment.
#include "Radiosity/Core/LightEdges.h"

#include <gtest/gtest.h>

#include "Clustering/Core/FaceClustering.h"
#include "Common/Testing/TestScenes.h"
#include "Radiosity/Core/ElementHierarchy.h"

namespace lambert {
namespace {

/// A black floor [0, 1]^2, a lamp of `side` m over its middle at 2 m, and at 1 m a screen over all
/// x above 0.5. Straight below its edge half of the lamp is hidden.
struct ScreenedFloor {
  Scene scene;
  std::vector<LightEdge> edges;

  explicit ScreenedFloor(float side) {
    testing::AddQuad(&scene.mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.f));
    testing::AddQuad(&scene.mesh, {0.5f - side / 2, 0.5f - side / 2, 2}, {0, side, 0}, {side, 0, 0},
                     Spectrum(0.f), Spectrum(1.f), 1, 1);
    testing::AddQuad(&scene.mesh, {0.5f, -9, 1}, {9, 0, 0}, {0, 20, 0}, Spectrum(0.f),
                     Spectrum(0.f), 1, 2);
    testing::CompleteTables(&scene);
    scene.mesh.Complete();
    const ClusterTree tree = ClusterFaces(&scene.mesh, scene.parts);
    const RayScene rayScene(scene.mesh);
    const ElementHierarchy hierarchy(scene, tree, std::vector<uint8_t>(tree.surfaceRoots.size(), 3),
                                     {});
    ElementLight light;
    light.Grow(hierarchy);
    const FinalGather gather(hierarchy, rayScene, &light);

    // Across the edge, and the same turned round. The first middle is not the shadow's edge itself.
    const auto at = [](float x, float y) { return GatherPoint{{x, y, 0}, {0, 0, 1}, {0, 0, 1}}; };
    const auto lightAt = [&](const GatherPoint& point) {
      int64_t rays = 0;
      return gather.Direct().Sample(point, 256, 1, &rays).irradiance;
    };
    std::vector<LitSegment> segments;
    for (const auto& [a, b] :
         {std::pair(at(0.1f, 0.5f), at(0.83f, 0.5f)), std::pair(at(0.83f, 0.5f), at(0.1f, 0.5f))}) {
      segments.push_back({a, b, lightAt(a), lightAt(b), 5});
    }
    int64_t rays = 0;
    edges = FindLightEdges(gather, segments, 1, &rays);
    EXPECT_GT(rays, 0);
  }
};

TEST(LightEdges, ASmallLampsShadowIsFoundToTheLastStep) {
  // The shadow's edge lies at x = 0.5 and is as wide as the lamp, 4 mm.
  const std::vector<LightEdge> edges = ScreenedFloor(0.004f).edges;
  const float places[2] = {(0.5f - 0.1f) / 0.73f, (0.83f - 0.5f) / 0.73f};
  for (const int i : {0, 1}) {
    EXPECT_LE(edges[size_t(i)].low, places[i] + 0.005f);
    EXPECT_GE(edges[size_t(i)].high, places[i] - 0.005f);
    EXPECT_FLOAT_EQ(edges[size_t(i)].high - edges[size_t(i)].low, 1.f / 32);
  }
}

TEST(LightEdges, APenumbraIsKeptWhole) {
  // 0.4 m wide, across 0.73 m: three quarters of the change lie in no half of it.
  const std::vector<LightEdge> edges = ScreenedFloor(0.4f).edges;
  for (const int i : {0, 1}) EXPECT_GE(edges[size_t(i)].high - edges[size_t(i)].low, 0.5f);
}

}  // namespace
}  // namespace lambert
