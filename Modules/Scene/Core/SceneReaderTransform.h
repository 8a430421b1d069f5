// 4x4 matrices of nodes, row-major, in double.
#pragma once

#include <array>

#include "Common/Core/Vector.h"

namespace lambert {

using Matrix4 = std::array<double, 16>;

constexpr Matrix4 kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

inline Matrix4 Scaling(double s) { return {s, 0, 0, 0, 0, s, 0, 0, 0, 0, s, 0, 0, 0, 0, 1}; }

inline Matrix4 operator*(const Matrix4& a, const Matrix4& b) {
  Matrix4 product{};
  for (size_t row = 0; row < 4; ++row) {
    for (size_t column = 0; column < 4; ++column) {
      for (size_t k = 0; k < 4; ++k)
        product[4 * row + column] += a[4 * row + k] * b[4 * k + column];
    }
  }
  return product;
}

/// Translation x rotation (unit quaternion x, y, z, w) x scale.
inline Matrix4 TranslationRotationScale(const Vec3d& t, const std::array<double, 4>& q,
                                        const Vec3d& s) {
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  return {(1 - 2 * (y * y + z * z)) * s.x,
          2 * (x * y - z * w) * s.y,
          2 * (x * z + y * w) * s.z,
          t.x,
          2 * (x * y + z * w) * s.x,
          (1 - 2 * (x * x + z * z)) * s.y,
          2 * (y * z - x * w) * s.z,
          t.y,
          2 * (x * z - y * w) * s.x,
          2 * (y * z + x * w) * s.y,
          (1 - 2 * (x * x + y * y)) * s.z,
          t.z,
          0,
          0,
          0,
          1};
}

inline Vec3d TransformDirection(const Matrix4& m, const Vec3d& v) {
  return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[4] * v.x + m[5] * v.y + m[6] * v.z,
          m[8] * v.x + m[9] * v.y + m[10] * v.z};
}

inline Vec3d TransformPoint(const Matrix4& m, const Vec3d& p) {
  return TransformDirection(m, p) + Vec3d(m[3], m[7], m[11]);
}

}  // namespace lambert
