#include "Atlas/Core/ChartMask.h"

#include <algorithm>
#include <array>

namespace lambert {

namespace {

/// Bit j of word i becomes bit i of word j: squares of 32 bits, then of 16 and so on, change
/// places.
void Transpose(std::array<uint64_t, 64>* square) {
  uint64_t low = 0xffffffff;
  for (size_t side = 32; side > 0; side /= 2, low ^= low << side) {
    for (size_t i = 0; i < 64; i = ((i | side) + 1) & ~side) {
      const uint64_t change = (((*square)[i] >> side) ^ (*square)[i | side]) & low;
      (*square)[i] ^= change << side;
      (*square)[i | side] ^= change;
    }
  }
}

}  // namespace

ChartMask::ChartMask(int width, int height)
    : width_(width),
      height_(height),
      words_((height + 63) / 64),
      bits_(size_t(width) * size_t(words_), 0) {}

void ChartMask::Take(int x, int low, int high) {
  for (int y = low; y < high;) {
    const int end = std::min(high, (y / 64 + 1) * 64);
    const uint64_t ones = ~uint64_t(0) >> (64 - (end - y));
    bits_[this->Word(x, y)] |= ones << (y % 64);
    y = end;
  }
}

void ChartMask::FillBetweenCrossings() {
  for (int x = 0; x < width_; ++x) {
    uint64_t isOpen = 0;  // All ones within.
    for (int w = 0; w < words_; ++w) {
      uint64_t& word = bits_[this->Word(x, 64 * w)];
      for (int step = 1; step < 64; step *= 2) word ^= word << step;
      word ^= isOpen;
      isOpen = uint64_t(0) - (word >> 63);
    }
  }
}

void ChartMask::Take(const ChartMask& other, int x, int y) {
  const int shift = y % 64;
  for (int i = 0; i < other.width_; ++i) {
    uint64_t* to = bits_.data() + this->Word(x + i, y);
    const uint64_t* from = other.Column(i);
    for (int w = 0; w < other.words_; ++w) {
      to[w] |= from[w] << shift;
      // What lies beyond the top of this mask is none of the other's.
      const uint64_t above = shift == 0 ? 0 : from[w] >> (64 - shift);
      if (above != 0) to[w + 1] |= above;
    }
  }
}

bool ChartMask::Meets(const ChartMask& other, int x, int y) const {
  const int shift = y % 64;
  for (int i = 0; i < other.width_; ++i) {
    const uint64_t* here = bits_.data() + this->Word(x + i, y);
    const uint64_t* there = other.Column(i);
    uint64_t common = 0;
    for (int w = 0; w < other.words_; ++w) {
      common |= here[w] & there[w] << shift;
      const uint64_t above = shift == 0 ? 0 : there[w] >> (64 - shift);
      if (above != 0) common |= here[w + 1] & above;
    }
    if (common != 0) return true;
  }
  return false;
}

ChartMask ChartMask::Turned() const {
  // What was row y is column y from the right.
  ChartMask turned(height_, width_);
  std::array<uint64_t, 64> square;
  for (int w = 0; w < words_; ++w) {
    for (int x = 0; x < width_; x += 64) {
      for (int i = 0; i < 64; ++i) {
        square[size_t(i)] = x + i < width_ ? bits_[this->Word(x + i, 64 * w)] : 0;
      }
      Transpose(&square);
      for (int y = 64 * w; y < std::min(height_, 64 * (w + 1)); ++y) {
        turned.bits_[turned.Word(height_ - 1 - y, x)] = square[size_t(y % 64)];
      }
    }
  }
  return turned;
}

}  // namespace lambert
