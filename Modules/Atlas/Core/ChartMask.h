// The texels that a chart takes of a page.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lambert {

/// The texels that a chart takes, padding and all; 64 of a column are a word.
class ChartMask {
 public:
  ChartMask() = default;
  /// None taken; width and height in texels, [1, inf).
  ChartMask(int width, int height);

  int Width() const { return width_; }
  int Height() const { return height_; }
  bool IsTaken(int x, int y) const { return bits_[this->Word(x, y)] >> (y % 64) & 1; }
  /// Texels [low, high) of a column.
  void Take(int x, int low, int high);
  /// Where an outline crosses the middle of a column upward or downward: from this texel on, up to
  /// the next crossing.
  void Cross(int x, int y) { bits_[this->Word(x, y)] ^= uint64_t(1) << (y % 64); }
  /// Texels between crossings, where nothing else is marked yet: every other stretch of a column.
  void FillBetweenCrossings();
  /// What another mask takes with its lower left corner at (x, y), all within this one.
  void Take(const ChartMask& other, int x, int y);
  /// Whether another mask with its lower left corner at (x, y), all within this one, takes what is
  /// taken.
  bool Meets(const ChartMask& other, int x, int y) const;
  /// Turned left by a quarter.
  ChartMask Turned() const;

  const uint64_t* Column(int x) const { return bits_.data() + this->Word(x, 0); }
  int WordsOfColumn() const { return words_; }

 private:
  size_t Word(int x, int y) const { return size_t(x) * size_t(words_) + size_t(y / 64); }

  int width_ = 0, height_ = 0;
  int words_ = 0;  ///< a column
  std::vector<uint64_t> bits_;
};

}  // namespace lambert
