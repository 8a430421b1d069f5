// What both matrix and progressive radiosity must get right, against closed forms.
#include <gtest/gtest.h>

#include <functional>

#include "Classical/Core/MatrixRadiosity.h"
#include "Classical/Core/ProgressiveRadiosity.h"
#include "Common/Core/Error.h"
#include "Common/Core/Parallel.h"
#include "Common/Core/Random.h"
#include "Common/Testing/DoubledSheet.h"
#include "Common/Testing/TestScenes.h"
#include "Visibility/Core/SolutionLookup.h"

namespace lambert {
namespace {

struct Solved {
  RadiositySolution solution;
  SolverStatistics statistics;
};

struct Method {
  const char* name;
  std::function<Solved(const Scene&, double elementSize)> solve;
};

/// Both stop when a thousandth of the light, at most, is missing.
Solved ByMatrix(const Scene& scene, double elementSize) {
  Solved solved;
  MatrixRadiosityOptions options;
  options.elementSize = elementSize;
  solved.solution = SolveMatrixRadiosity(scene, options, &solved.statistics);
  return solved;
}
Solved ByShooting(const Scene& scene, double elementSize) {
  Solved solved;
  ProgressiveRadiosityOptions options;
  options.elementSize = elementSize;
  options.unshot = 5e-4;
  solved.solution = SolveProgressiveRadiosity(scene, options, &solved.statistics);
  return solved;
}

class ClassicalMethods : public ::testing::TestWithParam<Method> {
 protected:
  Solved Solve(const Scene& scene, double elementSize) const {
    return GetParam().solve(scene, elementSize);
  }
};

double Range(const std::vector<Spectrum>& values, bool largest) {
  double found = double(values.front().g);
  for (const Spectrum& v : values) {
    found = largest ? std::max(found, double(v.g)) : std::min(found, double(v.g));
  }
  return found;
}

/// Mean radiosity over the faces of a material.
double MeanRadiosity(const RadiositySolution& solution, int32_t material) {
  double sum = 0, area = 0;
  for (size_t face = 0; face < solution.mesh.triangles.size(); ++face) {
    if (solution.mesh.materialId[face] != material) continue;
    const double faceArea = double(solution.mesh.Area(int64_t(face)));
    for (const int32_t point : solution.mesh.triangles[face]) {
      sum += faceArea * double(solution.radiosity[size_t(point)].g) / 3;
    }
    area += faceArea;
  }
  return sum / area;
}

void ExpectBalance(const SolverStatistics& s, double tolerance) {
  for (int band = 0; band < 3; ++band) {
    EXPECT_NEAR(s.emitted[band], s.absorbed[band] + s.escaped[band],
                tolerance * double(s.emitted[band]));
  }
}

// Every row sums to 1 to a thousandth, which (1 - rho) divides; progressive leaves 5e-4 of the
// light unshot, which grows the same way.
TEST_P(ClassicalMethods, Furnace) {
  for (const float rho : {0.5f, 0.8f, 0.95f}) {
    const Solved solved = Solve(testing::FurnaceCube(rho), 0.3);
    const double expected = 1 / (1 - double(rho)), tolerance = 1.5e-3 / (1 - double(rho));
    EXPECT_NEAR(Range(solved.solution.radiosity, false), expected, tolerance * expected);
    EXPECT_NEAR(Range(solved.solution.radiosity, true), expected, tolerance * expected);
    EXPECT_EQ(solved.statistics.stoppedBy, "error");
  }
}

double IrradianceAt(const Scene& scene, const RadiositySolution& solution, const Vec3f& position,
                    const Vec3f& normal) {
  const SolutionLookup lookup(solution, scene.mesh.FaceCount());
  for (int64_t face = 0; face < scene.mesh.FaceCount(); ++face) {
    // The face that the point lies on, by the areas of its three parts.
    if (Dot(scene.mesh.FrontNormal(face), normal) < 0.99f) continue;
    float sum = 0;
    for (int c = 0; c < 3; ++c) {
      sum += 0.5f * Length(Cross(scene.mesh.Corner(face, c) - position,
                                 scene.mesh.Corner(face, (c + 1) % 3) - position));
    }
    if (sum > scene.mesh.Area(face) * 1.00001f) continue;
    return double(lookup.Irradiance(lookup.Find(face, kFront, position)).g);
  }
  ADD_FAILURE() << "no face at the point";
  return 0;
}

// Elements of edges 1/16: between vertices the light bends by h^2/8 E'' = 0.002 at most where
// E'' = 4 E, and as much comes of elements standing for their vertices. Near the corner E falls by
// half within 0.05, over less than an element.
TEST_P(ClassicalMethods, RoomUnderABrightCeiling) {
  const Scene scene = testing::BoxRoom(1, 0.5f, 1);
  const Solved solved = Solve(scene, 0.09);
  const auto floor = [&](float x, float y) {
    return IrradianceAt(scene, solved.solution, {x, y, 0}, {0, 0, 1});
  };
  EXPECT_NEAR(floor(0.5f, 0.5f), 0.35828, 0.004);
  EXPECT_NEAR(floor(0.25f, 0.25f), 0.32181, 0.004);
  EXPECT_NEAR(floor(0.05f, 0.05f), 0.2463, 0.02);
  const auto wall = [&](float z) {
    return IrradianceAt(scene, solved.solution, {0, 0.5f, z}, {1, 0, 0});
  };
  EXPECT_NEAR(wall(0.5f), 0.32242, 0.004);
  EXPECT_NEAR(wall(0.75f), 0.4387, 0.006);
  // Means are of the same equations, and lose nothing but the quadrature of 1e-3 and 5e-4 unshot.
  EXPECT_NEAR(MeanRadiosity(solved.solution, testing::kFloor), 0.15517, 1.5e-3 * 0.15517 + 2e-4);
  EXPECT_NEAR(MeanRadiosity(solved.solution, testing::kMinusX), 0.16400, 1.5e-3 * 0.164 + 2e-4);
  // In a closed room all is absorbed, but 1e-3; no ray escapes.
  ExpectBalance(solved.statistics, 2e-3);
  EXPECT_EQ(solved.statistics.escaped.g, 0);
}

// Any point of a sphere sees a cap by the cap's part f of the area. The facets of 12 stacks differ
// from the sphere by 1 - cos(pi/24) = 0.9 %, of which (1 - rho (1 - f)) makes more.
TEST_P(ClassicalMethods, IntegratingSphereWithAPort) {
  const float rho = 0.9f;
  const int stacks = 12;
  Scene scene;
  testing::AddSphere(&scene.mesh, {0, 0, 0}, 1, stacks, Spectrum(rho), Spectrum(1.f), true);
  testing::CompleteTables(&scene);
  // Open the cap above the second ring of points.
  TriangleMesh& mesh = scene.mesh;
  size_t kept = 0;
  double area = 0, all = 0;
  for (size_t face = 0; face < mesh.triangles.size(); ++face) {
    const Vec3f centre = (mesh.Corner(int64_t(face), 0) + mesh.Corner(int64_t(face), 1) +
                          mesh.Corner(int64_t(face), 2)) /
                         3.f;
    all += double(mesh.Area(int64_t(face)));
    if (double(centre.z) > std::cos(2 * kPi / stacks)) continue;
    area += double(mesh.Area(int64_t(face)));
    mesh.triangles[kept++] = mesh.triangles[face];
  }
  mesh.triangles.resize(kept);
  for (auto* values : {&mesh.reflectance, &mesh.emittance}) values->resize(kept);
  mesh.faceFlags.resize(kept);
  for (auto* ids : {&mesh.materialId, &mesh.partId}) ids->resize(kept);
  mesh.sourceCellId.resize(kept);
  const double f = (1 - std::cos(2 * kPi / stacks)) / 2;

  const Solved solved = Solve(scene, 1);
  const double expected = 1 / (1 - double(rho) * (1 - f));
  double sum = 0;
  for (size_t face = 0; face < solved.solution.mesh.triangles.size(); ++face) {
    if (solved.solution.side[face] == kBack) continue;
    for (const int32_t point : solved.solution.mesh.triangles[face]) {
      sum += double(solved.solution.mesh.Area(int64_t(face))) *
             double(solved.solution.radiosity[size_t(point)].g) / 3;
    }
  }
  EXPECT_NEAR(sum / area, expected,
              0.009 * f * expected * expected * double(rho) + 0.009 * expected);
  // What leaves by the port, by 32768 rays of which f escape: 3 standard deviations, and the two
  // above.
  ExpectBalance(solved.statistics, 3 * std::sqrt(f / 32768) / f * 0.5 + 0.012);
}

// A closed box on the floor of a room is dark inside: its inner sides, and the floor below it as
// seen from within, get no light to speak of and are not modelled.
TEST_P(ClassicalMethods, OnlyLitSidesAreDelivered) {
  Scene scene = testing::BoxRoom(1, 0.5f, 1);
  const size_t roomFaces = scene.mesh.triangles.size();
  testing::AddBox(&scene.mesh, {0.3f, 0.3f, 0}, {0.7f, 0.7f, 0.4f}, testing::BoxMaterials(0.5f),
                  false, 1, 6);
  testing::CompleteTables(&scene);
  const Solved solved = Solve(scene, 0.15);
  std::vector<int> sidesOfFace(scene.mesh.triangles.size(), 0);
  for (size_t face = 0; face < solved.solution.side.size(); ++face) {
    EXPECT_EQ(solved.solution.side[face], kFront);
    sidesOfFace[size_t(solved.solution.inputFaceId[face])] |= 1 << solved.solution.side[face];
  }
  for (size_t face = 0; face < sidesOfFace.size(); ++face) EXPECT_EQ(sidesOfFace[face], 1);
  // The bottom of the box, which lies on the floor, is delivered black.
  for (size_t face = 0; face < solved.solution.side.size(); ++face) {
    if (scene.mesh.materialId[size_t(solved.solution.inputFaceId[face])] != 6 + testing::kFloor) {
      continue;
    }
    for (const int32_t p : solved.solution.mesh.triangles[face]) {
      EXPECT_LT(solved.solution.irradiance[size_t(p)].g, 1e-6f);
    }
  }
  EXPECT_EQ(roomFaces, 12u);
  ExpectBalance(solved.statistics, 0.02);  // elements half under the box, of edge 0.125
}

// A sheet in mid-air under a point light above and a directional light below: each side has its
// own. Lights without geometry are exact where nothing shades.
TEST_P(ClassicalMethods, LightsOnBothSidesOfASheet) {
  Scene scene;
  testing::AddQuad(&scene.mesh, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, Spectrum(0.5f));
  testing::CompleteTables(&scene);
  Light point;
  point.position = {0, 0, 2};
  point.intensity = Spectrum(8.f);
  Light sun;
  sun.type = LightType::Directional;
  sun.direction = Normalize(Vec3f(0, 1, 1));
  sun.intensity = Spectrum(3.f);
  scene.lights = {point, sun};
  const Solved solved = Solve(scene, 0.2);
  for (size_t face = 0; face < solved.solution.side.size(); ++face) {
    for (const int32_t p : solved.solution.mesh.triangles[face]) {
      const Vec3f x = solved.solution.mesh.positions[size_t(p)];
      const float squared = LengthSquared(point.position - x);
      const bool isFront = solved.solution.side[face] == kFront;
      const float expected = isFront ? 16 / (squared * std::sqrt(squared)) : 3 / std::sqrt(2.f);
      // A vertex may take the mean of the elements of edge 1/8 about it: at a corner 0.08 m away,
      // where E changes by 0.8 W/m2 per metre.
      EXPECT_NEAR(solved.solution.irradiance[size_t(p)].g, expected, isFront ? 0.08f : 1e-5f);
    }
  }
  // A quarter of the light's sphere but for its rim; 4096 directions count it to 2 %.
  ExpectBalance(solved.statistics, 0.03);
}

// A doubled sheet under suns from above and below: each side is one face's, of its own material.
TEST_P(ClassicalMethods, ADoubledSheetHasTwoSides) {
  const Scene scene = testing::DoubledSheetUnderSuns();
  const Solved solved = Solve(scene, 0.2);
  double area = 0;
  for (int64_t face = 0; face < solved.solution.mesh.FaceCount(); ++face) {
    const bool isUp = solved.solution.mesh.FrontNormal(face).z > 0;
    area += double(solved.solution.mesh.Area(face));
    for (const int32_t p : solved.solution.mesh.triangles[size_t(face)]) {
      EXPECT_NEAR(solved.solution.irradiance[size_t(p)].g, isUp ? 1 : 4, 1e-4f);
      EXPECT_NEAR(solved.solution.radiosity[size_t(p)].g, 0.8f, 1e-4f);
      EXPECT_NEAR(solved.solution.radiosity[size_t(p)].r, isUp ? 0.8f : 2.f, 1e-4f);
    }
  }
  EXPECT_NEAR(area, 8, 1e-4);  // Two sides of 4 m2.
  ExpectBalance(solved.statistics, 1e-3);
}

// A floor under an open sky receives pi L; one wall of equal height and infinite length would take
// half of what it hides. Here nothing hides: exact.
TEST_P(ClassicalMethods, OpenSky) {
  Scene scene;
  testing::AddQuad(&scene.mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.5f));
  testing::CompleteTables(&scene);
  Light sky;
  sky.type = LightType::Sky;
  sky.intensity = Spectrum(2.f);
  scene.lights = {sky};
  const Solved solved = Solve(scene, 0.3);
  for (const Spectrum& e : solved.solution.irradiance) EXPECT_NEAR(e.g, 2 * kPi, 1e-4);
  ExpectBalance(solved.statistics, 1e-3);
}

// pi H + 2 pi (Z - H) / 3 on the upper side; the ground below is black.
TEST_P(ClassicalMethods, OpenGradientSky) {
  Scene scene;
  testing::AddQuad(&scene.mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.5f));
  testing::CompleteTables(&scene);
  Light sky;
  sky.type = LightType::GradientSky;
  sky.intensity = Spectrum(4.f);
  sky.horizon = Spectrum(1.f);
  scene.lights = {sky};
  const Solved solved = Solve(scene, 0.3);
  for (size_t p = 0; p < solved.solution.irradiance.size(); ++p) {
    if (solved.solution.mesh.normals[p].z < 0) continue;
    // 256 stratified rays.
    EXPECT_NEAR(solved.solution.irradiance[p].g, 3 * kPi, 0.01 * 3 * kPi);
  }
  ExpectBalance(solved.statistics, 1e-3);
}

