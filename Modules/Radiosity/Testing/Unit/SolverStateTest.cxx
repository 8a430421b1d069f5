// A solver that is stopped and goes on comes to what one that was never stopped comes to.
#include "Radiosity/Core/SolverState.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "Common/Core/ContentHash.h"
#include "Common/Core/Error.h"
#include "SolverScenes.h"

namespace lambert {
namespace {

/// A lit room with a wall in it, clustered.
struct ClusteredRoom {
  Scene scene;
  ClusterTree tree;

  explicit ClusteredRoom(float wallHeight = 0.6f) {
    testing::AddLitRoom(&scene.mesh, 1, 0.5f, 100);
    testing::AddQuad(&scene.mesh, {0.3f, 0.5f, 0}, {0.5f, 0, 0}, {0, 0, wallHeight},
                     Spectrum(0.3f, 0.5f, 0.7f), Spectrum(), 1, 7);
    testing::CompleteTables(&scene);
    tree = ClusterFaces(&scene.mesh, scene.parts);
  }
};

struct SolvedRoom {
  RadiositySolution solution;
  SolverStatistics statistics;
};

SolvedRoom SolveRoom(const ClusteredRoom& room, const HierarchicalRadiosityOptions& options,
                     const ProgressCallback& progress = {}) {
  HierarchicalRadiosity solver(room.scene, room.tree, options);
  solver.Run(progress);
  return {solver.Solution(), solver.Statistics()};
}

void ExpectSame(const SolvedRoom& a, const SolvedRoom& b) {
  EXPECT_TRUE(a.solution.irradiance == b.solution.irradiance);
  EXPECT_TRUE(a.solution.radiosity == b.solution.radiosity);
  EXPECT_TRUE(a.solution.inputIrradiance == b.solution.inputIrradiance);
  EXPECT_TRUE(a.solution.mesh.positions == b.solution.mesh.positions);
  EXPECT_TRUE(a.solution.mesh.triangles == b.solution.mesh.triangles);
  EXPECT_TRUE(a.solution.leafId == b.solution.leafId);
  EXPECT_EQ(a.statistics.rays, b.statistics.rays);
  EXPECT_EQ(a.statistics.Links(), b.statistics.Links());
  EXPECT_EQ(a.statistics.linksAtFloor, b.statistics.linksAtFloor);
  EXPECT_EQ(a.statistics.stoppedBy, b.statistics.stoppedBy);
  ASSERT_EQ(a.statistics.history.size(), b.statistics.history.size());
  for (size_t i = 0; i < a.statistics.history.size(); ++i) {
    EXPECT_EQ(a.statistics.history[i].iteration, b.statistics.history[i].iteration);
    EXPECT_EQ(a.statistics.history[i].threshold, b.statistics.history[i].threshold);
    EXPECT_EQ(a.statistics.history[i].rays, b.statistics.history[i].rays);
    EXPECT_EQ(a.statistics.history[i].error, b.statistics.history[i].error);
  }
}

class SolverStateTest : public ::testing::Test {
 protected:
  SolverStateTest() {
    std::string folder = (std::filesystem::temp_directory_path() / "lambert-state-XXXXXX").string();
    folder_ = mkdtemp(folder.data());
    options_.error = 0.3;
    options_.verificationPoints = 200;
  }
  ~SolverStateTest() override { std::filesystem::remove_all(folder_); }

