// Laws of light that the reference keeps in every scene. What is summed up is found by independent
// batches of points; bars are 5 standard errors of their mean: chance breaks one law in 50,000.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "Common/Core/PolygonIrradiance.h"
#include "Common/Core/Random.h"
#include "RandomScenes.h"
#include "Reference/Core/PathTracedIrradiance.h"

namespace lambert::testing {
namespace {

constexpr int kBatches = 32, kPointsABatch = 64, kPathsAPoint = 16;

/// A place on a side of a face, and the area that it stands for in its batch.
struct SidePoint {
  ReceiverPoint receiver;
  int64_t face;
  double area;
};

double Area(const TriangleMesh& mesh) {
  double area = 0;
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) area += double(mesh.Area(face));
  return area;
}

/// m2; 0 where it is no more than the rounding of the corners, which leaves no normal either.
double SoundArea(const TriangleMesh& mesh, int64_t face) {
  const Vec3f a = mesh.Corner(face, 0), b = mesh.Corner(face, 1), c = mesh.Corner(face, 2);
  const float longest = std::max(LengthSquared(b - a), LengthSquared(c - a));
  const double area = double(mesh.Area(face));
  return area > 1e-6 * double(longest) ? area : 0;
}

/// Points of one batch over both sides of all faces: half of them by area, half alike on every
/// side, so that small faces beside a lamp get some too.
std::vector<SidePoint> SidePoints(const TriangleMesh& mesh, Random* random) {
  std::vector<SidePoint> points;
  const double area = Area(mesh);
  double next = random->UniformDouble(), before = 0;
  for (int64_t side = 0; side < 2 * mesh.FaceCount(); ++side) {
    const int64_t face = side / 2;
    const double own = SoundArea(mesh, face);
    const double share = kPointsABatch * (own / area + 1 / double(mesh.FaceCount())) / 4;
    for (; own > 0 && next < before + share; ++next) {
      const Vec2f b = UniformTriangle(random->Uniform(), random->Uniform());
      const Vec3f p = mesh.Corner(face, 0), n = mesh.FrontNormal(face) * (side % 2 ? -1.f : 1.f);
      const Vec3f x = p + (mesh.Corner(face, 1) - p) * b.x + (mesh.Corner(face, 2) - p) * b.y;
      points.push_back({{x, n, n}, face, own / share});
    }
    if (own > 0) before += share;
  }
  return points;
}

std::vector<IrradianceEstimate> Estimate(const Scene& scene,
                                         const std::vector<ReceiverPoint>& points, int paths) {
  PathTracedIrradianceOptions options;
  options.samples = paths;
  return PathTracedIrradiance(scene).Estimate(points, options);
}

/// Mean and standard error of independent values.
struct Mean {
  double value = 0, error = 0;
  explicit Mean(const std::vector<double>& values) {
    double squares = 0;
    for (const double v : values) value += v / double(values.size());
    for (const double v : values) squares += (v - value) * (v - value);
    error = std::sqrt(squares / double(values.size() * (values.size() - 1)));
  }
};

/// W in the green band: the sum over all sides of weight(face) x irradiance x area.
template <class Weight>
Mean PowerArriving(const Scene& scene, Random* random, const Weight& weight) {
  std::vector<ReceiverPoint> receivers;
  std::vector<SidePoint> points;
  std::vector<size_t> end;
  for (int batch = 0; batch < kBatches; ++batch) {
    for (const SidePoint& p : SidePoints(scene.mesh, random)) points.push_back(p);
    end.push_back(points.size());
  }
  for (const SidePoint& p : points) receivers.push_back(p.receiver);
  const std::vector<IrradianceEstimate> light = Estimate(scene, receivers, kPathsAPoint);
  std::vector<double> power(kBatches, 0);
  for (size_t batch = 0, i = 0; batch < power.size(); ++batch) {
    for (; i < end[batch]; ++i) {
      EXPECT_TRUE(light[i].irradiance.IsFinite());
      EXPECT_GE(light[i].irradiance.g, 0);
      power[batch] += points[i].area * double(light[i].irradiance.g) * weight(points[i].face);
    }
  }
  return Mean(power);
}

/// W in the green band through a sphere about the scene, outward less inward.
Mean PowerEscaping(const Scene& scene, Random* random) {
  const Box3f bounds = scene.mesh.Bounds();
  const float radius = 0.51f * bounds.Diagonal();
  std::vector<ReceiverPoint> points;
  for (int i = 0; i < kBatches * kPointsABatch; ++i) {
    const float z = 1 - 2 * random->Uniform(), phi = float(2 * kPi) * random->Uniform();
    const float r = std::sqrt(std::max(0.f, 1 - z * z));
    const Vec3f d(r * std::cos(phi), r * std::sin(phi), z);
    points.push_back({bounds.Center() + d * radius, -d, -d});
  }
  const std::vector<IrradianceEstimate> light = Estimate(scene, points, kPathsAPoint);
  double sky = 0;
  for (const Light& l : scene.lights) sky += kPi * double(l.intensity.g);
  std::vector<double> power(kBatches, 0);
  for (size_t i = 0; i < points.size(); ++i) {
    power[i / kPointsABatch] += 4 * kPi * double(radius) * double(radius) / kPointsABatch *
                                (double(light[i].irradiance.g) - sky);
  }
  return Mean(power);
}

double PowerEmitted(const TriangleMesh& mesh) {
  double power = 0;
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    const int sides = int(mesh.Emits(face, kFront)) + int(mesh.Emits(face, kBack));
    power += sides * double(mesh.emittance[size_t(face)].g) * double(mesh.Area(face));
  }
  return power;
}

