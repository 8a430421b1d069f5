// Laws that every link of hierarchical radiosity keeps, between elements of every kind.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "Clustering/Core/FaceClustering.h"
#include "Common/Core/PolygonIrradiance.h"
#include "Common/Core/Random.h"
#include "Radiosity/Core/ElementHierarchy.h"
#include "Radiosity/Core/Transfer.h"
#include "RandomScenes.h"

namespace lambert::testing {
namespace {

constexpr int32_t kElements = 3000;
constexpr int kPairs = 4000;
constexpr float kRounding = 1e-4f;

/// A polygon wider than 1 mm. At 1 m single precision is 1e-7: in slivers of less corners, area and
/// normal of an element do not agree to 1e-3 or so.
bool HasShape(const Element& e) { return e.IsPolygon() && e.area > 1e-3f * e.radius; }

class TransferLaws : public ::testing::TestWithParam<uint64_t> {
 protected:
  void SetUp() override {
    made_ = MakeRandomScene(GetParam(), Overlaps::Allowed);
    tree_ = ClusterFaces(&made_.scene.mesh, made_.scene.parts);
    lit_.assign(tree_.surfaceRoots.size(), 3);  // both sides
    hierarchy_ = std::make_unique<ElementHierarchy>(made_.scene, tree_, lit_, LeafMeshOptions());
    rays_ = std::make_unique<RayScene>(made_.scene.mesh);
    // Breadth first, so that clusters, triangles and patches come about.
    for (int32_t next = 0; next < hierarchy_->Size() && hierarchy_->Size() < kElements; ++next) {
      const Element& element = (*hierarchy_)[next];
      if (element.IsLeaf() && element.kind != ElementKind::Light) hierarchy_->Split({next});
    }
  }

  const Element& Pick(Random* random) const {
    for (;;) {
      const Element& e = (*hierarchy_)[int32_t(random->Bits() % uint64_t(hierarchy_->Size()))];
      if (e.kind != ElementKind::Light) return e;
    }
  }

  /// Form factor to a polygon with nothing in the way: its closed form at the receiver's samples.
  double Unoccluded(const Element& source, const Element& receiver) const {
    Vec3f corners[kMaximumPolygonCorners];
    const int count = hierarchy_->PolygonCorners(source, corners);
    double mean = 0;
    for (const SurfaceSample& sample : receiver.samples) {
      const Vec3d e = PolygonIrradianceAbove(corners, count, sample.position, receiver.axis);
      mean += Dot(e, Vec3d(receiver.axis)) / kSamplesPerElement;
    }
    return mean;
  }

  RandomScene made_;
  ClusterTree tree_;
  std::vector<uint8_t> lit_;
  std::unique_ptr<ElementHierarchy> hierarchy_;
  std::unique_ptr<RayScene> rays_;
};

TEST_P(TransferLaws, WithinBounds) {
  SCOPED_TRACE(HowToRepeat(GetParam()));
  Random random(GetParam());
  for (int pair = 0; pair < kPairs; ++pair) {
    const Element &source = Pick(&random), &receiver = Pick(&random);
    const bool thorough = random.Bits() % 2;
    const TransferEstimate e = EstimateTransfer(*hierarchy_, *rays_, source, receiver, thorough);
    ASSERT_TRUE(IsFinite(e.transfer)) << "pair " << pair;
    ASSERT_GE(e.visibility, 0) << "pair " << pair;
    ASSERT_LE(e.visibility, 1 + kRounding) << "pair " << pair;
    // Light of radiosity 1 from all around is 1 at the most.
    ASSERT_LE(Length(e.transfer), 1 + kRounding) << "pair " << pair;
    if (!HasShape(receiver)) continue;
    const float factor = Dot(e.transfer, receiver.axis);
    ASSERT_GE(factor, -kRounding) << "pair " << pair;
    if (!HasShape(source)) continue;
    ASSERT_LE(double(factor), Unoccluded(source, receiver) + double(kRounding)) << "pair " << pair;
  }
}

// Far apart, what four samples tell of a kernel is the kernel: it changes over both ends by 4 times
// their radii over the distance, of what two facing ends would have.
TEST_P(TransferLaws, ExchangeIsMutualFarApart) {
  SCOPED_TRACE(HowToRepeat(GetParam()));
  Random random(GetParam());
  int compared = 0;
  for (int pair = 0; pair < 100 * kPairs; ++pair) {
    const Element &a = Pick(&random), &b = Pick(&random);
    if (!HasShape(a) || !HasShape(b)) continue;
    const float distance = Length(a.frame.center - b.frame.center), radii = a.radius + b.radius;
    if (distance < 10 * radii) continue;
    const TransferEstimate forth = EstimateTransfer(*hierarchy_, *rays_, a, b, true);
    const TransferEstimate back = EstimateTransfer(*hierarchy_, *rays_, b, a, true);
    // Partly hidden ends differ by chance.
    const bool isSure = (forth.visibility == 0 || forth.visibility == 1) &&
                        (back.visibility == 0 || back.visibility == 1);
    if (!isSure) continue;
    ++compared;
    const double facing = double(a.area) * double(b.area) / (kPi * double(distance * distance));
    const double power = double(Dot(forth.transfer, b.axis)) * double(b.area);
    const double other = double(Dot(back.transfer, a.axis)) * double(a.area);
    ASSERT_NEAR(power, other, facing * (4 * double(radii / distance) + 2e-3)) << "pair " << pair;
  }
  EXPECT_GT(compared, 20);
}

INSTANTIATE_TEST_SUITE_P(Seeds, TransferLaws, ::testing::ValuesIn(LawSeeds()));

}  // namespace
}  // namespace lambert::testing
