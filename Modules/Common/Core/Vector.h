// Points, directions and boxes. Plain structs: they lie in arrays as VTK and Embree expect them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace lambert {

template <class T>
struct Vec2 {
  T x = 0, y = 0;

  Vec2() = default;
  constexpr Vec2(T x_, T y_) : x(x_), y(y_) {}
  template <class U>
  explicit constexpr Vec2(const Vec2<U>& v) : x(T(v.x)), y(T(v.y)) {}

  Vec2 operator+(Vec2 v) const { return {x + v.x, y + v.y}; }
  Vec2 operator-(Vec2 v) const { return {x - v.x, y - v.y}; }
  Vec2 operator*(T s) const { return {x * s, y * s}; }
  bool operator==(Vec2 v) const { return x == v.x && y == v.y; }
  bool operator!=(Vec2 v) const { return !(*this == v); }
};

template <class T>
struct Vec3 {
  T x = 0, y = 0, z = 0;

  Vec3() = default;
  constexpr Vec3(T x_, T y_, T z_) : x(x_), y(y_), z(z_) {}
  template <class U>
  explicit constexpr Vec3(const Vec3<U>& v) : x(T(v.x)), y(T(v.y)), z(T(v.z)) {}

  T& operator[](int axis) { return (&x)[axis]; }
  const T& operator[](int axis) const { return (&x)[axis]; }
  Vec3 operator+(const Vec3& v) const { return {x + v.x, y + v.y, z + v.z}; }
  Vec3 operator-(const Vec3& v) const { return {x - v.x, y - v.y, z - v.z}; }
  Vec3 operator-() const { return {-x, -y, -z}; }
  Vec3 operator*(T s) const { return {x * s, y * s, z * s}; }
  Vec3 operator/(T s) const { return {x / s, y / s, z / s}; }
  Vec3& operator+=(const Vec3& v) { return *this = *this + v; }
  Vec3& operator-=(const Vec3& v) { return *this = *this - v; }
  Vec3& operator*=(T s) { return *this = *this * s; }
  Vec3& operator/=(T s) { return *this = *this / s; }
  bool operator==(const Vec3& v) const { return x == v.x && y == v.y && z == v.z; }
  bool operator!=(const Vec3& v) const { return !(*this == v); }
};

template <class T>
Vec3<T> operator*(T s, const Vec3<T>& v) {
  return v * s;
}
template <class T>
T Dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
Vec3<T> Cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
T LengthSquared(const Vec3<T>& v) {
  return Dot(v, v);
}
template <class T>
T Length(const Vec3<T>& v) {
  return std::sqrt(Dot(v, v));
}
/// Unit vector along v; the zero vector stays zero, so that no NaN is born here.
template <class T>
Vec3<T> Normalize(const Vec3<T>& v) {
  const T length = Length(v);
  return length > 0 ? v / length : Vec3<T>();
}
template <class T>
bool IsFinite(const Vec3<T>& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
template <class T>
Vec3<T> Min(const Vec3<T>& a, const Vec3<T>& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
template <class T>
Vec3<T> Max(const Vec3<T>& a, const Vec3<T>& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

using Vec2f = Vec2<float>;
using Vec2d = Vec2<double>;
using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;

/// Two unit vectors that complete the unit vector `n` to a right-handed frame (u, v, n).
template <class T>
void CoordinateSystem(const Vec3<T>& n, Vec3<T>* u, Vec3<T>* v) {
  const T sign = std::copysign(T(1), n.z);
  const T a = T(-1) / (sign + n.z);
  const T b = n.x * n.y * a;
  *u = {T(1) + sign * n.x * n.x * a, sign * b, -sign * n.x};
  *v = {b, sign + n.y * n.y * a, -n.y};
}

/// Axis-aligned bounds; empty until a point is included.
struct Box3f {
  Vec3f low{std::numeric_limits<float>::max(), std::numeric_limits<float>::max(),
            std::numeric_limits<float>::max()};
  Vec3f high{std::numeric_limits<float>::lowest(), std::numeric_limits<float>::lowest(),
             std::numeric_limits<float>::lowest()};

  void Include(const Vec3f& p) {
    low = Min(low, p);
    high = Max(high, p);
  }
  void Include(const Box3f& b) {
    low = Min(low, b.low);
    high = Max(high, b.high);
  }
  bool IsEmpty() const { return low.x > high.x; }
  Vec3f Center() const { return (low + high) * 0.5f; }
  Vec3f Extent() const { return IsEmpty() ? Vec3f() : high - low; }
  float Diagonal() const { return Length(Extent()); }
  float SurfaceArea() const {
    const Vec3f e = Extent();
    return 2 * (e.x * e.y + e.y * e.z + e.z * e.x);
  }
};

}  // namespace lambert
