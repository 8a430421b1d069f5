#include "Common/Core/CollectionFile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "Common/Core/Error.h"
#include "Common/Core/OutputFile.h"

namespace lambert::testing {

namespace fs = std::filesystem;

class CollectionFile : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(place_); }
  void TearDown() override { fs::remove_all(place_); }

  std::string Place(const std::string& name) const { return (place_ / name).string(); }
  std::string BytesOf(const std::string& name) const {
    std::ifstream file(place_ / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  }
  /// What lies in a folder, in order.
  std::vector<std::string> FilesIn(const std::string& folder) const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(place_ / folder)) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
  /// Pieces that hold `content` and their number.
  static void Write(const std::string& fileName, const std::vector<std::string>& names,
                    const std::string& content) {
    WriteCollection(fileName, names, [&](size_t piece, const std::string& file) {
      WriteOutput(file, content + std::to_string(piece));
    });
  }
  /// The same on a disk that is full at the last piece.
  static void WriteOnFullDisk(const std::string& fileName, size_t pieces) {
    WriteCollection(fileName, std::vector<std::string>(pieces, "new"),
                    [&](size_t piece, const std::string& file) {
                      if (piece + 1 == pieces) throw Error("The disk is full.");
                      WriteOutput(file, "new");
                    });
  }

 private:
  fs::path place_ = fs::path(::testing::TempDir()) /
                    ::testing::UnitTest::GetInstance()->current_test_info()->name();
};

using Files = std::vector<std::string>;

TEST_F(CollectionFile, NamesPiecesThatLieBesideIt) {
  Write(Place("room.vtpc"), {"Floor", ""}, "piece ");
  EXPECT_EQ(FilesIn(""), (Files{"room", "room.vtpc"}));
  EXPECT_EQ(FilesIn("room"), (Files{"room-0-0.vtp", "room-0-1.vtp"}));
  EXPECT_EQ(BytesOf("room/room-0-1.vtp"), "piece 1");
  const std::string index = BytesOf("room.vtpc");
  EXPECT_NE(index.find("<Partitions index=\"0\" name=\"Floor\">"), std::string::npos) << index;
  EXPECT_NE(index.find("<DataSet index=\"0\" file=\"room/room-0-0.vtp\"/>"), std::string::npos);
  EXPECT_NE(index.find("<Partitions index=\"1\">"), std::string::npos) << "a name that is none";
}

TEST_F(CollectionFile, TakesTheEarlierPiecesAwayAndNothingElse) {
  const Files own{"notes.txt",    "room-1.vtp",  "room-0-0.vtp.bak",
                  "room-x-0.vtp", "room-0-.vtp", "other-0-0.vtp"};
  fs::create_directory(Place("room"));
  for (const std::string& name : own) WriteOutput(Place("room/" + name), "own");
  for (const size_t pieces : {3, 1, 2}) {
    Write(Place("room.vtpc"), Files(pieces, "Wall"), "piece ");
    EXPECT_EQ(FilesIn("room").size(), own.size() + pieces);
    for (const std::string& name : own) EXPECT_EQ(BytesOf("room/" + name), "own") << name;
  }
}

TEST_F(CollectionFile, LeavesTheEarlierOneWhereItFails) {
  Write(Place("room.vtpc"), {"a", "b"}, "good");
  const std::string index = BytesOf("room.vtpc");
  const Files pieces = FilesIn("room");

  // A piece that does not arrive.
  EXPECT_THROW(WriteOnFullDisk(Place("room.vtpc"), 3), Error);
  EXPECT_EQ(FilesIn("room"), pieces);

  // A list of them that does not.
  fs::create_directory(Place("room.vtpc.part"));
  EXPECT_THROW(Write(Place("room.vtpc"), {"a"}, "new"), Error);
  EXPECT_EQ(FilesIn("room"), pieces);
  EXPECT_EQ(BytesOf("room.vtpc"), index);
  EXPECT_EQ(BytesOf("room/" + pieces[0]), "good0");
}

TEST_F(CollectionFile, LeavesNothingWhereItFails) {
  EXPECT_THROW(WriteOnFullDisk(Place("room.vtpc"), 2), Error);
  fs::create_symlink("/dev/full", Place("full.vtpc"));
  EXPECT_THROW(Write(Place("full.vtpc"), {"a"}, "new"), Error);
  EXPECT_EQ(FilesIn(""), Files{"full.vtpc"});
}

