// Cells cover the surface once, however it is cut into triangles.
#include "Classical/Core/ElementCells.h"

#include <gtest/gtest.h>

#include <set>

#include "Common/Core/Error.h"
#include "Common/Testing/TestScenes.h"

namespace lambert {
namespace {

double SumOfAreas(const ElementCells& cells) {
  double sum = 0;
  for (int32_t cell = 0; cell < cells.Size(); ++cell) sum += double(cells.Area(cell));
  return sum;
}

TEST(ElementCells, CoverEveryTriangle) {
  // Large and small triangles, a long sliver, and one that the grid cuts unevenly.
  TriangleMesh mesh;
  const Spectrum grey(0.5f);
  testing::AddTriangle(&mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, grey);
  testing::AddTriangle(&mesh, {0, 0, 1}, {0.01f, 0, 1}, {0, 0.01f, 1}, grey);
  testing::AddTriangle(&mesh, {0, 0, 2}, {3, 0, 2}, {3, 0.002f, 2}, grey);
  testing::AddTriangle(&mesh, {0, 0, 3}, {0.37f, 0.05f, 3}, {0.11f, 0.93f, 3}, grey);
  const ElementCells cells(mesh, 0.1);
  double area = 0;
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) area += double(mesh.Area(face));
  EXPECT_NEAR(SumOfAreas(cells), area, 1e-6);  // Sums of floats near 1.

  // Every place has a cell, and a cell holds its own places.
  Random random(1);
  std::set<int32_t> found;
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    for (int i = 0; i < 5000; ++i) {
      const float u = random.Uniform(), v = random.Uniform();
      const int32_t cell = cells.At(face, UniformTriangle(u, v));
      ASSERT_GE(cell, 0);
      ASSERT_LT(cell, cells.Size());
      found.insert(cell);
    }
    for (const Vec2f& corner : {Vec2f(0, 0), Vec2f(1, 0), Vec2f(0, 1), Vec2f(0.5f, 0.5f)}) {
      EXPECT_GE(cells.At(face, corner), 0);
    }
  }
  EXPECT_GT(found.size(), size_t(cells.Size()) * 9 / 10);
  for (int32_t cell = 0; cell < cells.Size(); ++cell) {
    const SurfacePlace place = cells.Sample(cell, kBack, &random);
    ASSERT_GE(place.face, 0);
    EXPECT_EQ(place.normal, -mesh.FrontNormal(place.face));
    EXPECT_NEAR(double(Dot(place.position - mesh.Corner(place.face, 0), place.normal)), 0, 1e-6);
  }
}

TEST(ElementCells, DoNotSeeTheTessellation) {
  const auto cellsOf = [](int n) {
    TriangleMesh mesh;
    testing::AddQuad(&mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.5f), Spectrum(0.f), n);
    return ElementCells(mesh, 0.1).Size();
  };
  EXPECT_LE(cellsOf(200), 121);  // 80,000 triangles in cubes that meet 11 x 11 pieces.
  EXPECT_LE(cellsOf(1), 200);    // Two triangles, with half cells along the diagonal.
}

TEST(ElementCells, ApartWhereSurfacesAre) {
  // Two sheets a hair apart, of one part and facing alike, share no cell.
  TriangleMesh mesh;
  testing::AddQuad(&mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.2f), Spectrum(0.f), 40);
  testing::AddQuad(&mesh, {0, 0, 0.01f}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.8f), Spectrum(0.f), 40);
  const ElementCells cells(mesh, 0.1);
  for (int32_t cell = 0; cell < cells.Size(); ++cell) {
    const float rho = cells.Reflectance(cell).g;
    EXPECT_TRUE(std::abs(rho - 0.2f) < 1e-5f || std::abs(rho - 0.8f) < 1e-5f) << rho;
  }
}

TEST(ElementCells, RefuseToBeTooSmall) {
  TriangleMesh mesh;
  testing::AddQuad(&mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.5f));
  EXPECT_THROW(ElementCells(mesh, 1e-5), Error);
}

TEST(ElementCells, TakeWhatHasNoArea) {
  TriangleMesh mesh;
  testing::AddTriangle(&mesh, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, Spectrum(0.5f));
  testing::AddTriangle(&mesh, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}, Spectrum(0.5f));
  const ElementCells cells(mesh, 0.5);
  EXPECT_EQ(SumOfAreas(cells), 0);
  EXPECT_GE(cells.At(0, {0.3f, 0.3f}), 0);
}

}  // namespace
}  // namespace lambert
