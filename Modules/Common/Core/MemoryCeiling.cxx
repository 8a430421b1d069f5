#include "Common/Core/MemoryCeiling.h"

#include <malloc.h>
#include <unistd.h>

#include <fstream>

namespace lambert {

int64_t ResidentMemoryBytes() {
  std::ifstream file("/proc/self/statm");
  int64_t program = 0, resident = 0;
  return file >> program >> resident ? resident * sysconf(_SC_PAGESIZE) : 0;
}

void ReturnFreedMemory() { malloc_trim(0); }

bool MemoryCeiling::HasRoomFor(double bytes) const {
  if (bytes_ <= 0 || double(ResidentMemoryBytes()) + bytes <= bytes_) return true;
  ReturnFreedMemory();
  return double(ResidentMemoryBytes()) + bytes <= bytes_;
}

}  // namespace lambert
