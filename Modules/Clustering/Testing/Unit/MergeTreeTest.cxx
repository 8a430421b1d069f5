#include "Clustering/Core/MergeTree.h"

#include <gtest/gtest.h>

#include "Common/Core/Random.h"

namespace lambert {
namespace {

/// Every leaf once, every merge once; returns the depth.
int CheckTree(const MergeTree& tree) {
  std::vector<int> seen(size_t(2 * tree.leafCount - 1), 0);
  std::vector<std::pair<int32_t, int>> stack{{tree.Root(), 0}};
  int deepest = 0;
  while (!stack.empty()) {
    const auto [node, depth] = stack.back();
    stack.pop_back();
    deepest = std::max(deepest, depth);
    EXPECT_EQ(++seen[size_t(node)], 1);
    if (tree.IsLeaf(node) || seen[size_t(node)] > 1) continue;
    for (const int32_t child : tree.Children(node)) stack.push_back({child, depth + 1});
  }
  for (const int count : seen) EXPECT_EQ(count, 1);
  return deepest;
}

Vec3f OnLine(int32_t leaf) { return {float(leaf), 0, 0}; }

TEST(MergeTree, ChainsAreRebuilt) {
  for (const int32_t leaves : {2, 3, 5, 17, 100, 3000, 50000}) {
    MergeTree tree{leaves, {}};
    tree.merges.push_back({0, 1});
    for (int32_t leaf = 2; leaf < leaves; ++leaf) tree.merges.push_back({leaf, leaves + leaf - 2});
    const int before = CheckTree(tree);
    const int64_t rebuilt = LimitDepth(&tree, OnLine);
    EXPECT_EQ(rebuilt > 0, before > DepthLimit(leaves));
    EXPECT_LE(CheckTree(tree), DepthLimit(leaves));
  }
}

TEST(MergeTree, ShallowTreesAreLeftAlone) {
  MergeTree tree{4, {{0, 1}, {2, 3}, {4, 5}}};
  const auto merges = tree.merges;
  EXPECT_EQ(LimitDepth(&tree, OnLine), 0);
  EXPECT_EQ(tree.merges, merges);
}

TEST(MergeTree, AnyTreeMeetsTheLimit) {
  // Merges of a random node with one of the latest: chains of chains.
  for (uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const int32_t leaves = 2 + int32_t(random.UniformDouble() * 2000);
    const double bias = random.UniformDouble() * random.UniformDouble() * random.UniformDouble();
    MergeTree tree{leaves, {}};
    std::vector<int32_t> loose;
    for (int32_t leaf = 0; leaf < leaves; ++leaf) loose.push_back(leaf);
    while (loose.size() > 1) {
      const auto take = [&](double fraction) {
        const size_t i = std::min(loose.size() - 1, size_t(fraction * double(loose.size())));
        const int32_t node = loose[i];
        loose.erase(loose.begin() + long(i));
        return node;
      };
      const int32_t a = take(1 - bias * random.UniformDouble());
      const int32_t b = take(random.UniformDouble());
      tree.merges.push_back({a, b});
      loose.push_back(leaves + int32_t(tree.merges.size()) - 1);
    }
    LimitDepth(&tree, OnLine);
    EXPECT_LE(CheckTree(tree), DepthLimit(leaves));
  }
}

}  // namespace
}  // namespace lambert
