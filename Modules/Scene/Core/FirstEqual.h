// Finds equal things in one pass over a flat hash table; the answer does not depend on the table's
// order.
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "Common/Core/Random.h"

namespace lambert {

/// Bits of `value` for hashing: the two zeros are one.
inline uint32_t FloatBits(float value) {
  value += 0.0f;
  uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}
inline uint64_t HashPoint(const Vec3f& p) {
  return HashBits(uint64_t(FloatBits(p.x)) << 32 | FloatBits(p.y), FloatBits(p.z));
}
/// Equal in every bit but the sign of zero; unlike ==, a NaN equals itself.
inline bool SameBits(const Vec3f& a, const Vec3f& b) {
  return FloatBits(a.x) == FloatBits(b.x) && FloatBits(a.y) == FloatBits(b.y) &&
         FloatBits(a.z) == FloatBits(b.z);
}

/// For each i in [0, count): the lowest j with equal(i, j). `hash(i)` is a uint64_t, the same for
/// equal things.
template <class Hash, class Equal>
std::vector<int32_t> FirstEqual(int64_t count, const Hash& hash, const Equal& equal) {
  size_t slots = 16;
  while (slots < 2 * size_t(count)) slots *= 2;
  struct Slot {
    int32_t first = -1;
    uint32_t high = 0;  ///< half of the hash: most that differ are told by it
  };
  std::vector<Slot> table(slots);
  std::vector<int32_t> first(static_cast<size_t>(count));
  for (int64_t i = 0; i < count; ++i) {
    const uint64_t bits = hash(i);
    const uint32_t high = uint32_t(bits >> 32);
    size_t place = size_t(bits) & (slots - 1);
    while (table[place].first >= 0 &&
           !(table[place].high == high && equal(i, table[place].first))) {
      place = (place + 1) & (slots - 1);
    }
    if (table[place].first < 0) table[place] = {int32_t(i), high};
    first[size_t(i)] = table[place].first;
  }
  return first;
}

}  // namespace lambert
