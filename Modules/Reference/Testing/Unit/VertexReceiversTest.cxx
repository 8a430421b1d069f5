// Receivers lie on the surface, inside it, and see nothing through its corners.
#include "Reference/Core/VertexReceivers.h"

#include <gtest/gtest.h>

#include "Common/Core/Random.h"
#include "Common/Testing/TestScenes.h"

namespace lambert {
namespace {

using namespace testing;

/// Barycentric coordinates of the foot of p on a face, and its height above it.
struct Placement {
  double b0, b1, b2, height;
  Placement(const TriangleMesh& mesh, int32_t face, const Vec3f& position) {
    const Vec3d a(mesh.Corner(face, 0)), p(position);
    const Vec3d u = Vec3d(mesh.Corner(face, 1)) - a, v = Vec3d(mesh.Corner(face, 2)) - a;
    const Vec3d n = Cross(u, v);
    b1 = Dot(Cross(p - a, v), n) / LengthSquared(n);
    b2 = Dot(Cross(u, p - a), n) / LengthSquared(n);
    b0 = 1 - b1 - b2;
    height = Dot(p - a, n) / Length(n);
  }
};

/// Every receiver lies on a face of its point; both sides of every point are there.
void ExpectOnSurface(const TriangleMesh& mesh) {
  const auto receivers = VertexReceivers(mesh);
  ASSERT_EQ(receivers.size(), 2 * mesh.positions.size());
  for (size_t i = 0; i < receivers.size(); ++i) {
    const VertexReceiver& r = receivers[i];
    EXPECT_EQ(r.point, int32_t(i / 2));
    const auto& corners = mesh.triangles[size_t(r.face)];
    EXPECT_NE(std::find(corners.begin(), corners.end(), r.point), corners.end());
    const Placement at(mesh, r.face, r.receiver.position);
    // Positions are floats: 1e-6 m in meshes of 1 m, where the draw is some 1e-4 m.
    EXPECT_NEAR(at.height, 0, 1e-6);
    EXPECT_GT(std::min({at.b0, at.b1, at.b2}), -1e-5);
    const Vec3f front = mesh.FrontNormal(r.face);
    EXPECT_GT(Dot(r.receiver.geometricNormal, r.side == kFront ? front : -front), 0.999f);
    EXPECT_GE(Dot(r.receiver.normal, r.receiver.geometricNormal), 0);
    const Vec3f& normal = mesh.normals[size_t(r.point)];
    EXPECT_EQ(r.receiver.normal, i % 2 == 0 ? normal : -normal);
  }
}

TEST(VertexReceivers, LieOnFlatAndCurvedSurfaces) {
  Scene room = BoxRoom(1, 0.5f, 1, 4);
  ExpectOnSurface(room.mesh);
  Scene sphere;
  AddSphere(&sphere.mesh, {0.2f, 0, 0}, 0.5f, 8, Spectrum(0.5f));
  ExpectOnSurface(sphere.mesh);
}

TEST(VertexReceivers, StayOnTheSurfaceOfRandomFans) {
  // Fans of up to 330 degrees, folded by chance, of triangles of very different size and winding.
  for (uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const double opening = (0.1 + 0.8 * random.UniformDouble()) * 2 * kPi;
    const double fold = random.UniformDouble() < 0.5 ? 0 : 0.5;
    const int triangles = 1 + int(random.UniformDouble() * 7);
    TriangleMesh mesh;
    AddPoint(&mesh, {0, 0, 0}, {0, 0, 1});
    for (int i = 0; i <= triangles; ++i) {
      const double angle = opening * i / triangles, r = 0.05 + random.UniformDouble();
      AddPoint(&mesh,
               {float(r * std::cos(angle)), float(r * std::sin(angle)),
                float(fold * r * (random.UniformDouble() - 0.5))},
               {0, 0, 1});
    }
    for (int32_t i = 1; i <= triangles; ++i) {
      const bool isReversed = random.UniformDouble() < 0.3;
      AddFace(&mesh, {0, isReversed ? i + 1 : i, isReversed ? i : i + 1}, Spectrum(0.5f),
              Spectrum(0.f));
    }
    ExpectOnSurface(mesh);
  }
}

TEST(VertexReceivers, AreDrawnAThousandthOfTheWay) {
  Scene scene;
  AddTriangle(&scene.mesh, {0, 0, 0}, {3, 0, 0}, {0, 3, 0}, Spectrum(0.5f));
  const auto receivers = VertexReceivers(scene.mesh);
  ASSERT_EQ(receivers.size(), 6u);
  EXPECT_EQ(receivers[0].receiver.position, Vec3f(1e-3f, 1e-3f, 0));
  EXPECT_EQ(receivers[0].side, kFront);
  EXPECT_EQ(receivers[1].side, kBack);
  EXPECT_EQ(receivers[1].receiver.normal, Vec3f(0, 0, -1));
}

TEST(VertexReceivers, LeaveOutPointsOfNoArea) {
  Scene scene;
  AddTriangle(&scene.mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.5f));
  const int32_t first = AddPoint(&scene.mesh, {5, 5, 5}, {0, 0, 1});  // Of a needle only.
  AddPoint(&scene.mesh, {6, 6, 6}, {0, 0, 1});
  AddPoint(&scene.mesh, {7, 7, 7}, {0, 0, 1});
  AddPoint(&scene.mesh, {8, 8, 8}, {0, 0, 1});  // Of no face.
  AddFace(&scene.mesh, {first, first + 1, first + 2}, Spectrum(0.5f), Spectrum(0.f));
  AddFace(&scene.mesh, {0, 0, 1}, Spectrum(0.5f),
          Spectrum(0.f));  // A collapsed one changes nothing.
  const auto receivers = VertexReceivers(scene.mesh);
  ASSERT_EQ(receivers.size(), 6u);
  for (const VertexReceiver& r : receivers) EXPECT_EQ(r.face, 0);
}

TEST(VertexReceivers, SeeNothingThroughCorners) {
  // A closed dark room in a bright world. A path that ends within rounding of an edge may slip
  // out; that is one in some 1e5, where rays that skip 1e-5 of the diagonal lose 3e-3 of them.
  Scene scene;
  AddBox(&scene.mesh, {0, 0, 0}, {1, 1, 1}, BoxMaterials(0.8f), true, 4);
  Light sky;
  sky.type = LightType::Sky;
  sky.intensity = Spectrum(1.f);
  scene.lights.push_back(sky);
  CompleteTables(&scene);
  const PathTracedIrradiance tracer(scene);
  std::vector<ReceiverPoint> inside;
  for (const VertexReceiver& r : VertexReceivers(scene.mesh)) {
    if (r.side == kFront) inside.push_back(r.receiver);
  }
  ASSERT_EQ(int64_t(inside.size()), scene.mesh.PointCount());
  double mean = 0;
  for (const IrradianceEstimate& e : tracer.Estimate(inside)) {
    mean += double(e.irradiance.r) / double(inside.size());
  }
  EXPECT_LT(mean, 1e-4 * kPi);
}

}  // namespace
}  // namespace lambert
