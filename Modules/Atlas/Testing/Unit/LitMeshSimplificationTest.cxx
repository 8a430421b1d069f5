// What simplification takes out of lit walls, and what it leaves.
#include "Atlas/Core/LitMeshSimplification.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

#include "Common/Core/Error.h"
#include "Common/Core/Random.h"
#include "Visibility/Core/SolutionLookup.h"

namespace lambert {
namespace {

using LightAt = std::function<Spectrum(float, float)>;

/// A wall of two input faces, [0, 1]^2 at height 0, refined into n x n x 2 triangles that share
/// their points.
void AddWall(RadiositySolution* solution, int n, const LightAt& light) {
  TriangleMesh& mesh = solution->mesh;
  const int32_t first = int32_t(mesh.positions.size());
  const int64_t face = solution->inputFaceId.empty() ? 0 : solution->inputFaceId.back() + 1;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const float x = float(i) / float(n), y = float(j) / float(n);
      mesh.positions.push_back({x, y, 0});
      mesh.normals.push_back({0, 0, 1});
      solution->irradiance.push_back(light(x, y));
      solution->radiosity.push_back(light(x, y) * 0.5f);
    }
  }
  // The diagonal of the wall is the edge between its faces.
  const auto add = [&](int32_t a, int32_t b, int32_t c, bool isAbove) {
    mesh.triangles.push_back({first + a, first + b, first + c});
    solution->inputFaceId.push_back(face + isAbove);
    solution->side.push_back(kFront);
    solution->leafId.push_back(int64_t(solution->leafId.size()));
  };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int32_t a = j * (n + 1) + i, b = a + 1, d = a + n + 1, c = d + 1;
      add(a, b, c, i < j);
      add(a, c, d, j >= i);
    }
  }
}

RadiositySolution Wall(int n, const LightAt& light) {
  RadiositySolution wall;
  AddWall(&wall, n, light);
  wall.mesh.Complete();
  return wall;
}

/// The largest change of light at random places, over the larger of the light and `mean`.
double LargestChange(const RadiositySolution& before, const RadiositySolution& after, double mean) {
  const SolutionLookup old(before, 2), now(after, 2);
  double largest = 0;
  Random random(7);
  for (int i = 0; i < 4000; ++i) {
    const float x = random.Uniform(), y = random.Uniform();
    const int64_t face = y > x;
    const Vec3f place(x, y, 0);
    const Spectrum was = old.Irradiance(old.Find(face, kFront, place));
    const Spectrum is = now.Irradiance(now.Find(face, kFront, place));
    for (const double change : {is.r - was.r, is.g - was.g, is.b - was.b}) {
      largest = std::max(largest, std::abs(change) / std::max(double(is.Mean()), mean));
    }
  }
  return largest;
}

// What is reflected differs from face to face of a texture, however even the light: of a wall whose
// right half is dark, radiosity at the places of points stays within the tolerance.
TEST(LitMeshSimplification, KeepsRadiosityToo) {
  const RadiositySolution even = Wall(16, [](float, float) { return Spectrum(1); });
  RadiositySolution wall = even;
  for (size_t point = 0; point < wall.radiosity.size(); ++point) {
    wall.radiosity[point] = Spectrum(wall.mesh.positions[point].x > 0.5f ? 0.1f : 0.9f);
  }
  const RadiositySolution simple = SimplifyLitMesh(wall, {0.05});
  EXPECT_LT(simple.mesh.FaceCount(), wall.mesh.FaceCount() / 2);
  EXPECT_GT(simple.mesh.FaceCount(), SimplifyLitMesh(even, {0.05}).mesh.FaceCount());
  // As irradiance, which is what LargestChange looks at.
  RadiositySolution before = wall, after = simple;
  before.irradiance = wall.radiosity, after.irradiance = simple.radiosity;
  EXPECT_LE(LargestChange(before, after, 0.5), 0.05 + 1e-4);
}

