// Loops over all threads. Bodies write to their own index only, so that the answer is the same for any
// number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace lambert {

/// Threads that the loops below may use; 0 asks for all the processors. Global to the process.
void SetThreadCount(int threads);
int ThreadCount();

/// Calls body(begin, end) over disjoint ranges that cover [0, count), at least `grain` long each where possible.
void ParallelFor(int64_t count, int64_t grain, const std::function<void(int64_t, int64_t)>& body);

/// Calls body(i) for every i in [0, count); `grain` iterations at a time go to a thread.
template <class Body>
void ParallelForEach(int64_t count, int64_t grain, const Body& body) {
  ParallelFor(count, grain, [&](int64_t begin, int64_t end) {
    for (int64_t i = begin; i < end; ++i) body(i);
  });
}

/// Sum of term(i) over [0, count) in double, added in a fixed order: the same bits for any number of threads.
/// T needs +=, and a default of zero.
template <class T, class Term>
T OrderedSum(int64_t count, const Term& term) {
  constexpr int64_t kBlock = 4096;
  const int64_t blocks = (count + kBlock - 1) / kBlock;
  std::vector<T> partial(static_cast<size_t>(blocks));
  ParallelForEach(blocks, 1, [&](int64_t block) {
    T sum{};
    const int64_t end = std::min(count, (block + 1) * kBlock);
    for (int64_t i = block * kBlock; i < end; ++i) sum += term(i);
    partial[static_cast<size_t>(block)] = sum;
  });
  T total{};
  for (const T& sum : partial) total += sum;
  return total;
}

}  // namespace lambert
