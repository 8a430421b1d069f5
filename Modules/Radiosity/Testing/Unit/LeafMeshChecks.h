// What the tests of the leaf mesh share: small meshes, and what holds of every output.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <tuple>

#include "Common/Testing/TestScenes.h"
#include "Radiosity/Core/LeafMesh.h"

namespace lambert::testing {

using Place = std::tuple<float, float, float>;

inline Place PlaceOf(const Vec3f& p) { return {p.x + 0.f, p.y + 0.f, p.z + 0.f}; }

// A bumpy grid of n x n squares. A crease along its middle gives the two halves points of their
// own.
inline TriangleMesh Grid(int n, bool withCrease, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> shift(-0.3f, 0.3f);
  std::vector<Vec3f> positions;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) {
      positions.push_back({x + shift(random), y + shift(random), shift(random)});
    }
  }
  const int crease = n / 2;
  const int32_t copies = int32_t(positions.size());
  for (int y = 0; y <= n; ++y) positions.push_back(positions[size_t(y * (n + 1) + crease)]);
  const auto point = [&](int x, int y, bool isRight) {
    return withCrease && isRight && x == crease ? copies + y : y * (n + 1) + x;
  };
  std::vector<std::array<int32_t, 3>> triangles;
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const bool right = x >= crease;
      const int32_t a = point(x, y, right), b = point(x + 1, y, right);
      const int32_t c = point(x + 1, y + 1, right), d = point(x, y + 1, right);
      triangles.push_back({a, b, c});
      triangles.push_back({c, d, a});
    }
  }
  return MakeMesh(positions, triangles);
}

// Blades around one edge, every second with points of its own and wound the other way.
inline TriangleMesh Fan(int blades) {
  std::vector<Vec3f> positions = {{0, 0, 0}, {0, 0, 1}, {0, 0, 0}, {0, 0, 1}};
  std::vector<std::array<int32_t, 3>> triangles;
  for (int i = 0; i < blades; ++i) {
    const float angle = 6.2831853f * float(i) / float(blades);
    positions.push_back({std::cos(angle), std::sin(angle), 0.3f + 0.1f * float(i)});
    const int32_t tip = int32_t(positions.size()) - 1;
    if (i % 2 == 0) triangles.push_back({0, 1, tip});
    if (i % 2 == 1) triangles.push_back({3, 2, tip});
  }
  return MakeMesh(positions, triangles);
}

// Two fans of slivers, 1000 : 1, that meet along their long edges.
inline TriangleMesh Slivers(int count) {
  std::vector<Vec3f> positions;
  for (int i = 0; i <= count; ++i) {
    positions.push_back({0, 0.001f * float(i), 0});
    positions.push_back({1, 0.001f * float(i), 0.0003f * float(i * i)});
  }
  std::vector<std::array<int32_t, 3>> triangles;
  for (int32_t i = 0; i < count; ++i) {
    const int32_t a = 2 * i, b = 2 * i + 1, c = 2 * i + 3, d = 2 * i + 2;
    triangles.push_back({a, b, c});
    triangles.push_back({a, c, d});
  }
  return MakeMesh(positions, triangles);
}

inline float LongestEdge(const std::vector<Vec3f>& corners) {
  float longest = 0;
  for (size_t i = 0; i < corners.size(); ++i) {
    longest = std::max(longest, Length(corners[(i + 1) % corners.size()] - corners[i]));
  }
  return longest;
}

inline double PolygonArea(const std::vector<Vec3f>& corners) {
  Vec3d sum;
  for (size_t i = 2; i < corners.size(); ++i) {
    sum += Cross(Vec3d(corners[i - 1] - corners[0]), Vec3d(corners[i] - corners[0]));
  }
  return 0.5 * Length(sum);
}

// Splits leaf patches chosen at random, on both sides, starting at a third of the faces.
inline void SplitAtRandom(const TriangleMesh& mesh, int splits, float smallest, uint32_t seed,
                          LeafMesh* leaves) {
  std::mt19937 random(seed);
  std::vector<int32_t> open;
  for (int32_t face = 0; face < mesh.FaceCount(); ++face) {
    for (const Side side : {kFront, kBack}) {
      if (random() % 3 == 0) open.push_back(leaves->FacePatch(face, side));
    }
  }
  for (int i = 0; i < splits && !open.empty(); ++i) {
    const size_t pick = random() % open.size();
    const int32_t patch = open[pick];
    open.erase(open.begin() + int64_t(pick));
    if (LongestEdge(leaves->Corners(patch)) < smallest) continue;
    const auto halves = leaves->Split(patch);
    open.insert(open.end(), halves.begin(), halves.end());
  }
}

struct Output {
  Output(const TriangleMesh& input, LeafMesh* leaves)
      : mesh(input),
        triangles(leaves->Triangulate(std::vector<uint8_t>(size_t(input.FaceCount()), 3))),
        vertices(leaves->Vertices()) {}

