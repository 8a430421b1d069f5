// A plane fitted by least squares to values at places around a middle, and whether the middle
// belongs to it.
#pragma once

#include <algorithm>
#include <array>

namespace lambert {

/// A place in the plane about the middle, and by how much it counts.
struct PlanePoint {
  float u, v, weight;
};

/// p + q u + r v through values at the places.
class PlaneFit {
 public:
  PlaneFit(const PlanePoint* points, int count) {
    // Moments.
    double m00 = 0, m01 = 0, m02 = 0, m11 = 0, m12 = 0, m22 = 0;
    for (int i = 0; i < count; ++i) {
      const PlanePoint& n = points[i];
      m00 += n.weight, m01 += n.weight * n.u, m02 += n.weight * n.v;
      m11 += n.weight * n.u * n.u, m12 += n.weight * n.u * n.v, m22 += n.weight * n.v * n.v;
    }
    const double ridge = kSlopeRidge * (m11 + m22);
    m11 += ridge, m22 += ridge;

    // Their inverse; the mean where they have none.
    const double c00 = m11 * m22 - m12 * m12, c01 = m02 * m12 - m01 * m22,
                 c02 = m01 * m12 - m02 * m11;
    const double determinant = m00 * c00 + m01 * c01 + m02 * c02;
    if (!(determinant > 0)) {
      inverse_[0] = {m00 > 0 ? float(1 / m00) : 0, 0, 0};
      return;
    }
    const double c11 = m00 * m22 - m02 * m02, c12 = m01 * m02 - m00 * m12,
                 c22 = m00 * m11 - m01 * m01;
    const auto part = [&](double c) { return float(c / determinant); };
    inverse_ = {{{part(c00), part(c01), part(c02)},
                 {part(c01), part(c11), part(c12)},
                 {part(c02), part(c12), part(c22)}}};
  }
  /// The part that the value at a place of the fit has in the value of the plane at the middle.
  float WeightAtMiddle(const PlanePoint& n) const { return n.weight * this->Row(0, n); }
  /// The plane through `values` at the places: its value at the middle, its slopes along u and v.
  std::array<float, 3> Through(const PlanePoint* points, const float* values, int count) const {
    std::array<float, 3> plane = {0, 0, 0};
    for (int i = 0; i < count; ++i) {
      const float value = points[i].weight * values[i];
      for (size_t row = 0; row < 3; ++row) plane[row] += value * this->Row(row, points[i]);
    }
    return plane;
  }

 private:
  /// Slopes are held back by this part of the places' own spread: along a line of them nothing is
  /// known of the slope across.
  static constexpr double kSlopeRidge = 0.05;

  float Row(size_t row, const PlanePoint& n) const {
    return inverse_[row][0] + inverse_[row][1] * n.u + inverse_[row][2] * n.v;
  }

  std::array<std::array<float, 3>, 3> inverse_{};
};

/// Adds to the square at each place that of the distance of its value from the plane through all.
inline void AddSquaresOff(const PlaneFit& fit, const PlanePoint* points, const float* values,
                          int count, double* squares) {
  const std::array<float, 3> plane = fit.Through(points, values, count);
  for (int i = 0; i < count; ++i) {
    const PlanePoint& p = points[i];
    const double off = double(values[i] - plane[0] - plane[1] * p.u - plane[2] * p.v);
    squares[i] += off * off;
  }
}

/// By how much the first place does not belong to the others, [0, 1], when values at them are so
/// far off the plane, squared, and are means of so many rays, each of the given variance: by how
/// much all are farther off than that lets them be, or the first alone is by more than two standard
/// deviations.
inline float StandsApart(const PlanePoint* points, const double* squares, const float* rays,
                         int count, double variance) {
  double off = 0, weights = 0;
  for (int i = 0; i < count; ++i) {
    off += double(points[i].weight) * squares[i];
    weights += double(points[i].weight / rays[i]);
  }
  const double most = std::max(off / weights, squares[0] * double(rays[0]) / 4);
  return most > variance ? float(std::min(1.0, most / variance - 1)) : 0;
}

}  // namespace lambert
