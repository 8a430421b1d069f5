// Transfers between elements: closed forms (Documentation/Accuracy.md), and the bounds that hold
// for any pair, however close.
#include "Radiosity/Core/Transfer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Common/Core/PolygonIrradiance.h"
#include "Radiosity/Core/LightExchange.h"
#include "Radiosity/Core/LinkRefinement.h"
#include "SolverScenes.h"

namespace lambert {
namespace {

constexpr float kRounding = 1e-4f;

/// The triangles of a scene, each a polygon element for its front and one for its back.
struct PolygonScene : testing::ModelledScene {
  std::vector<int32_t> polygons;

  void Refine() {
    this->Model();
    for (int32_t i = 0; i < hierarchy->Size(); ++i) {
      if ((*hierarchy)[i].IsPolygon()) {
        polygons.push_back(i);
      } else if ((*hierarchy)[i].IsLeaf()) {
        hierarchy->Split({i});
      }
    }
  }
  /// Of all polygons, with nothing in the way; facing away gives nothing.
  Vec3f Arriving(const Vec3f& x, const Vec3f& horizon) const {
    Vec3f sum;
    for (const int32_t i : polygons) {
      sum += UnoccludedTransfer(*hierarchy, (*hierarchy)[i], x, horizon);
    }
    return sum;
  }
  /// Form factor to `receiver` with nothing in the way, in the mean over its samples.
  float Unoccluded(const Element& source, const Element& receiver) const {
    Vec3f corners[kMaximumPolygonCorners];
    const int count = hierarchy->PolygonCorners(source, corners);
    double mean = 0;
    for (const SurfaceSample& sample : receiver.samples) {
      const Vec3d e = PolygonIrradianceAbove(corners, count, sample.position, receiver.axis);
      mean += Dot(e, Vec3d(receiver.axis)) / kSamplesPerElement;
    }
    return float(mean);
  }
  TransferEstimate Estimate(const Element& source, const Element& receiver) const {
    return EstimateTransfer(*hierarchy, *rayScene, source, receiver, true);
  }
};

/// The rectangle [0, a] x [0, b] at height `z`, its front down.
struct Rectangle : PolygonScene {
  Rectangle(float a, float b, float z) {
    testing::AddQuad(&scene.mesh, {0, 0, z}, {0, b, 0}, {a, 0, 0}, Spectrum(0.5f));
    this->Refine();
  }
};

TEST(Transfer, ClosedFormsOfARectangle) {
  // Differential areas: parallel under the corner and the middle (6), perpendicular (7).
  const Rectangle square(1, 1, 1), low(2, 1, 0.5f);
  const Vec3f up(0, 0, 1), east(1, 0, 0);
  EXPECT_NEAR(Dot(square.Arriving({}, up), up), 0.1385316060, 1e-6);
  EXPECT_NEAR(Dot(square.Arriving({0.5f, 0.5f, 0}, up), up), 0.2394564705, 1e-6);
  EXPECT_NEAR(Dot(square.Arriving({}, east), east), 0.0557341970, 1e-6);
  EXPECT_NEAR(Dot(low.Arriving({}, east), east), 0.1587748045, 1e-6);

  // The whole vector (10).
  const Vec3f vector = square.Arriving({}, {});
  EXPECT_NEAR(vector.x, 0.0557341970, 1e-6);
  EXPECT_NEAR(vector.y, 0.0557341970, 1e-6);
  EXPECT_NEAR(vector.z, 0.1385316060, 1e-6);
}

/// A small triangle on the ground, and a large one that faces it 1 m above, with a screen of
/// `width` m in the middle between them.
struct Screened : PolygonScene {
  explicit Screened(float width) {
    TriangleMesh& mesh = scene.mesh;
    testing::AddTriangle(&mesh, {0, 0, 0}, {0.01f, 0, 0}, {0, 0.01f, 0}, Spectrum(0.5f));
    testing::AddTriangle(&mesh, {-1, -1, 1}, {-1, 2, 1}, {2, -1, 1}, Spectrum(0.5f));
    if (width > 0) {
      testing::AddQuad(&mesh, {-1, -1, 0.5f}, {width, 0, 0}, {0, 3, 0}, Spectrum(0.5f));
    }
    this->Refine();
  }
};

TEST(Transfer, VisibilityIsAllThatIsSampled) {
  // Nothing between: the closed form to rounding. Half a screen takes some of it, a whole one all.
  for (const float width : {0.f, 1.f, 3.f}) {
    const Screened scene(width);
    const Element *ground = nullptr, *above = nullptr;
    for (const int32_t i : scene.polygons) {
      const Element& e = (*scene.hierarchy)[i];
      if (e.area < 1e-3f && e.axis.z > 0) ground = &e;
      if (std::fabs(e.frame.center.z - 1) < 1e-3f && e.axis.z < 0) above = &e;
    }
    ASSERT_TRUE(ground && above);
    const TransferEstimate estimate = scene.Estimate(*above, *ground);
    const float unoccluded = scene.Unoccluded(*above, *ground);
    const float factor = Dot(estimate.transfer, ground->axis);
    if (width == 0) {
      EXPECT_NEAR(factor, unoccluded, 1e-5f);
      EXPECT_EQ(estimate.visibility, 1);
    } else if (width == 1) {
      EXPECT_GT(factor, 0);
      EXPECT_LT(factor, 0.9f * unoccluded);
    } else {
      EXPECT_EQ(factor, 0);
    }
  }
}

struct Neighbour {
  const char* name;
  Vec3f a, b, c;  ///< beside the triangle (0, 0, 0), (1, 0, 0), (0, 1, 0)
};
class CloseTransferTest : public ::testing::TestWithParam<Neighbour> {};

// 0 <= F <= unoccluded F <= 1, for both sides of both and of their patches, in both directions.
TEST_P(CloseTransferTest, IsWithinBounds) {
  const Neighbour& other = GetParam();
  PolygonScene scene;
  testing::AddTriangle(&scene.scene.mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Spectrum(0.5f));
  testing::AddTriangle(&scene.scene.mesh, other.a, other.b, other.c, Spectrum(0.5f));
  scene.Refine();
  for (int round = 0; round < 4; ++round) {
    std::vector<int32_t> leaves;
    for (const int32_t i : scene.polygons) {
      if ((*scene.hierarchy)[i].IsLeaf()) leaves.push_back(i);
    }
    scene.hierarchy->Split(leaves);
    for (int32_t i = scene.polygons.back() + 1; i < scene.hierarchy->Size(); ++i) {
      scene.polygons.push_back(i);
    }
  }
  int lit = 0;
  for (const int32_t s : scene.polygons) {
    for (const int32_t r : scene.polygons) {
      const Element &source = (*scene.hierarchy)[s], &receiver = (*scene.hierarchy)[r];
      const TransferEstimate estimate = scene.Estimate(source, receiver);
      const float factor = Dot(estimate.transfer, receiver.axis);
      ASSERT_TRUE(IsFinite(estimate.transfer)) << s << " to " << r;
      ASSERT_GE(factor, -kRounding) << s << " to " << r;
      ASSERT_LE(factor, scene.Unoccluded(source, receiver) + kRounding) << s << " to " << r;
      ASSERT_LE(Length(estimate.transfer), 1 + kRounding) << s << " to " << r;
      lit += factor > 0;
    }
  }
  // What lies in one plane, or in one place, gives nothing to its like.
  const bool isFlat = other.a.z == 0 && other.b.z == 0 && other.c.z == 0;
  EXPECT_EQ(lit > 0, !isFlat);
}
INSTANTIATE_TEST_SUITE_P(
    Pairs, CloseTransferTest,
    ::testing::Values(Neighbour{"AtAnEdge", {1, 0, 0}, {0, 0, 0}, {0, 0, 1}},
                      Neighbour{"AtAnEdgeNearlyFolded", {1, 0, 0}, {0, 0, 0}, {0, 1, 0.01f}},
                      Neighbour{"AtACorner", {0, 0, 0}, {-1, 0, 1}, {0, -1, 1}},
                      Neighbour{"Crossing", {0.2f, 0.2f, -1}, {0.3f, 0.4f, 1}, {0.9f, 0.1f, 1}},
                      Neighbour{"TwoSidesOfOnePlace", {0, 0, 0}, {0, 1, 0}, {1, 0, 0}},
                      Neighbour{"Repeated", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                      Neighbour{"OverlappingInOnePlane", {0.2f, 0.2f, 0}, {2, 0, 0}, {0, 2, 0}},
                      Neighbour{"BesideInOnePlane", {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                      Neighbour{"AHairAbove", {0, 0, 1e-5f}, {0, 1, 1e-5f}, {1, 0, 1e-5f}}),
    [](const auto& pair) { return pair.param.name; });

TEST(Transfer, RowsAreBounded) {
  // Links between whole walls and whole things, coarse: four samples a pair scatter about 1.
  PolygonScene scene;
  testing::AddBox(&scene.scene.mesh, {0, 0, 0}, {1, 1, 1}, testing::BoxMaterials(0.9f, 1), true);
  testing::AddBox(&scene.scene.mesh, {0.3f, 0.3f, 0}, {0.6f, 0.6f, 0.5f},
                  testing::BoxMaterials(0.9f), false, 1, 6);
  scene.Refine();
  const ElementHierarchy& hierarchy = *scene.hierarchy;
  LinkNetwork network;
  network.incoming.resize(size_t(hierarchy.Size()));
  for (const int32_t receiver : scene.polygons) {
    for (const int32_t source : scene.polygons) {
      const TransferEstimate estimate = scene.Estimate(hierarchy[source], hierarchy[receiver]);
      Link link;
      link.source = source;
      link.transfer = estimate.transfer;
      network.incoming[size_t(receiver)].push_back(link);
    }
  }
  ElementLight light;
  light.Grow(hierarchy);
  float largest = 0;
  for (const float bound : {1.25f, 1.f}) {
    BoundRowSums(hierarchy, network, bound, &light);
    for (const int32_t receiver : scene.polygons) {
      Vec3f row;
      for (const Link& link : network.incoming[size_t(receiver)]) row += link.transfer;
      const float sum = Dot(row, hierarchy[receiver].axis);
      largest = std::max(largest, sum);
      // No more than 0.95 of what arrives may leave again for a sum over 1.
      EXPECT_LE(sum * light.rowScale[size_t(receiver)], std::min(bound, 0.95f / 0.9f) + kRounding);
      if (sum <= 1) {
        EXPECT_EQ(light.rowScale[size_t(receiver)], 1);
      }
    }
  }
  EXPECT_GT(largest, 1);  // Else nothing was bounded.
}

// A lamp that lies in its floor, a hair above it, across it, or in a corner; open or in a furnace.
class LampAtNoDistanceTest : public ::testing::TestWithParam<float> {};
TEST_P(LampAtNoDistanceTest, GivesFiniteLight) {
  Scene scene;
  testing::AddBox(&scene.mesh, {0, 0, 0}, {1, 1, 1}, testing::BoxMaterials(0.5f), true);
  const float height = GetParam();
  testing::AddQuad(&scene.mesh, {0.2f, 0.2f, height}, {0.2f, 0, 0}, {0, 0.2f, 0}, Spectrum(0.f),
                   Spectrum(10.f), 1, 6);
  testing::AddQuad(&scene.mesh, {0, 0, 0.3f}, {0.1f, 0, -height}, {0, 0.1f, 0}, Spectrum(0.f),
                   Spectrum(10.f), 1, 7);
  testing::AddQuad(&scene.mesh, {0.6f, 0.6f, -0.1f}, {0.2f, 0, 0}, {0, 0, 0.2f}, Spectrum(0.f),
                   Spectrum(10.f), 1, 8);
  testing::CompleteTables(&scene);
  const testing::SolvedScene solved = testing::SolveScene(std::move(scene), 0.2);
  double most = 0;
  for (const Spectrum& e : solved.solution.irradiance) {
    ASSERT_TRUE(e.IsFinite());
    ASSERT_GE(e.g, 0);
    most = std::max(most, double(e.g));
  }
  // No place is brighter than a furnace of the lamps and the walls: 10 / (1 - 0.5).
  EXPECT_GT(most, 1);
  EXPECT_LE(most, 20 * 1.0001);
}
INSTANTIATE_TEST_SUITE_P(Heights, LampAtNoDistanceTest,
                         ::testing::Values(0.f, 1e-7f, 1e-5f, 1e-3f));

}  // namespace
}  // namespace lambert
