#include "Atlas/Core/ConformalMap.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>

#include <Eigen/SparseCholesky>
#include <complex>

namespace lambert {

namespace {

using Complex = std::complex<double>;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// A triangle is thought to be this part of its length high at least: needles count no more.
constexpr double kLeastHeight = 1e-3;
/// It is flipped where it lies on the wrong side of its longest edge by more than this part of its
/// length: less is what the positions of points in single precision make of slivers.
constexpr double kRounding = 1e-6;

/// Two vertices of the border far apart: the farthest from any, and the farthest from that.
std::array<int32_t, 2> FarVertices(const ChartMesh& chart) {
  const auto farthest = [&](int32_t from) {
    int32_t best = from;
    double most = 0;
    for (const std::vector<int32_t>& line : chart.borders) {
      for (const int32_t v : line) {
        const double d = LengthSquared(chart.positions[size_t(v)] - chart.positions[size_t(from)]);
        if (d > most) {
          most = d;
          best = v;
        }
      }
    }
    return best;
  };
  const int32_t a = farthest(chart.borders.front().front());
  return {a, farthest(a)};
}

double SignedArea(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  const Vec2d u = b - a, v = c - a;
  return 0.5 * (u.x * v.y - u.y * v.x);
}

double SignedArea(const std::vector<int32_t>& line, const std::vector<Vec2d>& map) {
  double area = 0;
  const Vec2d& origin = map[size_t(line.front())];
  for (size_t i = 0; i < line.size(); ++i) {
    area += SignedArea(origin, map[size_t(line[i])], map[size_t(line[(i + 1) % line.size()])]);
  }
  return area;
}

/// Scales the map so that it has the area of the chart; false where it has none.
bool KeepArea(const ChartMesh& chart, std::vector<Vec2d>* map) {
  double area = 0, mapped = 0;
  for (size_t t = 0; t < chart.triangles.size(); ++t) {
    const auto& v = chart.triangles[t];
    const Vec3d &a = chart.positions[size_t(v[0])], &b = chart.positions[size_t(v[1])];
    area += 0.5 * Length(Cross(b - a, chart.positions[size_t(v[2])] - a));
    mapped += SignedArea((*map)[size_t(v[0])], (*map)[size_t(v[1])], (*map)[size_t(v[2])]);
  }
  const double scale = std::sqrt(area / mapped);
  if (!(mapped > 0) || !std::isfinite(scale)) return false;
  for (Vec2d& place : *map) place = place * scale;
  return true;
}

}  // namespace

// The angle of a triangle is kept where the sum of its opposite edges times the places of its
// corners, as complex numbers, is zero; the squares of these sums make a Hermitian matrix.
std::vector<Vec2d> ConformalMap(const ChartMesh& chart) {
  // Two vertices stay put, the others are asked for.
  const std::array<int32_t, 2> fixed = FarVertices(chart);
  if (fixed[0] == fixed[1]) return {};
  const size_t count = chart.positions.size();
  std::vector<int> unknown(count, -1);
  int unknowns = 0;
  for (size_t v = 0; v < count; ++v) {
    if (int32_t(v) != fixed[0] && int32_t(v) != fixed[1]) unknown[v] = unknowns++;
  }
  std::vector<Complex> place(count);
  place[size_t(fixed[1])] =
      Length(chart.positions[size_t(fixed[1])] - chart.positions[size_t(fixed[0])]);

  // What each triangle asks for, by its area.
  std::vector<Eigen::Triplet<Complex>> entries;
  entries.reserve(6 * chart.triangles.size());
  Eigen::VectorXcd right = Eigen::VectorXcd::Zero(unknowns);
  for (size_t t = 0; t < chart.triangles.size(); ++t) {
    const FlatTriangle flat = Flatten(chart, t);
    if (!(flat.length > 0)) continue;
    const double doubleArea = flat.length * std::max(flat.height, kLeastHeight * flat.length);
    const Complex corner[3] = {0, flat.length, Complex(flat.x, flat.height)};
    int32_t vertex[3];
    Complex opposite[3];
    for (int c = 0; c < 3; ++c) {
      vertex[c] = chart.triangles[t][size_t((flat.first + c) % 3)];
      opposite[c] = corner[(c + 2) % 3] - corner[(c + 1) % 3];
    }
    for (int i = 0; i < 3; ++i) {
      const int row = unknown[size_t(vertex[i])];
      if (row < 0) continue;
      for (int j = 0; j < 3; ++j) {
        const Complex value = std::conj(opposite[i]) * opposite[j] / doubleArea;
        const int column = unknown[size_t(vertex[j])];
        if (column < 0) {
          right[row] -= value * place[size_t(vertex[j])];
        } else if (column <= row) {
          entries.emplace_back(row, column, value);
        }
      }
    }
  }
  Eigen::SparseMatrix<Complex> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  std::vector<Eigen::Triplet<Complex>>().swap(entries);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<Complex>> factor(matrix);
  if (factor.info() != Eigen::Success) return {};
  const Eigen::VectorXcd solved = factor.solve(right);

  // As large as the chart.
  std::vector<Vec2d> map(count);
  for (size_t v = 0; v < count; ++v) {
    const Complex z = unknown[v] < 0 ? place[v] : solved[unknown[v]];
    if (!std::isfinite(z.real()) || !std::isfinite(z.imag())) return {};
    map[v] = {z.real(), z.imag()};
  }
  if (!KeepArea(chart, &map)) return {};
  return map;
}

std::vector<Vec2d> ProjectedMap(const ChartMesh& chart, const Vec3d& axis) {
  Vec3d u, v;
  CoordinateSystem(axis, &u, &v);
  std::vector<Vec2d> map;
  map.reserve(chart.positions.size());
  for (const Vec3d& p : chart.positions) map.push_back({Dot(p, u), Dot(p, v)});
  return map;
}

double Stretch(const ChartMesh& chart, const std::vector<Vec2d>& map) {
  // Lengths along the two directions in which a triangle is stretched most and least.
  double most = 1;
  for (size_t t = 0; t < chart.triangles.size(); ++t) {
    const FlatTriangle flat = Flatten(chart, t);
    if (!(flat.length > 0)) continue;
    Vec2d p[3];
    for (int c = 0; c < 3; ++c) {
      p[c] = map[size_t(chart.triangles[t][size_t((flat.first + c) % 3)])];
    }
    const Vec2d along = (p[1] - p[0]) * (1 / flat.length);
    const double square = along.x * along.x + along.y * along.y;
    const double doubleArea = 2 * SignedArea(p[0], p[1], p[2]);
    if (!(doubleArea >= -kRounding * square * flat.length * flat.length)) return 0;
    double large = square, small = square;
    if (!flat.IsSliver()) {
      const Vec2d across = (p[2] - p[0] - along * flat.x) * (1 / flat.height);
      const double other = across.x * across.x + across.y * across.y;
      const double mixed = along.x * across.x + along.y * across.y;
      const double half = 0.5 * std::hypot(square - other, 2 * mixed);
      large = 0.5 * (square + other) + half;
      small = 0.5 * (square + other) - half;
      if (!(doubleArea > 0)) return 0;
    }
    if (!(small > 0)) return 0;
    most = std::max({most, std::sqrt(large), 1 / std::sqrt(small)});
  }

  // A place is taken as often as the border lines wind about it: once at most, where one of them
  // winds forward, the others backward, and none crosses itself.
  int forward = 0;
  for (const std::vector<int32_t>& line : chart.borders) {
    if (line.size() < 3) return 0;
    forward += SignedArea(line, map) > 0;
    std::vector<Kernel::Point_2> polygon;
    for (const int32_t v : line) polygon.emplace_back(map[size_t(v)].x, map[size_t(v)].y);
    if (!CGAL::is_simple_2(polygon.begin(), polygon.end(), Kernel())) return 0;
  }
  return forward == 1 ? most : 0;
}

}  // namespace lambert
