// A number for the content of memory, to know it again: no cryptography.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#include "Common/Core/Random.h"

namespace lambert {

/// Of `size` bytes, joined to `seed`, the hash of what came before them.
inline uint64_t HashOfBytes(const void* data, size_t size, uint64_t seed) {
  const auto* bytes = static_cast<const char*>(data);
  uint64_t hash = HashBits(seed, size);
  for (size_t i = 0; i < size; i += sizeof(uint64_t)) {
    uint64_t word = 0;
    std::memcpy(&word, bytes + i, std::min(sizeof word, size - i));
    hash = HashBits(hash, word);
  }
  return hash;
}

/// Of plain values without padding, joined to `seed`.
template <class T>
uint64_t HashOf(const std::vector<T>& values, uint64_t seed) {
  static_assert(std::is_trivially_copyable_v<T>);
  return HashOfBytes(values.data(), values.size() * sizeof(T), seed);
}

}  // namespace lambert
