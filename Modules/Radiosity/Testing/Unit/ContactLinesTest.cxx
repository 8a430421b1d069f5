// Where the feet of things are found, and what a solution makes of them.
#include "Radiosity/Core/ContactLines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "Radiosity/Testing/Unit/SolverScenes.h"

namespace lambert {
namespace {

const std::vector<Vec3f> kFloor = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

/// What stands on the floor [0, 1]^2: a quad with a corner and two sides.
std::vector<ContactLine> LinesOf(const Vec3f& corner, const Vec3f& u, const Vec3f& v) {
  Scene scene;
  testing::AddQuad(&scene.mesh, kFloor[0], {1, 0, 0}, {0, 1, 0}, Spectrum(0.5f));
  testing::AddQuad(&scene.mesh, corner, u, v, Spectrum(0.5f));
  testing::CompleteTables(&scene);
  scene.mesh.Complete();
  const RayScene rayScene(scene.mesh);
  int64_t rays = 0;
  const std::vector<ContactLine> lines = FindContactLines(rayScene, kFloor, {0, 0, 1}, &rays);
  EXPECT_GT(rays, 0);
  EXPECT_GE(rays, int64_t(lines.size()));
  return lines;
}

TEST(ContactLines, LieAtTheFootOfAWall) {
  const std::vector<ContactLine> lines = LinesOf({0.3f, 0, 0}, {0, 1, 0}, {0, 0, 1});
  ASSERT_FALSE(lines.empty());
  for (const ContactLine& line : lines) {
    EXPECT_NEAR(line.position.x, 0.3f, 1e-5f);
    EXPECT_NEAR(line.position.z, 0, 1e-6f);
    EXPECT_NEAR(std::abs(line.across.x), 1, 1e-6f);
  }
}

TEST(ContactLines, LieAtTheFootOfWhatLeans) {
  // It overhangs by 45 degrees: a ray a millimetre above the floor meets it a millimetre further
  // on.
  const std::vector<ContactLine> lines = LinesOf({0.3f, 0, 0}, {0, 1, 0}, {1, 0, 1});
  ASSERT_FALSE(lines.empty());
  for (const ContactLine& line : lines) {
    EXPECT_NEAR(line.position.x, 0.3f, 1e-5f);
    EXPECT_NEAR(std::abs(line.across.x), 1, 1e-6f);
  }
}

TEST(ContactLines, AreNotWhereNothingStands) {
  EXPECT_TRUE(LinesOf({0.3f, 0, 0.1f}, {0, 1, 0}, {0, 0, 1}).empty());     // It hangs.
  EXPECT_TRUE(LinesOf({0.3f, 0, 0}, {0, 1, 0}, {0.6f, 0, 0.1f}).empty());  // It lies.
  EXPECT_TRUE(LinesOf({2, 0, 0}, {0, 1, 0}, {0, 0, 1}).empty());           // It stands elsewhere.
}

TEST(ContactLines, TellLightFromDark) {
  const Spectrum light(1.f), dark(0.1f);
  const std::vector<KnownLight> places = {
      {{0, 0, 0}, light}, {{0, 1, 0}, light}, {{1, 0, 0}, dark}, {{1, 1, 0}, dark}};
  const std::vector<ContactLine> lines = {
      {{0.5f, 0.5f, 0}, {0, 1, 0}}, {{0.3f, 0, 0}, {-1, 0, 0}}, {{2, 0, 0}, {1, 0, 0}}};
  EXPECT_EQ(TellingLine(lines, places), &lines[1]);
  EXPECT_EQ(TellingLine({lines[0], lines[2]}, places), nullptr);
}

TEST(ContactLines, KeepDarknessUnderWhatStandsThere) {
  // A box on a floor, askew, under a lamp. Of the 1 m2 below it few are in triangles that are lit
  // at one corner and dark at another.
  Scene scene;
  testing::AddQuad(&scene.mesh, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}, Spectrum(0.5f));
  testing::AddQuad(&scene.mesh, {1, 1, 4}, {0, 2, 0}, {2, 0, 0}, Spectrum(0.f), Spectrum(10.f), 1,
                   1);
  const Vec3f u{0.87f, 0.5f, 0}, v{-0.5f, 0.87f, 0}, up{0, 0, 0.8f}, corner{1.6f, 1.1f, 0};
  for (const auto& [at, side] : {std::pair(corner, u), std::pair(corner + u, v),
                                 std::pair(corner + u + v, -u), std::pair(corner + v, -v)}) {
    testing::AddQuad(&scene.mesh, at, side, up, Spectrum(0.5f), Spectrum(0.f), 2, 7);
  }
  testing::AddQuad(&scene.mesh, corner + up, u, v, Spectrum(0.5f), Spectrum(0.f), 2, 8);
  testing::CompleteTables(&scene);
  const testing::SolvedScene solved = testing::SolveScene(std::move(scene), 0.05);

  const RadiositySolution& s = solved.solution;
  double straddling = 0;
  for (int64_t t = 0; t < s.mesh.FaceCount(); ++t) {
    float least = std::numeric_limits<float>::max(), most = 0, top = 0;
    for (int c = 0; c < 3; ++c) {
      const Spectrum& light = s.irradiance[size_t(s.mesh.triangles[size_t(t)][size_t(c)])];
      least = std::min(least, light.Mean());
      most = std::max(most, light.Mean());
      top = std::max(top, s.mesh.Corner(t, c).z);
    }
    if (top > 0) continue;
    const double area = double(s.mesh.Area(t));
    if (most > 0.15f && least < 0.02f) straddling += area;
  }

  // 0.07 to 0.15 by chance of rays; 0.19 to 0.25 where it is halved and cut along edges of light
  // alone.
  EXPECT_LT(straddling, 0.17);
}

}  // namespace
}  // namespace lambert
