#include "Classical/Core/UniformMesh.h"

#include <gtest/gtest.h>

#include <map>

#include "Common/Core/Error.h"
#include "Common/Testing/TestScenes.h"

namespace lambert {
namespace {

using testing::AddBox;
using testing::AddTriangle;
using testing::BoxMaterials;

float LongestEdge(const UniformMesh& mesh) {
  float longest = 0;
  for (int64_t e = 0; e < mesh.ElementCount(); ++e) {
    for (int c = 0; c < 3; ++c) {
      longest = std::max(longest, Length(mesh.Corner(e, c) - mesh.Corner(e, (c + 1) % 3)));
    }
  }
  return longest;
}

Scene Cube(int n = 1) { return testing::FurnaceCube(0.5f, 1, n); }

std::vector<uint8_t> AllSides(const Scene& scene, uint8_t sides) {
  return std::vector<uint8_t>(scene.mesh.triangles.size(), sides);
}

TEST(UniformMesh, NoEdgeIsLongerThanAskedAndNoAreaIsLost) {
  const Scene scene = Cube();
  for (const double size : {2.0, 0.5, 0.3, 0.07}) {
    const UniformMesh mesh = MakeUniformMesh(scene, size);
    EXPECT_LE(LongestEdge(mesh), size * (1 + 1e-6));  // rounding of lengths in float
    double area = 0;
    std::vector<double> areaOfFace(scene.mesh.triangles.size(), 0);
    for (int64_t e = 0; e < mesh.ElementCount(); ++e) {
      area += double(mesh.Area(e));
      areaOfFace[size_t(mesh.face[size_t(e)])] += double(mesh.Area(e));
      // An element turns the way of its face.
      EXPECT_GT(Dot(mesh.VectorArea(e), scene.mesh.VectorArea(mesh.face[size_t(e)])), 0);
    }
    EXPECT_NEAR(area, 6, 6e-6);  // thousands of areas in float
    for (size_t f = 0; f < areaOfFace.size(); ++f) EXPECT_NEAR(areaOfFace[f], 0.5, 1e-6);
  }
}

// Of a closed box every edge, by position, has two elements: no t-vertices, although each face of
// the box has its own points.
TEST(UniformMesh, EdgesMatchAcrossFaces) {
  Scene scene;
  AddBox(&scene.mesh, {0, 0, 0}, {1, 0.37f, 0.11f}, BoxMaterials(0.5f), true);
  const UniformMesh mesh = MakeUniformMesh(scene, 0.05);
  using Point = std::array<float, 3>;
  std::map<std::pair<Point, Point>, int> edges;
  for (int64_t e = 0; e < mesh.ElementCount(); ++e) {
    for (int c = 0; c < 3; ++c) {
      const Vec3f &a = mesh.Corner(e, c), &b = mesh.Corner(e, (c + 1) % 3);
      const Point p{a.x, a.y, a.z}, q{b.x, b.y, b.z};
      ++edges[{std::min(p, q), std::max(p, q)}];
    }
  }
  for (const auto& [edge, count] : edges) EXPECT_EQ(count, 2);
}

TEST(UniformMesh, PatchesHoldTheirElements) {
  const Scene scene = Cube();
  const UniformMesh mesh = MakeUniformMesh(scene, 0.1, 0.4);
  ASSERT_EQ(mesh.patchBegin.size(), mesh.patches.size() + 1);
  EXPECT_GT(mesh.ElementCount(), 4 * mesh.PatchCount());
  EXPECT_EQ(mesh.patchBegin.back(), mesh.ElementCount());
  for (size_t p = 0; p < mesh.patches.size(); ++p) {
    const auto corner = [&](size_t c) { return mesh.positions[size_t(mesh.patches[p][c])]; };
    const Vec3f area = Cross(corner(1) - corner(0), corner(2) - corner(0)) * 0.5f;
    Vec3f sum;
    for (int32_t e = mesh.patchBegin[p]; e < mesh.patchBegin[p + 1]; ++e) {
      sum += mesh.VectorArea(e);
    }
    EXPECT_LT(Length(sum - area), 1e-6f * Length(area) * 16);  // rounding of some 16 areas
    for (size_t c = 0; c < 3; ++c) EXPECT_LE(Length(corner(c) - corner((c + 1) % 3)), 0.4f);
  }
}

TEST(UniformMesh, RefusesWhatCannotBe) {
  const Scene scene = Cube();
  EXPECT_THROW(MakeUniformMesh(scene, -1), Error);
  EXPECT_THROW(MakeUniformMesh(scene, std::nan("")), Error);
  EXPECT_THROW(MakeUniformMesh(scene, 1e-5), Error);  // 1e11 elements
  Scene bare = scene;
  bare.mesh.normals.clear();
  EXPECT_THROW(MakeUniformMesh(bare, 0.1), Error);
  EXPECT_EQ(MakeUniformMesh(Scene(), 0).ElementCount(), 0);
  EXPECT_NEAR(ResolveElementSize(scene, 0), std::sqrt(3.0) / 50, 1e-7);
}

// Needles, points and lines are cut as far as numbers go, and none is lost.
TEST(UniformMesh, SliversAndDegenerateFacesEnd) {
  Scene scene;
  AddTriangle(&scene.mesh, {0, 0, 0}, {10, 0, 0}, {10, 1e-4f, 0}, Spectrum(0.5f));
  AddTriangle(&scene.mesh, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}, Spectrum(0.5f));
  AddTriangle(&scene.mesh, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, Spectrum(0.5f));
  const float far = 1e6f;  // numbers there are 1/16 apart
  AddTriangle(&scene.mesh, {far, 0, 0}, {far + 1, 0, 0}, {far, 0.01f, 0}, Spectrum(0.5f));
  scene.mesh.normals.assign(scene.mesh.positions.size(), Vec3f(0, 0, 1));
  const UniformMesh mesh = MakeUniformMesh(scene, 0.01);
  std::vector<int> elements(4, 0);
  for (const int32_t face : mesh.face) ++elements[size_t(face)];
  for (const int count : elements) EXPECT_GE(count, 1);
  EXPECT_GE(elements[0], 1000);
  const UniformSolution solution = MakeUniformSolution(scene, mesh, AllSides(scene, 3));
  for (const ElementReceiver& receiver : solution.receivers) {
    EXPECT_TRUE(IsFinite(receiver.position) && IsFinite(receiver.geometric));
  }
}

// A receiver of a box lies inside the box and on a wall: at the corners by a thousandth of the way
// to the centroids of elements of edge 0.25, which are at least a twelfth away from any edge.
TEST(UniformSolution, ReceiversLieInsideTheRoomOnAWall) {
  const Scene scene = Cube();
  const UniformMesh mesh = MakeUniformMesh(scene, 0.4);
  const UniformSolution uniform = MakeUniformSolution(scene, mesh, AllSides(scene, 1));
  ASSERT_EQ(size_t(uniform.PointCount()), uniform.receivers.size());
  for (const ElementReceiver& receiver : uniform.receivers) {
    int walls = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float x = receiver.position[axis];
      if (x == 0 || x == 1) {
        ++walls;
      } else {
        EXPECT_GT(std::min(x, 1 - x), 1e-3f * 0.4f / 16);
      }
    }
    EXPECT_EQ(walls, 1);
    EXPECT_GT(Dot(receiver.geometric, Vec3f(0.5f, 0.5f, 0.5f) - receiver.position), 0);
    EXPECT_NEAR(Dot(receiver.geometric, receiver.normal), 1, 1e-6);
  }
}

