// What links bring to places, apart from the light that they carry: kernels and the rays that were
// cast for them, to be had again when only the light has changed.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

#include "Common/Core/Parallel.h"
#include "Common/Core/Vector.h"

namespace lambert {

/// Transfers to a row of places, in the order in which each asks for them. Neighbours in the row
/// lie in one block, which belongs to one thread at a time.
class KeptTransfers {
 public:
  /// What `visible` says where no ray was cast: nothing is known, or the kernel alone.
  static constexpr float kUnknown = -2, kUnoccluded = -1;
  struct Transfer {
    Vec3f kernel;              ///< W/m2 of a unit of radiosity; of a sky with its visibility
    float visible = kUnknown;  ///< [0, 1], or one of the above
  };

  /// `room` counts down the transfers that may still be kept, by this row and others; by reference.
  /// Where there is none each is forgotten once it was used. Which ones are kept where there are
  /// more depends on the threads, what comes of them does not.
  explicit KeptTransfers(std::atomic<int64_t>* room) : room_(room) {}

 private:
  /// The links of one element, as seen from one place.
  struct Visit {
    Vec3f place;
    int32_t element = -1, first = 0, count = 0;  ///< of the block's transfers
  };
  struct Block {
    std::vector<Visit> visits;
    std::vector<Transfer> transfers;
    std::vector<int32_t> firstVisit;  ///< by place; one more at the end
    int64_t made = 0;
  };

 public:
  /// Goes through the visits of a place.
  class Cursor {
   public:
    /// `count` transfers of links of `element` to `place`, as they were left at the last pass;
    /// unknown ones at the first, and where that pass asked for others. Valid until the next call.
    Transfer* Visit(int32_t element, const Vec3f& place, int32_t count);
    /// Counts a transfer that was not known.
    void CountMade() { ++block_->made; }

   private:
    friend class KeptTransfers;
    Cursor(Block* block, std::atomic<int64_t>* room);
    void BeginPlace(size_t place);
    void EndBlock();

    Block* block_;
    std::atomic<int64_t>* room_;  ///< for more transfers
    const bool isRecording_;      ///< the first pass
    size_t next_ = 0, end_ = 0;
    std::vector<Transfer> forgotten_;
  };

  /// Calls body(place, cursor) for each of `count` places, the same number at every pass; in
  /// parallel, those of a block in order.
  template <class Body>
  void ForEachPlace(int64_t count, const Body& body) {
    blocks_.resize(size_t((count + kBlock - 1) / kBlock));
    ParallelForEach(int64_t(blocks_.size()), 1, [&](int64_t b) {
      const int64_t first = b * kBlock, end = std::min(count, first + kBlock);
      Cursor cursor(&blocks_[size_t(b)], room_);
      for (int64_t place = first; place < end; ++place) {
        cursor.BeginPlace(size_t(place - first));
        body(place, &cursor);
      }
      cursor.EndBlock();
    });
  }

  /// Transfers made so far, by all passes: those that were not known.
  int64_t Made() const;

 private:
  static constexpr int64_t kBlock = 64;  ///< places

  std::atomic<int64_t>* room_;
  std::vector<Block> blocks_;
};

}  // namespace lambert