TEST(LitMeshSimplification, LeavesTwoTrianglesOfAnEvenlyLitWall) {
  RadiositySolution wall = Wall(16, [](float, float) { return Spectrum(2); });
  LitMeshSimplificationStatistics statistics;
  const RadiositySolution simple = SimplifyLitMesh(wall, {0.01}, &statistics);
  EXPECT_EQ(simple.mesh.FaceCount(), 2);
  EXPECT_EQ(simple.mesh.PointCount(), 4);
  EXPECT_EQ(statistics.trianglesBefore, 512);
  EXPECT_EQ(statistics.trianglesAfter, 2);
  EXPECT_EQ(std::set<int64_t>(simple.inputFaceId.begin(), simple.inputFaceId.end()).size(), 2);
  EXPECT_TRUE(simple.leafId.empty());
  for (const Spectrum& light : simple.irradiance) EXPECT_EQ(light.r, 2);
}

TEST(LitMeshSimplification, LeavesTheEdgeOfAShadow) {
  const int n = 32;
  const RadiositySolution wall =
      Wall(n, [](float x, float) { return Spectrum(x < 0.5f ? 0.2f : 2); });
  const RadiositySolution simple = SimplifyLitMesh(wall, {0.05});
  EXPECT_LT(simple.mesh.FaceCount(), wall.mesh.FaceCount() / 4);
  // Light is linear between the points: it changes within one old triangle from the edge, or not
  // at all.
  EXPECT_LT(LargestChange(wall, simple, 1.1), 0.05 + 1e-5);
  for (const auto& triangle : simple.mesh.triangles) {
    bool isDark = false, isLit = false;
    float low = 1, high = 0;
    for (const int32_t corner : triangle) {
      (simple.irradiance[size_t(corner)].r < 1 ? isDark : isLit) = true;
      low = std::min(low, simple.mesh.positions[size_t(corner)].x);
      high = std::max(high, simple.mesh.positions[size_t(corner)].x);
    }
    if (isDark && isLit) {
      EXPECT_NEAR(high - low, 1. / n, 1e-6);
    }
  }
}

TEST(LitMeshSimplification, KeepsToTheToleranceEverywhere) {
  // A highlight, in colours that fall off differently.
  RadiositySolution wall = Wall(24, [](float x, float y) {
    const float r2 = (x - 0.4f) * (x - 0.4f) + (y - 0.55f) * (y - 0.55f);
    return Spectrum(0.5f + std::exp(-8 * r2), 0.4f + std::exp(-20 * r2), 0.3f + 0.5f * x);
  });
  double mean = 0;  // All triangles are of one size.
  for (const auto& triangle : wall.mesh.triangles) {
    for (const int32_t corner : triangle) {
      mean += double(wall.irradiance[size_t(corner)].Mean()) / 3 / double(wall.mesh.FaceCount());
    }
  }
  int64_t before = wall.mesh.FaceCount();
  for (const double tolerance : {0.005, 0.02, 0.08}) {
    const RadiositySolution simple = SimplifyLitMesh(wall, {tolerance});
    EXPECT_LT(LargestChange(wall, simple, mean), tolerance + 1e-5) << tolerance;  // Floats.
    EXPECT_LT(simple.mesh.FaceCount(), before) << tolerance;
    before = simple.mesh.FaceCount();

    // The faces are covered as they were, each triangle within its own.
    double area[2] = {0, 0};
    for (int64_t face = 0; face < simple.mesh.FaceCount(); ++face) {
      EXPECT_GT(simple.mesh.VectorArea(face).z, 0);
      area[simple.inputFaceId[size_t(face)]] += double(simple.mesh.Area(face));
    }
    EXPECT_NEAR(area[0], 0.5, 1e-6);
    EXPECT_NEAR(area[1], 0.5, 1e-6);
  }
}

/// Two walls with points of their own: one lies, the other stands on its edge y = 0.
RadiositySolution Corner(int n, const LightAt& lying, const LightAt& standing) {
  RadiositySolution room;
  AddWall(&room, n, lying);
  const size_t points = room.mesh.positions.size(), triangles = room.mesh.triangles.size();
  AddWall(&room, n, standing);
  for (size_t point = points; point < room.mesh.positions.size(); ++point) {
    std::swap(room.mesh.positions[point].y, room.mesh.positions[point].z);
  }
  for (size_t face = triangles; face < room.mesh.triangles.size(); ++face) {
    std::swap(room.mesh.triangles[face][1], room.mesh.triangles[face][2]);
  }
  room.mesh.Complete();
  return room;
}

