// Which of a number of things belong together, joined two by two.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace lambert {

/// A set is known by its smallest member.
class DisjointSets {
 public:
  /// Each of 0 to `count` - 1 in a set of its own.
  explicit DisjointSets(size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  /// The smallest member of the set that holds `i`.
  int32_t Find(int32_t i) {
    while (parent_[size_t(i)] != i) i = parent_[size_t(i)] = parent_[size_t(parent_[size_t(i)])];
    return i;
  }
  void Join(int32_t a, int32_t b) {
    a = this->Find(a), b = this->Find(b);
    parent_[size_t(std::max(a, b))] = std::min(a, b);
  }

 private:
  std::vector<int32_t> parent_;
};

}  // namespace lambert
