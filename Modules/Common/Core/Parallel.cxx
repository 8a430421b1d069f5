#include "Common/Core/Parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>

#include <memory>
#include <mutex>

namespace lambert {

namespace {
std::mutex g_mutex;
std::unique_ptr<tbb::global_control> g_limit;
}  // namespace

void SetThreadCount(int threads) {
  std::lock_guard<std::mutex> lock(g_mutex);
  g_limit.reset();
  if (threads > 0) {
    g_limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<size_t>(threads));
  }
}

int ThreadCount() {
  return static_cast<int>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

void ParallelFor(int64_t count, int64_t grain, const std::function<void(int64_t, int64_t)>& body) {
  if (count <= 0) return;
  tbb::parallel_for(
      tbb::blocked_range<int64_t>(0, count, std::max<int64_t>(1, grain)),
      [&](const tbb::blocked_range<int64_t>& range) { body(range.begin(), range.end()); });
}

}  // namespace lambert
