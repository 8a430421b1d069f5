#include "Clustering/Core/VolumeClustering.h"

#include <gtest/gtest.h>

#include "Common/Core/Random.h"

namespace lambert {
namespace {

Box3f BoxAt(Vec3f low, Vec3f extent) {
  Box3f box;
  box.Include(low);
  box.Include(low + extent);
  return box;
}

std::vector<Box3f> RandomBoxes(uint64_t seed, int count, float extent) {
  Random random(seed);
  const auto vector = [&] { return Vec3f(random.Uniform(), random.Uniform(), random.Uniform()); };
  std::vector<Box3f> boxes;
  for (int i = 0; i < count; ++i) {
    const Vec3f low = vector();
    boxes.push_back(BoxAt(low, vector() * extent));
  }
  return boxes;
}

/// Checks every node and returns the depth.
int CheckTree(const std::vector<Box3f>& boxes, const std::vector<VolumeNode>& nodes) {
  EXPECT_EQ(nodes.size(), 2 * boxes.size() - 1);
  std::vector<int> seen(boxes.size(), 0), depth(nodes.size(), 0);
  EXPECT_EQ(nodes[0].parent, -1);
  for (size_t i = 0; i < nodes.size(); ++i) {
    const VolumeNode& node = nodes[i];
    if (i > 0) depth[i] = depth[size_t(node.parent)] + 1;
    if (node.child < 0) {
      EXPECT_EQ(node.itemCount, 1);
      EXPECT_EQ(++seen[size_t(node.item)], 1);
      EXPECT_EQ(node.bounds.low, boxes[size_t(node.item)].low);
      EXPECT_EQ(node.bounds.high, boxes[size_t(node.item)].high);
      continue;
    }
    EXPECT_EQ(node.item, -1);
    const VolumeNode &a = nodes[size_t(node.child)], &b = nodes[size_t(node.child) + 1];
    EXPECT_EQ(a.parent, int32_t(i));
    EXPECT_EQ(b.parent, int32_t(i));
    EXPECT_EQ(a.itemCount + b.itemCount, node.itemCount);
    EXPECT_EQ(Min(a.bounds.low, b.bounds.low), node.bounds.low);
    EXPECT_EQ(Max(a.bounds.high, b.bounds.high), node.bounds.high);
  }
  return *std::max_element(depth.begin(), depth.end());
}

TEST(VolumeClustering, OfNoneIsEmptyAndOfOneIsALeaf) {
  EXPECT_TRUE(ClusterVolumes({}).empty());
  const std::vector<Box3f> one = RandomBoxes(1, 1, 1);
  EXPECT_EQ(CheckTree(one, ClusterVolumes(one)), 0);
}

TEST(VolumeClustering, TreesHoldEveryBox) {
  for (uint64_t seed = 0; seed < 40; ++seed) {
    const std::vector<Box3f> boxes = RandomBoxes(seed, 2 + int(seed * 13), seed % 2 ? 0.05f : 1.f);
    CheckTree(boxes, ClusterVolumes(boxes));
  }
}

TEST(VolumeClustering, TakesTheCheapestSplit) {
  // Against trial of every split of the root along every axis.
  for (uint64_t seed = 0; seed < 40; ++seed) {
    const std::vector<Box3f> boxes = RandomBoxes(seed, 20, 0.3f);
    const std::vector<VolumeNode> nodes = ClusterVolumes(boxes);
    const auto cost = [](const Box3f& a, int na, const Box3f& b, int nb) {
      return double(a.SurfaceArea()) * na + double(b.SurfaceArea()) * nb;
    };
    double cheapest = 1e30;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<Box3f> sorted = boxes;
      std::stable_sort(sorted.begin(), sorted.end(), [&](const Box3f& a, const Box3f& b) {
        return a.low[axis] + a.high[axis] < b.low[axis] + b.high[axis];
      });
      for (int middle = 1; middle < 20; ++middle) {
        Box3f left, right;
        for (int i = 0; i < 20; ++i) (i < middle ? left : right).Include(sorted[size_t(i)]);
        cheapest = std::min(cheapest, cost(left, middle, right, 20 - middle));
      }
    }
    const VolumeNode &a = nodes[1], &b = nodes[2];
    EXPECT_DOUBLE_EQ(cost(a.bounds, a.itemCount, b.bounds, b.itemCount), cheapest);
  }
}

TEST(VolumeClustering, SeparatesTwoCrowds) {
  std::vector<Box3f> boxes = RandomBoxes(1, 50, 0.1f);
  for (size_t i = 0; i < 50; i += 2) boxes[i].low.x += 10, boxes[i].high.x += 10;
  const std::vector<VolumeNode> nodes = ClusterVolumes(boxes);
  EXPECT_EQ(nodes[1].itemCount, 25);
  EXPECT_LT(nodes[1].bounds.high.x, nodes[2].bounds.low.x);
}

TEST(VolumeClustering, BoxesAlikeAreHalved) {
  const std::vector<Box3f> same(1000, BoxAt({1, 2, 3}, {1, 1, 1}));
  EXPECT_EQ(CheckTree(same, ClusterVolumes(same)), 10);
  const std::vector<Box3f> points(1000, BoxAt({1, 2, 3}, {0, 0, 0}));
  EXPECT_EQ(CheckTree(points, ClusterVolumes(points)), 10);
}

TEST(VolumeClustering, ChainsAreBounded) {
  // Boxes in boxes: the cost would peel them off one by one.
  std::vector<Box3f> boxes;
  for (int i = 0; i < 5000; ++i) {
    const float half = std::pow(1.01f, float(i) * 0.5f);
    boxes.push_back(BoxAt(Vec3f(-half, -half, -half), Vec3f(2, 2, 2) * half));
  }
  // The budget of 4 ceil(log2 n) + 8 levels.
  EXPECT_LE(CheckTree(boxes, ClusterVolumes(boxes)), 4 * 13 + 8);
}

}  // namespace
}  // namespace lambert
