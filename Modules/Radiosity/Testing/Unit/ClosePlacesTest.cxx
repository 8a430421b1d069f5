// In which triangles places lie, and what a solution makes of what lies close to a floor.
#include "Radiosity/Core/ClosePlaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "Common/Core/Barycentric.h"
#include "SolverScenes.h"
#include "Visibility/Core/SolutionLookup.h"

namespace lambert {
namespace {

/// Whether a place lies in a triangle of the mesh, by its corners.
bool Holds(const RefinedMesh& mesh, size_t triangle, const Vec3f& place) {
  const auto& p = mesh.PointsOfTriangles()[triangle];
  Box3f box;
  for (const int32_t point : p) box.Include(mesh.Points()[size_t(point)].position);
  return place.x >= box.low.x && place.x <= box.high.x && place.y >= box.low.y &&
         place.y <= box.high.y;
}

TEST(ClosePlaces, AreFoundInTrianglesFromCutToCut) {
  testing::ModelledScene modelled;
  testing::AddQuad(&modelled.scene.mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.5f));
  modelled.Model();
  RefinedMesh mesh(&*modelled.hierarchy, modelled.lit, RefinedMesh::Use::Gather);

  // Two in one triangle, one in its border, one on the other side.
  const TriangleMesh& input = modelled.scene.mesh;
  const auto at = [&](float a, float b, float c) {
    return input.Corner(0, 0) * a + input.Corner(0, 1) * b + input.Corner(0, 2) * c;
  };
  const Vec3f inside = at(0.3f, 0.25f, 0.45f), nearCorner = at(0.9f, 0.06f, 0.04f);
  const std::vector<ClosePlace> places = {{0, kFront, inside, 0.5f},
                                          {0, kFront, nearCorner, 0.7f},
                                          {0, kFront, input.Corner(0, 0), 1.f},
                                          {0, kBack, inside, 0.3f}};
  ClosePlaces close(places);
  LeafMesh& leaves = modelled.hierarchy->Leaves();
  std::vector<const ClosePlace*> found = close.InTriangles(mesh, leaves);
  ASSERT_EQ(found.size(), mesh.Triangles().size());
  int count = 0;
  for (size_t t = 0; t < found.size(); ++t) {
    const LeafTriangle& triangle = mesh.Triangles()[t];
    const bool isThere = triangle.face == 0;
    EXPECT_EQ(found[t] != nullptr, isThere);
    if (!found[t]) continue;
    ++count;
    EXPECT_EQ(found[t], triangle.side == kFront ? &places[1] : &places[3]);
  }
  EXPECT_EQ(count, 2);

  // Cut until both lie in triangles of their own.
  std::vector<int32_t> parts = leaves.Split(leaves.FacePatch(0, kFront));
  for (const int32_t part : parts) leaves.Split(part);
  mesh.Triangulate();
  found = close.InTriangles(mesh, leaves);
  std::array<bool, 2> isFound{};
  for (size_t t = 0; t < found.size(); ++t) {
    if (!found[t] || found[t]->side == kBack) continue;
    EXPECT_TRUE(Holds(mesh, t, found[t]->position));
    isFound[size_t(found[t] - places.data())] = true;
  }
  EXPECT_TRUE(isFound[0]);
  EXPECT_TRUE(isFound[1]);
}

/// The floor below has at least 0.5 W/m2 where nothing hides the lamp.
constexpr float kDark = 0.3f;

TEST(ClosePlaces, BringShadowsOfSmallThingsToLight) {
  // Twelve plates of 16 cm, 2 cm above a floor of 6 m that has two triangles. Asked in the middle
  // of triangles alone, it has five of their shadows.
  Scene scene;
  testing::AddQuad(&scene.mesh, {0, 0, 0}, {6, 0, 0}, {0, 6, 0}, Spectrum(0.5f));
  testing::AddQuad(&scene.mesh, {2, 2, 4}, {0, 2, 0}, {2, 0, 0}, Spectrum(0.f), Spectrum(10.f), 1,
                   1);
  std::vector<Vec3f> middles;
  Random random(7);
  for (int i = 0; i < 12; ++i) {
    const float x = 0.3f + 5.4f * random.Uniform(), y = 0.3f + 5.4f * random.Uniform();
    middles.push_back({x, y, 0});
    testing::AddQuad(&scene.mesh, {x - 0.08f, y - 0.08f, 0.02f}, {0.16f, 0, 0}, {0, 0.16f, 0},
                     Spectrum(0.5f), Spectrum(0.f), 1, 2 + i);
  }
  testing::CompleteTables(&scene);
  const testing::SolvedScene solved = testing::SolveScene(std::move(scene), 0.1);
  const SolutionLookup lookup(solved.solution, solved.scene.mesh.FaceCount());
  const TriangleMesh& mesh = solved.scene.mesh;
  int dark = 0;
  for (int32_t face = 0; face < int32_t(mesh.FaceCount()); ++face) {
    const bool isFloor = mesh.Area(face) > 10;
    for (const Vec3f& middle : middles) {
      const auto weights = BarycentricWeights(mesh.Corner(face, 0), mesh.Corner(face, 1),
                                              mesh.Corner(face, 2), middle);
      if (!isFloor || std::min({weights->x, weights->y, weights->z}) < 0) continue;
      const float light = lookup.Irradiance(lookup.Find(face, kFront, middle)).Mean();
      dark += light < kDark ? 1 : 0;
    }
  }
  EXPECT_GE(dark, 11);
}

}  // namespace
}  // namespace lambert