TEST(LitMeshSimplification, LeavesBordersClosed) {
  // Even light on both sides of the corner, and a shadow across one of them.
  const int n = 16;
  const auto even = [](float, float) { return Spectrum(1); };
  const auto shadow = [](float x, float) { return Spectrum(x < 0.5f ? 0.2f : 1); };
  EXPECT_EQ(SimplifyLitMesh(Corner(n, even, even), {0.05}).mesh.FaceCount(), 4);
  const RadiositySolution simple = SimplifyLitMesh(Corner(n, even, shadow), {0.05});
  std::vector<float> lying, standing;
  for (size_t face = 0; face < simple.mesh.triangles.size(); ++face) {
    for (const int32_t corner : simple.mesh.triangles[face]) {
      const Vec3f& p = simple.mesh.positions[size_t(corner)];
      if (p.y == 0 && p.z == 0) (simple.inputFaceId[face] < 2 ? lying : standing).push_back(p.x);
    }
  }
  // Where one has a point on their edge the other has one, too.
  EXPECT_EQ(std::set<float>(lying.begin(), lying.end()),
            std::set<float>(standing.begin(), standing.end()));
  EXPECT_LT(std::set<float>(lying.begin(), lying.end()).size(), size_t(n) / 2);
  EXPECT_GE(std::set<float>(lying.begin(), lying.end()).size(), 4u);  // Ends and the shadow's.
}

TEST(LitMeshSimplification, LeavesBordersThatDoNotJoin) {
  // The same with the standing wall wound the other way: no manifold has both.
  const int n = 8;
  const auto even = [](float, float) { return Spectrum(1); };
  RadiositySolution room = Corner(n, even, even);
  for (size_t face = 0; face < room.mesh.triangles.size(); ++face) {
    if (room.inputFaceId[face] < 2) continue;
    std::swap(room.mesh.triangles[face][1], room.mesh.triangles[face][2]);
  }
  const RadiositySolution simple = SimplifyLitMesh(room, {0.05});
  EXPECT_LT(simple.mesh.FaceCount(), room.mesh.FaceCount() / 2);
  int onEdge = 0;
  for (const Vec3f& p : simple.mesh.positions) onEdge += p.y == 0 && p.z == 0;
  EXPECT_EQ(onEdge, 2 * (n + 1));
}

TEST(LitMeshSimplification, LeavesWhatIsNotManifold) {
  RadiositySolution wall = Wall(4, [](float, float) { return Spectrum(1); });
  const std::array<int32_t, 3> twice = wall.mesh.triangles[9];
  wall.mesh.triangles.push_back(twice);
  wall.mesh.reflectance.push_back(Spectrum(0.25f));
  wall.mesh.emittance.push_back(Spectrum(0.f));
  wall.mesh.faceFlags.push_back(0);
  wall.mesh.materialId.push_back(0);
  wall.mesh.partId.push_back(0);
  wall.mesh.sourceCellId.push_back(0);
  wall.inputFaceId.push_back(0);
  wall.side.push_back(kFront);
  const RadiositySolution simple = SimplifyLitMesh(wall, {0.05});
  EXPECT_LT(simple.mesh.FaceCount(), 20);
  const auto& last = simple.mesh.triangles.back();
  EXPECT_EQ(simple.mesh.reflectance.back().r, 0.25f);
  for (size_t corner = 0; corner < 3; ++corner) {
    const Vec3f was = wall.mesh.positions[size_t(twice[corner])];
    const Vec3f is = simple.mesh.positions[size_t(last[corner])];
    EXPECT_TRUE(was == is);
  }
}

TEST(LitMeshSimplification, RefusesWhatIsNoTolerance) {
  RadiositySolution wall = Wall(40, [](float, float) { return Spectrum(1); });
  for (const double tolerance : {0., -0.1, 1.5, std::nan("")}) {
    EXPECT_THROW(SimplifyLitMesh(wall, {tolerance}), Error);
  }
  EXPECT_THROW(SimplifyLitMesh(wall, {}, nullptr, [](double, const char*) { return false; }),
               Cancelled);
  EXPECT_EQ(SimplifyLitMesh({}, {}).mesh.FaceCount(), 0);
}

}  // namespace
}  // namespace lambert
