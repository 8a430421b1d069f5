#include "Radiosity/Core/NearestPoints.h"

#include <algorithm>
#include <nanoflann.hpp>
#include <numeric>

#include "Common/Core/Parallel.h"

namespace lambert {

namespace {

/// Points in a leaf of a block's tree.
constexpr size_t kLeafSize = 10;

/// The points of a block.
struct Positions {
  const Vec3f* begin;
  size_t count;
  size_t kdtree_get_point_count() const { return count; }
  float kdtree_get_pt(size_t i, size_t axis) const { return begin[i][int(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Positions>,
                                                 Positions, 3, uint32_t>;

struct Block {
  Positions positions;
  const int32_t* numbers;  ///< of its points
  Tree tree;

  Block(const Vec3f* begin, size_t count, const int32_t* numbers_)
      : positions{begin, count}, numbers(numbers_), tree(3, positions, {kLeafSize}) {}
};

/// Points in a row, split in halves until they make a block.
struct Node {
  Box3f bounds;
  int64_t begin = 0, end = 0;
  int32_t child = -1;            ///< its second half follows; -1: it has a block
  std::unique_ptr<Block> block;  ///< of a node without halves
};

/// Collects what the trees of blocks find, by the numbers of all points.
class Found {
 public:
  using DistanceType = float;

  Found(int most, int32_t* found, float* squares) : nearest_(size_t(most)) {
    nearest_.init(found, squares);
  }
  void Enter(const int32_t* numbers) { numbers_ = numbers; }
  bool addPoint(float square, uint32_t index) { return nearest_.addPoint(square, numbers_[index]); }
  float worstDist() const { return nearest_.worstDist(); }
  bool full() const { return nearest_.full(); }
  size_t size() const { return nearest_.size(); }

 private:
  nanoflann::KNNResultSet<float, int32_t> nearest_;
  const int32_t* numbers_ = nullptr;
};

float SquaredDistance(const Box3f& box, const Vec3f& x) {
  return LengthSquared(Max(Max(box.low - x, x - box.high), Vec3f()));
}

}  // namespace

struct NearestPoints::Implementation {
  explicit Implementation(const std::vector<Vec3f>& points) : numbers(points.size()) {
    // Halves, level by level.
    std::iota(numbers.begin(), numbers.end(), 0);
    nodes.emplace_back();
    nodes[0].end = int64_t(points.size());
    for (size_t begin = 0, end = 1; begin < end; begin = end, end = nodes.size()) {
      ParallelForEach(int64_t(end - begin), 1,
                      [&](int64_t i) { this->Halve(points, &nodes[begin + size_t(i)]); });
      for (size_t i = begin; i < end; ++i) this->AddHalves(int32_t(i));
    }

    // A tree over each block.
    positions.resize(points.size());
    ParallelForEach(int64_t(nodes.size()), 1, [&](int64_t i) {
      Node& node = nodes[size_t(i)];
      if (node.child >= 0 || node.begin == node.end) return;
      for (int64_t k = node.begin; k < node.end; ++k) {
        positions[size_t(k)] = points[size_t(numbers[size_t(k)])];
      }
      node.block =
          std::make_unique<Block>(&positions[size_t(node.begin)], size_t(node.end - node.begin),
                                  &numbers[size_t(node.begin)]);
    });
  }

  /// Measures a node; one that is too large for a block has its points sorted into halves.
  void Halve(const std::vector<Vec3f>& points, Node* node) {
    int32_t* const begin = numbers.data() + node->begin;
    int32_t* const end = numbers.data() + node->end;
    for (const int32_t* i = begin; i != end; ++i) node->bounds.Include(points[size_t(*i)]);
    if (node->end - node->begin <= kBlockSize) return;
    const Vec3f extent = node->bounds.Extent();
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                     : extent.y >= extent.z                       ? 1
                                                                  : 2;
    std::nth_element(begin, begin + (end - begin) / 2, end, [&](int32_t a, int32_t b) {
      const float pa = points[size_t(a)][axis], pb = points[size_t(b)][axis];
      return pa != pb ? pa < pb : a < b;
    });
  }

  void AddHalves(int32_t index) {
    const int64_t begin = nodes[size_t(index)].begin, end = nodes[size_t(index)].end;
    if (end - begin <= kBlockSize) return;
    const int64_t middle = begin + (end - begin) / 2;
    nodes[size_t(index)].child = int32_t(nodes.size());
    for (const auto& [from, to] : {std::pair(begin, middle), std::pair(middle, end)}) {
      nodes.emplace_back();
      nodes.back().begin = from;
      nodes.back().end = to;
    }
  }

  /// What `node` holds that is nearer than what was found; its nearer half first.
  void Search(const Node& node, const Vec3f& x, Found* found) const {
    if (node.child < 0) {
      found->Enter(node.block->numbers);
      node.block->tree.findNeighbors(*found, &x.x, {});
      return;
    }
    const Node* near = &nodes[size_t(node.child)];
    const Node* far = near + 1;
    if (SquaredDistance(far->bounds, x) < SquaredDistance(near->bounds, x)) std::swap(near, far);
    for (const Node* half : {near, far}) {
      if (SquaredDistance(half->bounds, x) < found->worstDist()) this->Search(*half, x, found);
    }
  }

  std::vector<int32_t> numbers;  ///< of the points, those of a node in a row
  std::vector<Vec3f> positions;  ///< of the points, in the order of `numbers`
  std::vector<Node> nodes;       ///< the root first
};

NearestPoints::NearestPoints(const std::vector<Vec3f>& points)
    : implementation_(new Implementation(points)) {}

NearestPoints::~NearestPoints() = default;

const std::vector<int32_t>& NearestPoints::InOrder() const { return implementation_->numbers; }

int NearestPoints::Find(const Vec3f& x, int most, int32_t* found, float* squares) const {
  if (implementation_->numbers.empty() || most < 1) return 0;
  Found nearest(most, found, squares);
  implementation_->Search(implementation_->nodes[0], x, &nearest);
  return int(nearest.size());
}

}  // namespace lambert