// The shadow of a screen in the light of a sun 20 degrees across, on a floor that lies far within
// the screen's other edges: the penumbra, and light and dark beyond it.
TEST_P(ClassicalMethods, ThePenumbraOfASun) {
  const float size = float(20 * kPi / 180);
  Scene scene = testing::ScreenUnderSun(size);
  testing::AddQuad(&scene.mesh, {-0.5f, -0.5f, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.f),
                   Spectrum(0.f), 1, 1, 1);
  testing::CompleteTables(&scene);
  const Solved solved = Solve(scene, 0.1);
  double difference = 0;
  int points = 0;
  for (size_t p = 0; p < solved.solution.mesh.positions.size(); ++p) {
    const Vec3f& x = solved.solution.mesh.positions[p];
    if (x.z > 0.5f || solved.solution.mesh.normals[p].z < 0) continue;
    const double expected = testing::Penumbra(double(x.x), double(size));
    // Half an element of 0.1 m, at most 1.8 W/m2 per m; 16 rays.
    EXPECT_NEAR(solved.solution.irradiance[p].g, expected, 0.25);
    difference += double(solved.solution.irradiance[p].g) - expected;
    ++points;
  }
  EXPECT_GT(points, 50);
  EXPECT_NEAR(difference / points, 0, 0.02);  // The disc is 2 % wider than its projection.
}

