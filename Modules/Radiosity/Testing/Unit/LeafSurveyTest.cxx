// What rays between leaves tell of a floor on which a closed box stands, over which a plate hangs.
#include "Radiosity/Core/LeafSurvey.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Common/Core/Parallel.h"
#include "SolverScenes.h"

namespace lambert {
namespace {

constexpr float kBox = 1, kPlateLow = 2.4f, kPlateHigh = 2.6f;

class LeafSurveyTest : public ::testing::Test {
 protected:
  void SetUp() override {
    TriangleMesh& mesh = modelled_.scene.mesh;
    testing::AddQuad(&mesh, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}, Spectrum(0.5f));
    testing::AddBox(&mesh, {0.5f, 0.5f, 0}, {0.5f + kBox, 0.5f + kBox, kBox},
                    testing::BoxMaterials(0.5f), false);
    const float size = kPlateHigh - kPlateLow;
    testing::AddQuad(&mesh, {kPlateLow, kPlateLow, 0.02f}, {size, 0, 0}, {0, size, 0},
                     Spectrum(0.5f), Spectrum(0.f), 1, 7);
    testing::AddQuad(&mesh, {0, 0, 4}, {0, 4, 0}, {4, 0, 0}, Spectrum(0.5f), Spectrum(0.f), 1, 8);
    modelled_.Model();
    this->SplitIntoTriangles();
    for (int32_t leaf = 0; leaf < modelled_.hierarchy->Size(); ++leaf) {
      const Element& element = (*modelled_.hierarchy)[leaf];
      if (!element.IsLeaf() || element.IsVolume()) continue;
      rows_.leaves.push_back(leaf);
      rows_.areas.push_back(element.area);
    }
    for (size_t i = 0; i <= rows_.leaves.size(); ++i) {
      rows_.begin.push_back(int64_t(i) * kSamplesPerElement * 256);
    }
  }

  void SplitIntoTriangles() {
    ElementHierarchy& hierarchy = *modelled_.hierarchy;
    for (std::vector<int32_t> coarse = {0}; !coarse.empty();) {
      coarse.clear();
      for (int32_t index = 0; index < hierarchy.Size(); ++index) {
        const Element& element = hierarchy[index];
        if (element.IsLeaf() && element.canSplit && !element.IsPolygon()) coarse.push_back(index);
      }
      hierarchy.Split(coarse);
    }
  }
  LeafSurvey Survey() const {
    int64_t rays = 0;
    const LeafLookup leaves(*modelled_.hierarchy);
    const LeafSurvey survey =
        SurveyLeaves(*modelled_.hierarchy, *modelled_.rayScene, rows_, leaves, 1, &rays);
    EXPECT_EQ(rays, int64_t(rows_.leaves.size()) * kSamplesPerElement * 64);
    return survey;
  }
  testing::ModelledScene modelled_;
  LeafRows rows_;
};

TEST_F(LeafSurveyTest, LeavesAreSeenWhereNothingHidesThem) {
  const LeafSurvey survey = this->Survey();
  int moved = 0;
  for (const int32_t leaf : rows_.leaves) {
    const Element& element = (*modelled_.hierarchy)[leaf];
    for (size_t k = 0; k < kSamplesPerElement; ++k) {
      const Vec3f& place = survey.places[size_t(leaf)][k];
      if (place.x == element.samples[k].position.x && place.y == element.samples[k].position.y) {
        continue;
      }
      ++moved;
      EXPECT_TRUE(element.IsPolygon());
      if (!(element.axis.z > 0.5f) || place.z > 1e-3f) continue;
      const bool isUnderBox =
          place.x > 0.5f && place.x < 0.5f + kBox && place.y > 0.5f && place.y < 0.5f + kBox;
      EXPECT_FALSE(isUnderBox) << place.x << " " << place.y;
    }
  }
  EXPECT_GT(moved, 0);
}

TEST_F(LeafSurveyTest, FloorUnderAPlateIsCloseToIt) {
  const LeafSurvey survey = this->Survey();
  bool isFound = false;
  for (const ClosePlace& close : survey.close) {
    EXPECT_GT(close.cover, 0);
    EXPECT_LE(close.cover, 1);
    const Vec3f& place = close.position;
    const bool isOnFloor = std::abs(place.z) < 1e-4f && close.side == kFront;
    isFound = isFound ||
              (isOnFloor && std::abs(place.x - 2.5f) < 0.12f && std::abs(place.y - 2.5f) < 0.12f);
  }
  EXPECT_TRUE(isFound);
}

TEST_F(LeafSurveyTest, IsTheSameForAnyNumberOfThreads) {
  SetThreadCount(2);
  const LeafSurvey many = this->Survey();
  SetThreadCount(1);
  const LeafSurvey single = this->Survey();
  SetThreadCount(0);
  ASSERT_EQ(many.close.size(), single.close.size());
  for (size_t i = 0; i < many.close.size(); ++i) {
    EXPECT_EQ(many.close[i].position.x, single.close[i].position.x);
    EXPECT_EQ(many.close[i].face, single.close[i].face);
  }
  for (size_t leaf = 0; leaf < many.places.size(); ++leaf) {
    for (size_t k = 0; k < kSamplesPerElement; ++k) {
      EXPECT_EQ(many.places[leaf][k].x, single.places[leaf][k].x);
      EXPECT_EQ(many.places[leaf][k].y, single.places[leaf][k].y);
    }
  }
}

}  // namespace
}  // namespace lambert