class ReferenceLaws : public ::testing::TestWithParam<uint64_t> {};

TEST_P(ReferenceLaws, LightIsAbsorbedOrEscapes) {
  SCOPED_TRACE(HowToRepeat(GetParam()));
  const RandomScene made = MakeRandomScene(GetParam(), Overlaps::None);
  Random random(GetParam());
  const TriangleMesh& mesh = made.scene.mesh;
  const Mean absorbed = PowerArriving(made.scene, &random, [&](int64_t face) {
    return 1 - double(mesh.reflectance[size_t(face)].g);
  });
  const Mean escaped = PowerEscaping(made.scene, &random);
  const double emitted = PowerEmitted(mesh), bar = std::hypot(absorbed.error, escaped.error);
  EXPECT_NEAR(absorbed.value + escaped.value, emitted, 5 * bar + 1e-4 * emitted);
  if (made.isClosed) {
    EXPECT_LE(std::abs(escaped.value), 1e-3 * emitted);
  }
}

TEST_P(ReferenceLaws, AFurnaceIsEven) {
  SCOPED_TRACE(HowToRepeat(GetParam()));
  RandomScene made = MakeRandomScene(2 * GetParam() + 1, Overlaps::Allowed);
  MakeFurnace(0.5f, &made.scene);
  Random random(GetParam());
  const double area = 2 * Area(made.scene.mesh) - 6 * 16;  // no light outside the walls
  const Mean power = PowerArriving(made.scene, &random, [](int64_t) { return 1.0; });
  EXPECT_NEAR(power.value / area, 2, (5 * power.error) / area + 1e-3);
}

TEST_P(ReferenceLaws, ExchangeIsMutual) {
  SCOPED_TRACE(HowToRepeat(GetParam()));
  RandomScene made = MakeRandomScene(2 * GetParam(), Overlaps::None);
  Random random(GetParam());
  std::vector<uint8_t> lit, others;
  for (int64_t face = 0; face < made.scene.mesh.FaceCount(); ++face) {
    lit.push_back(random.Bits() % 2);
    others.push_back(!lit.back());
  }
  MakeBlack(lit, &made.scene);
  const Mean forth = PowerArriving(made.scene, &random,
                                   [&](int64_t face) { return double(others[size_t(face)]); });
  MakeBlack(others, &made.scene);
  const Mean back =
      PowerArriving(made.scene, &random, [&](int64_t face) { return double(lit[size_t(face)]); });
  EXPECT_NEAR(forth.value, back.value,
              5 * std::hypot(forth.error, back.error) + 1e-4 * forth.value);
}

/// Irradiance at a point with nothing in the way, W/m2.
double Unoccluded(const TriangleMesh& mesh, const ReceiverPoint& at) {
  double sum = 0;
  for (int64_t face = 0; face < mesh.FaceCount(); ++face) {
    const Vec3f a = mesh.Corner(face, 0), b = mesh.Corner(face, 1), c = mesh.Corner(face, 2);
    const Vec3f front[3] = {a, b, c}, back[3] = {a, c, b};
    for (const Side side : {kFront, kBack}) {
      if (!mesh.Emits(face, side)) continue;
      const Vec3d vector =
          PolygonIrradianceAbove(side == kFront ? front : back, 3, at.position, at.normal);
      sum += double(mesh.emittance[size_t(face)].g) * Dot(vector, Vec3d(at.normal));
    }
  }
  return sum;
}

TEST_P(ReferenceLaws, NoMoreThanUnoccluded) {
  SCOPED_TRACE(HowToRepeat(GetParam()));
  RandomScene made = MakeRandomScene(GetParam(), Overlaps::None);
  Random random(GetParam());
  std::vector<uint8_t> lit;
  for (int64_t face = 0; face < made.scene.mesh.FaceCount(); ++face) {
    lit.push_back(random.Bits() % 8 == 0);
  }
  MakeBlack(lit, &made.scene);
  std::vector<ReceiverPoint> receivers;
  for (const SidePoint& p : SidePoints(made.scene.mesh, &random)) receivers.push_back(p.receiver);
  const std::vector<IrradianceEstimate> light = Estimate(made.scene, receivers, 256);
  for (size_t i = 0; i < light.size(); ++i) {
    const double bound = Unoccluded(made.scene.mesh, receivers[i]);
    // Of one point: 8 standard errors, that have 15 degrees of freedom; and single precision.
    EXPECT_LE(double(light[i].irradiance.g), bound + 8 * double(light[i].standardError.g) + 1e-6)
        << "point " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ReferenceLaws, ::testing::ValuesIn(LawSeeds()));

}  // namespace
}  // namespace lambert::testing
