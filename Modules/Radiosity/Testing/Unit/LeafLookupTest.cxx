// Which leaf lies at a place.
#include "Radiosity/Core/LeafLookup.h"

#include <gtest/gtest.h>

#include "SolverScenes.h"

namespace lambert {
namespace {

TEST(LeafLookup, FindsTheLeafOfEverySample) {
  // A box that is split four times, down to patches.
  testing::ModelledScene modelled;
  testing::AddBox(&modelled.scene.mesh, {0, 0, 0}, {1, 2, 3}, testing::BoxMaterials(0.5f), true);
  modelled.Model();
  ElementHierarchy& hierarchy = *modelled.hierarchy;
  const auto leaves = [&] {
    std::vector<int32_t> found;
    for (int32_t index = 0; index < hierarchy.Size(); ++index) {
      if (hierarchy[index].IsLeaf() && hierarchy[index].canSplit) found.push_back(index);
    }
    return found;
  };
  for (int round = 0; round < 4; ++round) hierarchy.Split(leaves());

  const LeafLookup lookup(hierarchy);
  int asked = 0;
  for (const int32_t leaf : leaves()) {
    const Element& element = hierarchy[leaf];
    if (element.kind != ElementKind::Patch) continue;
    const int32_t face = hierarchy.Leaves().PatchFace(element.item);
    for (const SurfaceSample& sample : element.samples) {
      EXPECT_EQ(lookup.Find(face, element.side, sample.position), leaf);
      ++asked;
    }
  }
  EXPECT_GT(asked, 100);
}

}  // namespace
}  // namespace lambert
