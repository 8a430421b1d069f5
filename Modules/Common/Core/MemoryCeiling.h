// A ceiling on what the process holds in memory.
#pragma once

#include <cstdint>

namespace lambert {

/// Resident size of this process now, in bytes; 0 where the system does not tell.
int64_t ResidentMemoryBytes();

/// Gives what was freed back to the system, where the allocator keeps it; some milliseconds.
void ReturnFreedMemory();

class MemoryCeiling {
 public:
  /// `megabytes` of 1e6 bytes, [0, inf); 0: no ceiling.
  explicit MemoryCeiling(double megabytes = 0) : bytes_(megabytes * 1e6) {}

  /// Whether the process stays below with `bytes` more than it has now; what was freed goes back
  /// to the system before the answer is no.
  bool HasRoomFor(double bytes) const;

 private:
  double bytes_;
};

}  // namespace lambert
