#include "Clustering/Core/VolumeClustering.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace lambert {

namespace {

/// Partitions top-down (thesis 4.3.2). The boxes are sorted along the three axes once; a partition
/// keeps the orders.
class VolumeClustering {
 public:
  explicit VolumeClustering(const std::vector<Box3f>& boxes) : boxes_(boxes) {
    const size_t count = boxes.size();
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<int32_t>& order = order_[size_t(axis)];
      order.resize(count);
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(), order.end(), [&](int32_t a, int32_t b) {
        const float x = Key(a, axis), y = Key(b, axis);
        return x != y ? x < y : a < b;
      });
    }
    scratch_.resize(count);
    rightArea_.resize(count);
    goesLeft_.resize(count);
  }

  std::vector<VolumeNode> Run() {
    std::vector<VolumeNode> nodes;
    if (boxes_.empty()) return nodes;
    nodes.reserve(2 * boxes_.size() - 1);
    nodes.emplace_back();
    std::vector<Range> ranges{{0, boxes_.size(), 0, 4 * LevelsOf(boxes_.size()) + 8}};
    while (!ranges.empty()) {
      const Range range = ranges.back();
      ranges.pop_back();
      VolumeNode& node = nodes[size_t(range.node)];
      node.itemCount = int32_t(range.end - range.begin);
      for (size_t i = range.begin; i < range.end; ++i)
        node.bounds.Include(boxes_[size_t(order_[0][i])]);
      if (range.end - range.begin == 1) {
        node.item = order_[0][range.begin];
        continue;
      }
      const size_t middle = Partition(range);
      const int32_t child = int32_t(nodes.size());
      node.child = child;
      nodes.resize(nodes.size() + 2);
      nodes[size_t(child)].parent = nodes[size_t(child) + 1].parent = range.node;
      ranges.push_back({middle, range.end, child + 1, range.levels - 1});
      ranges.push_back({range.begin, middle, child, range.levels - 1});
    }
    return nodes;
  }

 private:
  struct Range {
    size_t begin, end;
    int32_t node;
    int32_t levels;  ///< that its tree may still be deep
  };

  /// Depth of an even tree.
  static int32_t LevelsOf(size_t count) {
    int32_t levels = 0;
    while ((size_t(1) << levels) < count) ++levels;
    return levels;
  }

  /// Twice the center: the sort key of the thesis.
  float Key(int32_t box, int axis) const {
    return boxes_[size_t(box)].IsEmpty()
               ? 0
               : boxes_[size_t(box)].low[axis] + boxes_[size_t(box)].high[axis];
  }

  /// The cheapest split by (4.22) along any axis, the median where the levels run out; keeps the
  /// orders of both sides and returns where the right one begins.
  size_t Partition(const Range& range) {
    const size_t begin = range.begin, end = range.end;
    // Equal costs go to the most even split, so that boxes alike do not leave one by one.
    struct Split {
      double cost;
      size_t imbalance;
      int axis;
      size_t middle;
      bool operator<(const Split& o) const {
        return cost != o.cost ? cost < o.cost : imbalance < o.imbalance;
      }
    };
    const size_t count = end - begin;
    Split best{std::numeric_limits<double>::max(), count, 0, begin + count / 2};
    const bool useCost = range.levels > LevelsOf(count);
    for (int axis = 0; axis < 3 && useCost; ++axis) {
      const std::vector<int32_t>& order = order_[size_t(axis)];
      Box3f right;
      for (size_t i = end; i-- > begin + 1;) {
        right.Include(boxes_[size_t(order[i])]);
        rightArea_[i] = right.SurfaceArea();
      }
      Box3f left;
      for (size_t middle = begin + 1; middle < end; ++middle) {
        left.Include(boxes_[size_t(order[middle - 1])]);
        const size_t leftCount = middle - begin, rightCount = end - middle;
        // (4.22) without the division by S(H), which is common to all.
        const double cost = double(left.SurfaceArea()) * double(leftCount) +
                            double(rightArea_[middle]) * double(rightCount);
        const size_t imbalance = std::max(leftCount, rightCount) - std::min(leftCount, rightCount);
        best = std::min(best, Split{cost, imbalance, axis, middle});
      }
    }
    KeepOrders(begin, end, best.axis, best.middle);
    return best.middle;
  }

  void KeepOrders(size_t begin, size_t end, int axis, size_t middle) {
    for (size_t i = begin; i < end; ++i) goesLeft_[size_t(order_[size_t(axis)][i])] = i < middle;
    for (std::vector<int32_t>& order : order_) {
      size_t left = begin, right = middle;
      for (size_t i = begin; i < end; ++i)
        scratch_[goesLeft_[size_t(order[i])] ? left++ : right++] = order[i];
      std::copy(scratch_.begin() + long(begin), scratch_.begin() + long(end),
                order.begin() + long(begin));
    }
  }

  const std::vector<Box3f>& boxes_;
  std::array<std::vector<int32_t>, 3> order_;
  std::vector<int32_t> scratch_;
  std::vector<float> rightArea_;
  std::vector<uint8_t> goesLeft_;
};

}  // namespace

std::vector<VolumeNode> ClusterVolumes(const std::vector<Box3f>& boxes) {
  return VolumeClustering(boxes).Run();
}

}  // namespace lambert
