// The nearest of many points: search trees over blocks of them that are near each other, which are
// made, and asked, in parallel and in the processor's cache.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "Common/Core/Vector.h"

namespace lambert {

/// Answers depend on the points and their order alone. Safe to ask from several threads.
class NearestPoints {
 public:
  /// Points in a block, at most.
  static constexpr int64_t kBlockSize = 32768;

  explicit NearestPoints(const std::vector<Vec3f>& points);
  ~NearestPoints();

  /// All points, numbers as they were given, those of a block together: who asks in this order
  /// finds what he asks in the cache.
  const std::vector<int32_t>& InOrder() const;
  /// Numbers of the `most` points nearest to `x`, itself if it is one, nearest first, and the
  /// squares of their distances, m2. Returns how many there are.
  int Find(const Vec3f& x, int most, int32_t* found, float* squares) const;

 private:
  struct Implementation;
  std::unique_ptr<const Implementation> implementation_;
};

}  // namespace lambert
