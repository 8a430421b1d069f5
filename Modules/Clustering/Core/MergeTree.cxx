#include "Clustering/Core/MergeTree.h"

#include <algorithm>
#include <cmath>

namespace lambert {

namespace {

class DepthLimiter {
 public:
  DepthLimiter(MergeTree* tree, const std::function<Vec3f(int32_t)>& leafCenter) : tree_(*tree) {
    MeasureNodes(leafCenter);
  }

  int32_t Height() const { return height_[size_t(tree_.Root())]; }

  /// A node of n leaves is granted 3 log2 n + 2 levels. Pieces that leave a heavy path hold at most
  /// half of its leaves and hang at most log2(n / n_piece) + 2 levels down in the bisection, which
  /// leaves each of them its own grant.
  int64_t Limit(int32_t levels) {
    todo_.push_back({tree_.Root(), levels});
    int64_t rebuilt = 0;
    while (!todo_.empty()) {
      const Task task = todo_.back();
      todo_.pop_back();
      if (height_[size_t(task.node)] <= task.levels) continue;
      TakeChainApart(task);
      rebuilt += int64_t(joints_.size());
      JoinByBisection(task.node, task.levels);
    }
    return rebuilt;
  }

 private:
  struct Task {
    int32_t node, levels;
  };

  void MeasureNodes(const std::function<Vec3f(int32_t)>& leafCenter) {
    const size_t nodes = size_t(2 * tree_.leafCount - 1);
    height_.assign(nodes, 0);
    leaves_.assign(nodes, 1);
    center_.resize(nodes);
    for (int32_t node = 0; node < tree_.leafCount; ++node) center_[size_t(node)] = leafCenter(node);
    for (int32_t node = tree_.leafCount; node <= tree_.Root(); ++node) {
      const auto [a, b] = tree_.Children(node);
      const size_t n = size_t(node), first = size_t(a), second = size_t(b);
      height_[n] = 1 + std::max(height_[first], height_[second]);
      leaves_[n] = leaves_[first] + leaves_[second];
      const float weight = float(leaves_[first]) / float(leaves_[n]);
      center_[n] = center_[first] * weight + center_[second] * (1 - weight);
    }
  }

  /// Follows the heavier child down until what is left fits; collects what branched off, and the
  /// joints between.
  void TakeChainApart(const Task& task) {
    pieces_.clear();
    joints_.clear();
    int32_t node = task.node;
    const auto fits = [&](int32_t piece) {
      const double ratio = double(leaves_[size_t(task.node)]) / leaves_[size_t(piece)];
      return height_[size_t(piece)] + int32_t(std::ceil(std::log2(ratio))) + 2 <= task.levels;
    };
    while (!tree_.IsLeaf(node) && (node == task.node || !fits(node))) {
      auto [heavy, light] = tree_.Children(node);
      if (leaves_[size_t(heavy)] < leaves_[size_t(light)]) std::swap(heavy, light);
      joints_.push_back(node);
      pieces_.push_back(light);
      node = heavy;
    }
    pieces_.push_back(node);
  }

  struct Range {
    size_t begin, end;
    int32_t joint, levels;
  };

  void JoinByBisection(int32_t root, int32_t levels) {
    size_t nextJoint = 1;  // joints_[0] is the root, which the parent knows
    ranges_.push_back({0, pieces_.size(), root, levels});
    while (!ranges_.empty()) {
      const Range range = ranges_.back();
      ranges_.pop_back();
      const size_t middle = SplitEvenly(range.begin, range.end);
      auto& children = tree_.merges[size_t(range.joint - tree_.leafCount)];
      const std::array<size_t, 3> ends{range.begin, middle, range.end};
      for (size_t side = 0; side < 2; ++side) {
        const size_t begin = ends[side], end = ends[side + 1];
        if (end - begin == 1) {
          children[side] = pieces_[begin];
          todo_.push_back({pieces_[begin], range.levels - 1});
        } else {
          children[side] = joints_[nextJoint++];
          ranges_.push_back({begin, end, children[side], range.levels - 1});
        }
      }
    }
  }

  /// Sorts the pieces [begin, end) along the longest side of their box; where they part into equal
  /// weights.
  size_t SplitEvenly(size_t begin, size_t end) {
    Box3f box;
    for (size_t i = begin; i < end; ++i) box.Include(center_[size_t(pieces_[i])]);
    const Vec3f extent = box.Extent();
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                     : extent.y >= extent.z                       ? 1
                                                                  : 2;
    std::sort(pieces_.begin() + long(begin), pieces_.begin() + long(end),
              [&](int32_t a, int32_t b) {
                const float x = center_[size_t(a)][axis], y = center_[size_t(b)][axis];
                return x != y ? x < y : a < b;
              });
    int64_t total = 0;
    for (size_t i = begin; i < end; ++i) total += leaves_[size_t(pieces_[i])];
    size_t middle = begin + 1;
    int64_t left = leaves_[size_t(pieces_[begin])];
    while (middle + 1 < end && std::abs(2 * (left + leaves_[size_t(pieces_[middle])]) - total) <=
                                   std::abs(2 * left - total)) {
      left += leaves_[size_t(pieces_[middle++])];
    }
    return middle;
  }

  MergeTree& tree_;
  std::vector<int32_t> height_, leaves_;
  std::vector<Vec3f> center_;
  std::vector<Task> todo_;
  std::vector<int32_t> pieces_, joints_;
  std::vector<Range> ranges_;
};

/// Depth of the tree, without the centers that only a rebuilding needs.
int32_t Height(const MergeTree& tree) {
  std::vector<int32_t> height(tree.merges.size());
  const auto heightOf = [&](int32_t node) {
    return tree.IsLeaf(node) ? 0 : height[size_t(node - tree.leafCount)];
  };
  for (size_t i = 0; i < tree.merges.size(); ++i) {
    height[i] = 1 + std::max(heightOf(tree.merges[i][0]), heightOf(tree.merges[i][1]));
  }
  return height.empty() ? 0 : height.back();
}

}  // namespace

int32_t DepthLimit(int32_t leafCount) {
  return leafCount < 2 ? 0 : int32_t(3.5 * std::log2(double(leafCount)));
}

int64_t LimitDepth(MergeTree* tree, const std::function<Vec3f(int32_t leaf)>& leafCenter) {
  const int32_t limit = DepthLimit(tree->leafCount);
  if (tree->leafCount < 2 || Height(*tree) <= limit) return 0;
  return DepthLimiter(tree, leafCenter).Limit(limit);
}

}  // namespace lambert