/// Loose, touching, nearly parallel and sliver triangles, every tenth of which emits, in a room.
Scene Heap(uint64_t seed) {
  Scene scene;
  Random random(seed);
  const auto point = [&](float scale) {
    const float x = random.Uniform(), y = random.Uniform();
    return (Vec3f(x, y, random.Uniform()) * 2.f - Vec3f(1, 1, 1)) * scale;
  };
  Vec3f a, b, c;
  for (int i = 0; i < 60; ++i) {
    const uint64_t kind = i == 0 ? 0 : random.Bits() % 4;
    if (kind == 0) {
      a = point(1), b = a + point(0.5f), c = a + point(0.5f);
    } else if (kind == 1) {
      c = a + point(0.5f);
    } else if (kind == 2) {
      const Vec3f n = Normalize(Cross(b - a, c - a)) * (0.002f + 0.02f * random.Uniform());
      a += n + point(1e-3f), b += n, c += n;
    } else {
      a = point(1), b = a + point(1), c = a + (b - a) * random.Uniform() + point(1e-3f);
    }
    testing::AddTriangle(&scene.mesh, a, b, c, Spectrum(0.9f * random.Uniform()),
                         Spectrum(i % 10 == 0 ? 5.f : 0.f));
  }
  testing::AddBox(&scene.mesh, {-2, -2, -2}, {2, 2, 2}, testing::BoxMaterials(0.6f), true, 1, 1);
  testing::CompleteTables(&scene);
  return scene;
}