// Both sides of a sheet: two sets of points, normals apart, each with its own light.
TEST(UniformSolution, SidesDoNotSharePoints) {
  Scene scene;
  testing::AddQuad(&scene.mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.25f), Spectrum(3.f));
  testing::CompleteTables(&scene);
  const UniformMesh mesh = MakeUniformMesh(scene, 0.3);
  UniformSolution uniform = MakeUniformSolution(scene, mesh, AllSides(scene, 3));
  ASSERT_EQ(uniform.element.size(), 2 * size_t(mesh.ElementCount()));
  std::vector<Spectrum> light(2 * size_t(mesh.ElementCount()));
  for (size_t i = 0; i < light.size(); ++i) light[i] = Spectrum(i % 2 == 0 ? 1.f : 2.f);
  std::vector<Spectrum> irradiance = MeanAboutPoints(uniform, light);
  const RadiositySolution solution = DeliverLight(scene, std::move(uniform), irradiance);
  for (size_t face = 0; face < solution.mesh.triangles.size(); ++face) {
    const Side side = Side(solution.side[face]);
    EXPECT_NEAR(solution.mesh.FrontNormal(int64_t(face)).z, side == kFront ? 1 : -1, 1e-6);
    for (const int32_t point : solution.mesh.triangles[face]) {
      // Means of equal numbers; radiosity is 0.25 E, and the lamp's 3 W/m2 on its front.
      EXPECT_NEAR(solution.irradiance[size_t(point)].g, side == kFront ? 1 : 2, 1e-5);
      EXPECT_NEAR(solution.radiosity[size_t(point)].g, side == kFront ? 3.25 : 0.5, 1e-5);
      EXPECT_NEAR(solution.mesh.normals[size_t(point)].z, side == kFront ? 1 : -1, 1e-6);
    }
  }
  for (const Spectrum& e : solution.inputIrradiance) EXPECT_NEAR(e.r, 2, 1e-5);
}

// Two materials that meet keep their own points, and a face without a lit side is delivered black.
TEST(UniformSolution, SurfacesDoNotSharePoints) {
  Scene scene = Cube();
  scene.mesh.materialId[0] = 1;
  scene.mesh.materialId[1] = 0;
  testing::CompleteTables(&scene);
  std::vector<uint8_t> sides = AllSides(scene, 1);
  sides[0] = 0;
  const UniformMesh mesh = MakeUniformMesh(scene, 2);
  const UniformSolution uniform = MakeUniformSolution(scene, mesh, sides);
  ASSERT_EQ(uniform.element.size(), 12u);
  std::map<int32_t, int32_t> materialOfPoint;
  for (size_t face = 0; face < 12; ++face) {
    for (const int32_t point : uniform.solution.mesh.triangles[face]) {
      const auto [found, isNew] =
          materialOfPoint.try_emplace(point, uniform.solution.mesh.materialId[face]);
      EXPECT_EQ(found->second, uniform.solution.mesh.materialId[face]);
    }
  }
}

}  // namespace
}  // namespace lambert
