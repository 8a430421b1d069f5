// Wall-clock seconds and the peak memory of the process, for reports.
#pragma once

#include <chrono>
#include <cstdint>

namespace lambert {

class Timer {
 public:
  double Seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  void Restart() { start_ = std::chrono::steady_clock::now(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Largest resident size of this process so far, in bytes; 0 where the system does not tell.
int64_t PeakMemoryBytes();
/// Seconds since this process was started by the system; 0 where the system does not tell.
double SecondsSinceProcessStart();

}  // namespace lambert
