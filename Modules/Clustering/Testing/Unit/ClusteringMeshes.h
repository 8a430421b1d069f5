// Meshes that the clustering tests share.
#pragma once

#include <cmath>

#include "Common/Core/Random.h"
#include "Common/Core/TriangleMesh.h"

namespace lambert {

/// Points of a grid of `columns` x `rows` cells, in place(u, v) with u, v in [0, 1], and two
/// triangles a cell.
template <class Place>
TriangleMesh GridMesh(int columns, int rows, const Place& place) {
  TriangleMesh mesh;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      mesh.positions.push_back(place(double(i) / columns, double(j) / rows));
    }
  }
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const int a = j * (columns + 1) + i, b = a + 1, c = a + columns + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  }
  mesh.Complete();
  return mesh;
}

inline TriangleMesh FlatGrid(int cells) {
  return GridMesh(cells, cells, [](double u, double v) { return Vec3f(float(u), float(v), 0); });
}

/// Cells that shrink by powers of u: from squares to needles of aspect ratio 1e6.
inline TriangleMesh SliverGrid(int cells) {
  return GridMesh(cells, cells,
                  [](double u, double v) { return Vec3f(float(u * u * u), float(v) * 1e-3f, 0); });
}

/// Seams of the parameters are closed by position: sin and cos of whole turns are rounded alike.
inline Vec3f OnTurn(double turns, double radius, double z) {
  const double angle = turns >= 1 ? 0 : 2 * kPi * turns;
  return {float(radius * std::cos(angle)), float(radius * std::sin(angle)), float(z)};
}

inline TriangleMesh Sphere(int cells) {
  TriangleMesh mesh = GridMesh(2 * cells, cells, [](double u, double v) {
    if (v == 0 || v == 1) return Vec3f(0, 0, v == 0 ? -1.f : 1.f);
    return OnTurn(u, std::sin(kPi * v), -std::cos(kPi * v));
  });
  // Triangles at the poles that have lost an edge.
  TriangleMesh sphere;
  sphere.positions = mesh.positions;
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    const Vec3f &a = mesh.Corner(face, 0), &b = mesh.Corner(face, 1), &c = mesh.Corner(face, 2);
    if (a != b && b != c && c != a) sphere.triangles.push_back(mesh.triangles[size_t(face)]);
  }
  sphere.Complete();
  return sphere;
}

inline TriangleMesh Torus(int columns, int rows) {
  return GridMesh(columns, rows, [](double u, double v) {
    const double angle = v >= 1 ? 0 : 2 * kPi * v;
    return OnTurn(u, 2 + std::cos(angle), std::sin(angle));
  });
}

/// A band with half a twist; its triangles are wound alike but for one cut across, where front
/// meets back.
inline TriangleMesh MoebiusBand(int columns, int rows) {
  return GridMesh(columns, rows, [](double u, double v) {
    const double w = u >= 1 ? 0.5 - v : v - 0.5;
    const double turn = u >= 1 ? 0 : u;
    return OnTurn(turn, 2 + w * std::cos(kPi * turn), w * std::sin(kPi * turn));
  });
}

/// `blades` triangles about one edge.
inline TriangleMesh NonManifoldFan(int blades) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 1}};
  for (int i = 0; i < blades; ++i) {
    mesh.positions.push_back(OnTurn(double(i) / blades, 1, 0.5));
    mesh.triangles.push_back({0, 1, i + 2});
  }
  mesh.Complete();
  return mesh;
}

/// Random triangles over few points: edges of any number of faces, any winding, several parts and
/// materials.
inline TriangleMesh Soup(uint64_t seed, int points, int faces) {
  Random random(seed);
  TriangleMesh mesh;
  for (int i = 0; i < points; ++i) {
    mesh.positions.push_back({random.Uniform(), random.Uniform(), random.Uniform()});
  }
  const auto below = [&](int count) { return int32_t(random.UniformDouble() * count); };
  for (int i = 0; i < faces; ++i) {
    mesh.triangles.push_back({below(points), below(points), below(points)});
    mesh.partId.push_back(below(3));
    mesh.materialId.push_back(below(2));
  }
  mesh.Complete();
  return mesh;
}

}  // namespace lambert