  std::string Name(const std::string& name) const { return (folder_ / name).string(); }
  /// The state of the room after so many iterations.
  std::string Saved(int iterations) {
    HierarchicalRadiosityOptions options = options_;
    options.iterations = iterations;
    options.saveState = this->Name("saved.state");
    SolveRoom(room_, options);
    return options.saveState;
  }
  /// What is said where `room` goes on from a file.
  std::string Refusal(const ClusteredRoom& room, const std::string& file) const {
    HierarchicalRadiosityOptions options = options_;
    options.resume = file;
    try {
      HierarchicalRadiosity solver(room.scene, room.tree, options);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  const ClusteredRoom room_;
  HierarchicalRadiosityOptions options_;
  std::filesystem::path folder_;
};

// After every iteration, those of the final gather too.
TEST_F(SolverStateTest, GoesOnToTheSameBits) {
  const SolvedRoom whole = SolveRoom(room_, options_);
  for (int stop = 1; stop <= int(whole.statistics.history.size()); stop += 2) {
    HierarchicalRadiosityOptions options = options_;
    options.resume = this->Saved(stop);
    ExpectSame(whole, SolveRoom(room_, options));
  }
}

TEST_F(SolverStateTest, GoesOnWithLinksAloneWhereTheErrorWasMet) {
  options_.finalGather = false;
  const SolvedRoom first = SolveRoom(room_, options_);
  ASSERT_EQ(first.statistics.stoppedBy, "error");
  options_.saveState = this->Name("saved.state");
  ExpectSame(first, SolveRoom(room_, options_));

  // The same request is met by what there is; another one is refined to.
  options_.resume = options_.saveState;
  ExpectSame(first, SolveRoom(room_, options_));
  options_.error = 0.5 * first.statistics.history.back().error;
  const SolvedRoom finer = SolveRoom(room_, options_);
  EXPECT_EQ(finer.statistics.stoppedBy, "error");
  EXPECT_LE(finer.statistics.history.back().error, options_.error);
  EXPECT_GT(finer.statistics.history.size(), first.statistics.history.size());
}

// What an iteration that was broken off did to elements does not show.
TEST_F(SolverStateTest, KeepsTheLastWholeIteration) {
  const SolvedRoom whole = SolveRoom(room_, options_);
  options_.saveState = this->Name("saved.state");
  int calls = 0;
  const SolvedRoom broken =
      SolveRoom(room_, options_, [&](double, const char*) { return ++calls < 30; });
  ASSERT_EQ(broken.statistics.stoppedBy, "interrupt");
  ASSERT_LT(broken.statistics.history.size(), whole.statistics.history.size());
  options_.resume = options_.saveState;
  ExpectSame(whole, SolveRoom(room_, options_));
}

TEST_F(SolverStateTest, RefusesTheStateOfAnotherScene) {
  const std::string saved = this->Saved(2);
  EXPECT_EQ(this->Refusal(room_, saved), "");
  EXPECT_NE(this->Refusal(ClusteredRoom(0.5f), saved).find("other geometry"), std::string::npos);
  ClusteredRoom painted = room_;
  painted.scene.mesh.reflectance[3].g += 0.01f;
  EXPECT_NE(this->Refusal(painted, saved).find("other materials"), std::string::npos);
  ClusteredRoom lit = room_;
  lit.scene.lights.emplace_back().intensity = Spectrum(1.f);
  EXPECT_NE(this->Refusal(lit, saved).find("other lights"), std::string::npos);
  options_.leafMesh.snapTolerance = 0.1f;
  EXPECT_NE(this->Refusal(room_, saved).find("another refinement"), std::string::npos);
}

TEST_F(SolverStateTest, RefusesFilesThatAreNotWhole) {
  // Not there; something else.
  EXPECT_NE(this->Refusal(room_, this->Name("none")).find("cannot be read"), std::string::npos);
  const std::string other = this->Name("other");
  for (const char* text : {"", "Lambert", "solid cube\nfacet normal 0 0 1\nouter loop\nvertex 0"}) {
    std::ofstream(other) << text;
    EXPECT_NE(this->Refusal(room_, other).find("is no state"), std::string::npos) << text;
  }

  // Cut short anywhere, a byte changed, another version.
  const std::string saved = this->Saved(2);
  const auto size = std::filesystem::file_size(saved);
  for (const uintmax_t left : {uintmax_t(56), uintmax_t(63), size / 2, size - 1}) {
    std::filesystem::copy_file(saved, other, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(other, left);
    EXPECT_NE(this->Refusal(room_, other).find("cut short"), std::string::npos) << left;
  }
  const auto change = [&](std::streamoff at) {
    std::filesystem::copy_file(saved, other, std::filesystem::copy_options::overwrite_existing);
    std::fstream(other, std::ios::binary | std::ios::in | std::ios::out).seekp(at).put('\x7e');
    return this->Refusal(room_, other);
  };
  EXPECT_NE(change(std::streamoff(size / 2)).find("changed"), std::string::npos);
  EXPECT_NE(change(8).find("another version"), std::string::npos);

  // Whole, and of elements that are made no more.
  std::string bytes(size, ' ');
  std::ifstream(saved, std::ios::binary).read(bytes.data(), std::streamsize(size));
  ++bytes[48];
  const uint64_t hash = HashOfBytes(bytes.data(), size - sizeof(uint64_t), 0);
  std::memcpy(&bytes[size - sizeof hash], &hash, sizeof hash);
  std::ofstream(other, std::ios::binary) << bytes;
  EXPECT_NE(this->Refusal(room_, other).find("other elements"), std::string::npos);
}

TEST_F(SolverStateTest, SaysWhatCannotBeWrittenAndGoesOn) {
  options_.saveState = this->Name("no folder/saved.state");
  HierarchicalRadiosity solver(room_.scene, room_.tree, options_);
  solver.Run();
  const std::string& failure = solver.Statistics().stateFailure;
  EXPECT_NE(failure.find("cannot be written"), std::string::npos);
  EXPECT_FALSE(solver.Solution().mesh.triangles.empty());
}

}  // namespace
}  // namespace lambert
