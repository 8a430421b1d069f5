#include "Common/Core/OutputFile.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "Common/Core/Error.h"

namespace lambert::testing {

static std::string Place(const char* name) {
  return (std::filesystem::path(::testing::TempDir()) / name).string();
}

TEST(OutputFile, ArrivesWhole) {
  const std::string name = Place("whole"), bytes("two\0words", 9);
  WriteOutput(name, bytes);
  std::ifstream file(name, std::ios::binary);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), bytes);
  std::filesystem::remove(name);
}

TEST(OutputFile, LeavesNothingWhereItFails) {
  const std::string name = Place("cut");
  std::ofstream(name) << "half";
  EXPECT_THROW(FailToWrite(name), Error);
  EXPECT_FALSE(std::filesystem::exists(name));
}

TEST(OutputFile, IsRefusedWhereThereIsNoPlace) {
  EXPECT_THROW(RequireWritable(Place("no such folder/file")), Error);
  EXPECT_THROW(RequireWritable(::testing::TempDir()), Error);
  EXPECT_THROW(WriteOutput("/dev/full", "a byte"), Error);
  EXPECT_TRUE(std::filesystem::exists("/dev/full"));
  EXPECT_NO_THROW(RequireWritable(Place("new")));
  EXPECT_FALSE(std::filesystem::exists(Place("new")));
}

}  // namespace lambert::testing