// Whatever the geometry: the same bits for one thread and two, finite, never brighter than a
// furnace of the brightest emitter and the lightest surface.
TEST_P(ClassicalMethods, HeapsObeyTheLaws) {
  for (const uint64_t seed : {3u}) {
    const Scene scene = Heap(seed);
    SetThreadCount(1);
    const Solved one = Solve(scene, 1.2);
    SetThreadCount(2);
    const Solved two = Solve(scene, 1.2);
    SetThreadCount(0);
    EXPECT_TRUE(one.solution.irradiance == two.solution.irradiance);
    EXPECT_TRUE(one.solution.radiosity == two.solution.radiosity);
    EXPECT_EQ(one.statistics.rays, two.statistics.rays);
    EXPECT_EQ(one.statistics.absorbed, two.statistics.absorbed);
    for (const Spectrum& e : one.solution.irradiance) {
      ASSERT_TRUE(e.IsFinite());
      ASSERT_GE(e.g, 0);
      ASSERT_LE(e.g, 5 / (1 - 0.9f));
    }
    EXPECT_EQ(one.statistics.escaped.g, 0);
    // Coarse elements that pierce each other: what is half hidden is counted as a whole.
    ExpectBalance(one.statistics, 0.1);
  }
}

TEST_P(ClassicalMethods, NoLightAndNoFaces) {
  const Solved dark = Solve(testing::BoxRoom(1, 0.5f, 0), 0.5);
  for (const Spectrum& e : dark.solution.irradiance) EXPECT_EQ(e.g, 0);
  EXPECT_FALSE(dark.solution.mesh.triangles.empty());
  const Solved empty = Solve(Scene(), 0.5);
  EXPECT_TRUE(empty.solution.mesh.triangles.empty());
}

INSTANTIATE_TEST_SUITE_P(Methods, ClassicalMethods,
                         ::testing::Values(Method{"Matrix", ByMatrix},
                                           Method{"Progressive", ByShooting}),
                         [](const auto& method) { return std::string(method.param.name); });

}  // namespace
}  // namespace lambert