TEST_F(CollectionFile, IsTriedWithoutATrace) {
  RequireWritableCollection(Place("room.vtpc"));
  EXPECT_TRUE(FilesIn("").empty());
  Write(Place("room.vtpc"), {"a"}, "good");
  RequireWritableCollection(Place("room.vtpc"));
  EXPECT_EQ(FilesIn("room"), Files{"room-0-0.vtp"});
  EXPECT_EQ(BytesOf("room/room-0-0.vtp"), "good0");
}

TEST_F(CollectionFile, IsRefusedWhereItsFolderCannotBe) {
  WriteOutput(Place("file"), "own");
  EXPECT_THROW(RequireWritableCollection(Place("file.vtpc")), Error);
  EXPECT_THROW(Write(Place("file.vtpc"), {"a"}, "new"), Error);
  EXPECT_EQ(BytesOf("file"), "own");
  EXPECT_THROW(RequireWritableCollection(Place("no such folder/room.vtpc")), Error);
  EXPECT_THROW(RequireWritableCollection("/proc/room.vtpc"), Error);
}

TEST_F(CollectionFile, LiesBesideALinkToIt) {
  fs::create_directory(Place("far"));
  fs::create_symlink("far/target.vtpc", Place("room.vtpc"));
  RequireWritableCollection(Place("room.vtpc"));
  EXPECT_EQ(FilesIn(""), (Files{"far", "room.vtpc"}));
  Write(Place("room.vtpc"), {"a"}, "piece ");
  EXPECT_TRUE(fs::is_symlink(Place("room.vtpc")));
  EXPECT_EQ(BytesOf("far/target.vtpc"), BytesOf("room.vtpc"));
  EXPECT_NE(BytesOf("room.vtpc").find("room/room-0-0.vtp"), std::string::npos);
  EXPECT_EQ(FilesIn("room"), Files{"room-0-0.vtp"});
}

TEST_F(CollectionFile, KnowsItsPieces) {
  const std::string room = Place("room.vtpc");
  EXPECT_TRUE(IsPieceOf(room, Place("room/room-0-0.vtp")));
  EXPECT_TRUE(IsPieceOf(room, Place("room/../room/./room-12-345.vtp.part")));
  for (const char* other : {"room.vtpc", "room", "room-0-0.vtp", "room/room.obj",
                            "room/room-0-0.ply", "room/room-0-0.vtp.partial",
                            "room/more/room-0-0.vtp", "rooms/room-0-0.vtp", "room/rooms-0-0.vtp"}) {
    EXPECT_FALSE(IsPieceOf(room, Place(other))) << other;
  }
}

TEST_F(CollectionFile, IsXmlWhateverTheNames) {
  // As it is, by number, and not at all.
  Write(Place("room.vtpc"),
        {"K\xc3\xbc"
         "che \xf0\x9f\x92\xa1",
         "<a> & \"b\"\n\t/c", "\xff\x01\xc3(\xed\xa0\x80\xc0\x80"},
        "piece ");
  const std::string index = BytesOf("room.vtpc"), none = "\xef\xbf\xbd";
  const std::string twice = none + none;
  for (const std::string& name : {std::string("K\xc3\xbc"
                                              "che \xf0\x9f\x92\xa1"),
                                  std::string("&#60;a&#62; &#38; &#34;b&#34;&#10;&#9;/c"),
                                  twice + none + "(" + twice + none + twice}) {
    EXPECT_NE(index.find("name=\"" + name + "\""), std::string::npos) << name << "\n" << index;
  }

  // Names of files, too.
  Write(Place("no\xfftext & more.vtpc"), {"a"}, "piece ");
  EXPECT_EQ(BytesOf("no%FFtext & more/no%FFtext & more-0-0.vtp"), "piece 0");
  EXPECT_NE(BytesOf("no\xfftext & more.vtpc").find("no%FFtext &#38; more-0-0.vtp"),
            std::string::npos);
  EXPECT_TRUE(IsPieceOf(Place("no\xfftext & more.vtpc"),
                        Place("no%FFtext & more/no%FFtext & more-0-0.vtp")));
}

}  // namespace lambert::testing