  Vec3f Position(int32_t vertex) const {
    const size_t points = mesh.positions.size();
    return size_t(vertex) < points ? mesh.positions[size_t(vertex)]
                                   : vertices[size_t(vertex) - points].position;
  }
  Vec3f Corner(const LeafTriangle& triangle, int corner) const {
    return Position(triangle.vertices[size_t(corner)]);
  }
  Vec3d VectorArea(const LeafTriangle& t) const {
    const Vec3d a(Corner(t, 0));
    return Cross(Vec3d(Corner(t, 1)) - a, Vec3d(Corner(t, 2)) - a) * 0.5;
  }

  // Vertices of one side of the surface, and vertices of either side on input edges.
  std::set<Place> Places(Side side) const {
    std::set<Place> places;
    for (const LeafTriangle& t : triangles) {
      for (int i = 0; i < 3 && t.side == side; ++i) places.insert(PlaceOf(Corner(t, i)));
    }
    for (const LeafVertex& vertex : vertices) {
      if (vertex.points[2] == vertex.points[0]) places.insert(PlaceOf(vertex.position));
    }
    return places;
  }

  // Vertices strictly inside edges of triangles: by geometry alone, over all pairs.
  int VerticesInsideEdges() const {
    const std::array<std::set<Place>, 2> places = {Places(kFront), Places(kBack)};
    int count = 0;
    for (const LeafTriangle& t : triangles) {
      for (int i = 0; i < 3; ++i) {
        const Vec3d a(Corner(t, i)), ab = Vec3d(Corner(t, (i + 1) % 3)) - a;
        for (const auto& [x, y, z] : places[t.side]) {
          const Vec3d ap = Vec3d(x, y, z) - a;
          const double along = Dot(ap, ab) / LengthSquared(ab);
          // A vertex on the edge is off it by the rounding of floats, 1e-7 of coordinates up to ten
          // times the edges; vertices that belong elsewhere are off by the smallest patches, 1e-4.
          const bool isBetween = along > 1e-5 && along < 1 - 1e-5;
          if (isBetween && Length(Cross(ab, ap)) < 2e-6 * std::max(Length(ab), 1.0) * Length(ab)) {
            ++count;
          }
        }
      }
    }
    return count;
  }

  const TriangleMesh& mesh;
  std::vector<LeafTriangle> triangles;
  std::vector<LeafVertex> vertices;
};

// Counts how often an edge, by places, is used in each direction on one side.
inline std::map<std::pair<Place, Place>, int> EdgeUses(const Output& output, Side side) {
  std::map<std::pair<Place, Place>, int> uses;
  for (const LeafTriangle& t : output.triangles) {
    if (t.side != side) continue;
    for (int i = 0; i < 3; ++i) {
      ++uses[{PlaceOf(output.Corner(t, i)), PlaceOf(output.Corner(t, (i + 1) % 3))}];
    }
  }
  return uses;
}

inline void ExpectSoundOutput(const TriangleMesh& mesh, const Output& output) {
  EXPECT_EQ(output.VerticesInsideEdges(), 0);

  // Areas: each side of each face is covered once, no triangle is turned over.
  std::map<std::pair<int32_t, int>, double> areas;
  for (const LeafTriangle& t : output.triangles) {
    const Vec3d area = output.VectorArea(t);
    areas[{t.face, t.side}] += Length(area);
    EXPECT_GT(Dot(area, Vec3d(mesh.FrontNormal(t.face))), 0) << "face " << t.face;
  }
  for (int32_t face = 0; face < mesh.FaceCount(); ++face) {
    for (int side = 0; side < 2; ++side) {
      // Rounding moves vertices by 1e-7 of coordinates up to ten: 1e-4 of the slivers' width.
      EXPECT_NEAR((areas[{face, side}]), mesh.Area(face), 1e-3 * mesh.Area(face));
    }
  }

  // Water-tight: an edge without a partner lies on an input edge without one.
  std::map<std::pair<Place, Place>, int> input;
  for (const auto& triangle : mesh.triangles) {
    for (size_t i = 0; i < 3; ++i) {
      const Place a = PlaceOf(mesh.positions[size_t(triangle[i])]);
      const Place b = PlaceOf(mesh.positions[size_t(triangle[(i + 1) % 3])]);
      ++input[std::minmax(a, b)];
    }
  }
  for (const Side side : {kFront, kBack}) {
    std::map<std::pair<Place, Place>, int> undirected;
    for (const auto& [edge, count] : EdgeUses(output, side)) {
      undirected[std::minmax(edge.first, edge.second)] += count;
    }
    for (const auto& [edge, count] : undirected) {
      if (count != 1) continue;
      const auto vector = [](const Place& p) {
        return Vec3d(std::get<0>(p), std::get<1>(p), std::get<2>(p));
      };
      const Vec3d p = (vector(edge.first) + vector(edge.second)) * 0.5;
      bool isRim = false;
      for (const auto& [border, faces] : input) {
        const Vec3d a = vector(border.first), ab = vector(border.second) - a;
        // Rounding of floats at coordinates up to ten.
        isRim |= faces == 1 && Length(Cross(ab, p - a)) < 2e-6 * Length(ab);
      }
      EXPECT_TRUE(isRim) << "open edge at " << p.x << " " << p.y << " " << p.z;
    }
  }
}

}  // namespace lambert::testing
