// Where all of one patch sees all of another, or nothing: against rays between random points.
#include "Radiosity/Core/Shafts.h"

#include <gtest/gtest.h>

#include "Radiosity/Core/RefinementOracle.h"
#include "SolverScenes.h"

namespace lambert {
namespace {

/// Sixty random triangles, m, each a surface of its own with both sides modelled.
struct RandomTriangles : testing::ModelledScene {
  explicit RandomTriangles(uint64_t seed) {
    Random random(seed);
    for (int i = 0; i < 60; ++i) {
      const Vec3f at = testing::RandomVector(&random) * 3.f;
      testing::AddTriangle(&scene.mesh, at, at + testing::RandomVector(&random),
                           at + testing::RandomVector(&random), Spectrum(0.5f));
      scene.mesh.partId.back() = i;
    }
    this->Model();
  }

  /// Of segments between random points, each in front of the other's plane, those that something
  /// blocks, and all.
  std::array<int, 2> BlockedSegments(int32_t a, int32_t b) const {
    Random random(7);
    const Element &source = (*hierarchy)[a], &receiver = (*hierarchy)[b];
    int blocked = 0, all = 0;
    for (int i = 0; i < 100; ++i) {
      const Vec3f from = hierarchy->PlaceOn(a, &random).at.position;
      const Vec3f to = hierarchy->PlaceOn(b, &random).at.position;
      // Rays that graze their own ends meet them by rounding.
      const Vec3f way = Normalize(to - from);
      if (Dot(way, source.axis) < 0.01f || -Dot(way, receiver.axis) < 0.01f) continue;
      ++all;
      blocked += rayScene->Occluded(from, to) ? 1 : 0;
    }
    return {blocked, all};
  }
};

TEST(Shafts, WhatIsCertainHoldsForEverySegment) {
  int clear = 0, blocked = 0;
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    const RandomTriangles triangles(seed);
    const Shafts shafts(*triangles.hierarchy, *triangles.rayScene);
    const std::vector<int32_t>& sides = triangles.hierarchy->SurfaceSides();
    for (const int32_t a : sides) {
      for (const int32_t b : sides) {
        const Element &source = (*triangles.hierarchy)[a], &receiver = (*triangles.hierarchy)[b];
        const bool isClear = shafts.IsClear(source, receiver);
        const bool isBlocked = shafts.IsBlocked(source, receiver);
        if (!isClear && !isBlocked) continue;
        const auto [hidden, all] = triangles.BlockedSegments(a, b);
        if (all == 0) continue;
        if (isClear) {
          EXPECT_EQ(hidden, 0) << seed << ": " << a << " " << b;
        }
        if (isBlocked) {
          EXPECT_EQ(hidden, all) << seed << ": " << a << " " << b;
        }
        clear += isClear ? 1 : 0;
        blocked += isBlocked ? 1 : 0;
      }
    }
  }
  EXPECT_GT(clear, 100);
  EXPECT_GT(blocked, 10);
}

TEST(Shafts, WallsOfARoomSeeEachOther) {
  // Neighbours touch the shaft between two of its triangles, and do not block it.
  Scene scene;
  testing::AddBox(&scene.mesh, {0, 0, 0}, {1, 1, 1}, testing::BoxMaterials(0.5f), true);
  testing::CompleteTables(&scene);
  scene.mesh.Complete();
  const ClusterTree tree = ClusterFaces(&scene.mesh, scene.parts);
  const RayScene rayScene(scene.mesh);
  const std::vector<uint8_t> inside(tree.surfaceRoots.size(), 1);
  const ElementHierarchy hierarchy(scene, tree, inside, {});
  const Shafts shafts(hierarchy, rayScene);
  int pairs = 0;
  for (const int32_t a : hierarchy.SurfaceSides()) {
    for (const int32_t b : hierarchy.SurfaceSides()) {
      const Element &source = hierarchy[a], &receiver = hierarchy[b];
      if (BoundPair(hierarchy, source, receiver).apart) continue;
      ++pairs;
      EXPECT_TRUE(shafts.IsClear(source, receiver)) << a << " " << b;
      EXPECT_FALSE(shafts.IsBlocked(source, receiver)) << a << " " << b;
    }
  }
  EXPECT_GE(pairs, 30);
}

}  // namespace
}  // namespace lambert
