// What elements and links take is what is said, and a run stays below its ceiling.
#include "Radiosity/Core/SolverMemory.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include "SolverScenes.h"

namespace lambert {
namespace {

/// Bytes that are allocated, in the heap and apart from it.
double AllocatedBytes() {
  const struct mallinfo2 info = mallinfo2();
  return double(info.uordblks) + double(info.hblkhd);
}

struct ClusteredScene {
  Scene scene = testing::DataScene("CornellBox");
  ClusterTree tree = ClusterFaces(&scene.mesh, scene.parts);
};

/// Links alone, finer than the lit sides and the scene weigh.
HierarchicalRadiosityOptions FineLinks(int iterations) {
  HierarchicalRadiosityOptions options;
  options.error = 0.01;
  options.finalGather = false;
  options.verificationPoints = 0;
  options.iterations = iterations;
  return options;
}

// What a finer solution takes more than a coarser one: at most what is said, and not under half of
// it, or ceilings would stop runs for nothing.
TEST(SolverMemoryTest, StatesWhatElementsAndLinksTake) {
  const ClusteredScene box;
  double bytes[2], stated[2];
  for (const int fine : {0, 1}) {
    const double before = AllocatedBytes();
    HierarchicalRadiosity solver(box.scene, box.tree, FineLinks(fine ? 6 : 3));
    solver.Run();
    bytes[fine] = AllocatedBytes() - before;
    const SolverStatistics& s = solver.Statistics();
    stated[fine] = double(kElementBytes * s.Elements() + kLinkBytes * s.Links());
  }
  const double share = (bytes[1] - bytes[0]) / (stated[1] - stated[0]);
  EXPECT_LT(share, 1);
  EXPECT_GT(share, 0.5);
}

// What stays of shown light for another one is at most what is said, and nothing stays under a
// ceiling that has no room for it.
TEST(SolverMemoryTest, StatesWhatKeptTransfersTake) {
  const ClusteredScene box;
  HierarchicalRadiosityOptions options = FineLinks(4);
  options.keepsTransfers = true;
  HierarchicalRadiosity solver(box.scene, box.tree, options);
  solver.Run();
  const double before = AllocatedBytes();
  const int64_t triangles = solver.Solution().mesh.FaceCount();
  const double kept = AllocatedBytes() - before;
  const double stated =
      double(kKeptTriangleBytes * triangles) + double(kKeptLinkBytes * solver.Statistics().Links());
  EXPECT_LT(kept, stated);
  EXPECT_GT(kept, 0.2 * stated);

  options.memoryLimit = 1;
  HierarchicalRadiosity limited(box.scene, box.tree, options);
  limited.Run();
  for (int64_t shown : {1, 2}) {
    limited.Solution();
    EXPECT_EQ(limited.Statistics().linkMeshes, shown);
  }
}

TEST(SolverMemoryTest, EndsARunAtItsCeiling) {
  // Room for some of the six iterations.
  const ClusteredScene box;
  HierarchicalRadiosityOptions options = FineLinks(6);
  options.memoryLimit = double(ResidentMemoryBytes()) / 1e6 + 25;
  HierarchicalRadiosity limited(box.scene, box.tree, options);
  limited.Run();
  const SolverStatistics& s = limited.Statistics();
  EXPECT_EQ(s.stoppedBy, "memory");
  ASSERT_GT(s.history.size(), 1u);
  ASSERT_LT(s.history.size(), 6u);
  EXPECT_LT(double(ResidentMemoryBytes()) / 1e6, options.memoryLimit);

  // The light is that of as many iterations; a refinement that was broken off leaves finer
  // triangles, at which the same light is summed to within a hundredth.
  HierarchicalRadiosity same(box.scene, box.tree, FineLinks(int(s.history.size())));
  same.Run();
  EXPECT_EQ(same.Statistics().Links(), s.Links());
  EXPECT_NEAR(s.absorbed.g / same.Statistics().absorbed.g, 1, 0.01);
}

// The first iteration is made in any case.
TEST(SolverMemoryTest, AlwaysDelivers) {
  const ClusteredScene box;
  HierarchicalRadiosityOptions options = FineLinks(6);
  options.memoryLimit = 1;
  HierarchicalRadiosity solver(box.scene, box.tree, options);
  solver.Run();
  EXPECT_EQ(solver.Statistics().stoppedBy, "memory");
  EXPECT_EQ(solver.Statistics().history.size(), 1u);
  EXPECT_GT(solver.Solution().mesh.FaceCount(), 0);
}

// Where refinement is broken off, elements that it made have their part of the light: no power is
// lost with them. Light between iterations changes by a thousandth.
TEST(SolverMemoryTest, LosesNoLightWhereRefinementIsBrokenOff) {
  const ClusteredScene box;
  HierarchicalRadiosity whole(box.scene, box.tree, FineLinks(3));
  whole.Run();
  HierarchicalRadiosity broken(box.scene, box.tree, FineLinks(4));
  int rounds = 0;
  broken.Run([&](double, const char* stage) {
    const bool isFourth = broken.Statistics().history.size() == 3;
    return !(isFourth && std::string(stage) == "refining links" && ++rounds > 3);
  });
  ASSERT_EQ(broken.Statistics().stoppedBy, "interrupt");
  ASSERT_GT(broken.Statistics().Elements(), whole.Statistics().Elements());
  const Spectrum &a = broken.Statistics().absorbed, &b = whole.Statistics().absorbed;
  for (int band = 0; band < 3; ++band) EXPECT_NEAR(a[band] / b[band], 1, 0.01);
}

}  // namespace
}  // namespace lambert
