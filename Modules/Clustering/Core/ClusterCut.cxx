#include "Clustering/Core/ClusterCut.h"

#include <algorithm>
#include <queue>

#include "Common/Core/Error.h"

namespace lambert {

std::vector<int32_t> CutAtLevel(const ClusterTree& tree, int32_t level) {
  if (level < 0)
    throw Error("The level of a cut is counted from the roots and cannot be negative.");
  std::vector<int32_t> cut;
  std::vector<std::pair<int32_t, int32_t>> stack;  // node, depth
  for (const int32_t root : tree.surfaceRoots) {
    stack.push_back({root, 0});
    while (!stack.empty()) {
      const auto [node, depth] = stack.back();
      stack.pop_back();
      const int32_t child = tree.nodes[size_t(node)].child;
      if (depth == level || child < 0) {
        cut.push_back(node);
      } else {
        stack.push_back({child + 1, depth + 1});
        stack.push_back({child, depth + 1});
      }
    }
  }
  return cut;
}

std::vector<int32_t> CutToCount(const ClusterTree& tree, int64_t count) {
  const auto isSmaller = [&](int32_t a, int32_t b) {
    const float areaA = tree.nodes[size_t(a)].area, areaB = tree.nodes[size_t(b)].area;
    return areaA != areaB ? areaA < areaB : a > b;
  };
  std::priority_queue<int32_t, std::vector<int32_t>, decltype(isSmaller)> splittable(isSmaller);
  std::vector<int32_t> cut;
  const auto add = [&](int32_t node) {
    if (tree.nodes[size_t(node)].child < 0) {
      cut.push_back(node);
    } else {
      splittable.push(node);
    }
  };
  for (const int32_t root : tree.surfaceRoots) add(root);
  while (!splittable.empty() && int64_t(cut.size() + splittable.size()) < count) {
    const int32_t child = tree.nodes[size_t(splittable.top())].child;
    splittable.pop();
    add(child);
    add(child + 1);
  }
  for (; !splittable.empty(); splittable.pop()) cut.push_back(splittable.top());
  std::sort(cut.begin(), cut.end(), [&](int32_t a, int32_t b) {
    return tree.nodes[size_t(a)].firstFace < tree.nodes[size_t(b)].firstFace;
  });
  return cut;
}

}  // namespace lambert
