#include "Common/Core/OutputFile.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "Common/Core/Error.h"

namespace lambert::testing {

namespace fs = std::filesystem;

static std::string Place(const char* name) {
  return (fs::path(::testing::TempDir()) / name).string();
}

static std::string BytesOf(const std::string& name) {
  std::ifstream file(name, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

/// While it lives, files take as many bytes, as on a disk that is nearly full.
class RoomInFiles {
 public:
  explicit RoomInFiles(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~RoomInFiles() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signalBefore_);
  }
  RoomInFiles(const RoomInFiles&) = delete;
  RoomInFiles& operator=(const RoomInFiles&) = delete;

 private:
  rlimit before_{};
  void (*signalBefore_)(int) = std::signal(SIGXFSZ, SIG_IGN);
};

TEST(OutputFile, ArrivesWhole) {
  const std::string name = Place("whole"), bytes("two\0words", 9);
  WriteOutput(name, bytes);
  EXPECT_EQ(BytesOf(name), bytes);
  EXPECT_FALSE(fs::exists(name + ".part"));
  fs::remove(name);
}

TEST(OutputFile, LeavesNothingWhereItFails) {
  const std::string name = Place("cut");
  const RoomInFiles room(100);
  EXPECT_THROW(WriteOutput(name, std::string(1000, 'x')), Error);
  EXPECT_FALSE(fs::exists(name));
  EXPECT_FALSE(fs::exists(name + ".part"));
}

TEST(OutputFile, LeavesTheEarlierOneWhereItFails) {
  const std::string name = Place("earlier");
  WriteOutput(name, "good");
  {
    const RoomInFiles room(100);
    EXPECT_THROW(WriteOutput(name, std::string(1000, 'x')), Error);
  }
  EXPECT_EQ(BytesOf(name), "good");

  // Nothing can be opened under the other name.
  fs::create_directory(name + ".part");
  EXPECT_THROW(RequireWritable(name), Error);
  EXPECT_THROW(WriteOutput(name, "better"), Error);
  EXPECT_EQ(BytesOf(name), "good");
  fs::remove(name + ".part");
  fs::remove(name);
}

TEST(OutputFile, GoesWhereALinkLeads) {
  const std::string target = Place("target"), link = Place("link");
  fs::remove(link);
  fs::create_symlink("target", link);
  RequireWritable(link);
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_FALSE(fs::exists(target));
  for (const char* bytes : {"new", "over"}) {
    WriteOutput(link, bytes);
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(BytesOf(target), bytes);
  }
  fs::remove(link);
  fs::remove(target);
}

TEST(OutputFile, IsRefusedWhereThereIsNoPlace) {
  EXPECT_THROW(RequireWritable(Place("no such folder/file")), Error);
  EXPECT_THROW(RequireWritable(::testing::TempDir()), Error);
  EXPECT_THROW(WriteOutput("/dev/full", "a byte"), Error);
  EXPECT_TRUE(fs::exists("/dev/full"));
  EXPECT_NO_THROW(RequireWritable(Place("new")));
  EXPECT_FALSE(fs::exists(Place("new")));
}

}  // namespace lambert::testing
