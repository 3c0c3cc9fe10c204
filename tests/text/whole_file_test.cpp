// Files that are there when they are whole.
#include "text/whole_file.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>
#include <thread>

#include "tests/folder.hpp"
#include "text/error.hpp"

namespace muster {
namespace {

namespace fs = std::filesystem;

TEST(WholeFile, TakesThePlaceOfTheOldOneInOneStep) {
  const test::Folder folder;
  const fs::path file = folder.write("a", "old");
  std::ifstream reader(file);
  write_whole(file, "new");
  std::string seen;
  reader >> seen;
  EXPECT_EQ(seen, "old");
  EXPECT_EQ(folder.read("a"), "new");
  EXPECT_FALSE(fs::exists(file.string() + ".part"));
}

TEST(WholeFile, FollowsNoLinkOfItsTemporaryName) {
  const test::Folder folder;
  const fs::path other = folder.write("other", "of somebody");
  fs::create_symlink(other, folder.path() / "a.part");
  write_whole(folder.path() / "a", "mine");
  EXPECT_EQ(folder.read("other"), "of somebody");
  EXPECT_EQ(folder.read("a"), "mine");
  EXPECT_FALSE(fs::is_symlink(folder.path() / "a"));
}

TEST(WholeFile, LeavesTheOldOneWhereItFails) {
  const test::Folder folder;
  fs::create_directories(folder.path() / "a" / "full");  // a folder that is not empty cannot be replaced
  const auto fails = [](const fs::path& file, const std::string& why) {
    EXPECT_THAT([&] { write_whole(file, "x"); },
                testing::Throws<Error>(testing::AllOf(
                    testing::Property(&Error::exit, Exit::io),
                    testing::Property(&Error::what, testing::StrEq(file.string() + ": cannot be written: " + why)))));
  };
  fails(folder.path() / "a", "Is a directory");
  fails(folder.path() / "none" / "a", "No such file or directory");
  EXPECT_FALSE(fs::exists(folder.path() / "a.part"));
}

TEST(WholeFile, IsWrittenByOneAtATime) {
  const test::Folder folder;
  const fs::path file = folder.path() / "a", part = folder.path() / "a.part";
  const int first = open_part(part, IfHeld::fails);
  ASSERT_GE(first, 0);
  ASSERT_TRUE(write_all(first, "first"));
  EXPECT_LT(open_part(part, IfHeld::fails), 0);
  EXPECT_EQ(errno, EWOULDBLOCK);
  EXPECT_EQ(why_unwritten(errno), "is written by another run at this time; expected another file");
  EXPECT_EQ(folder.read("a.part"), "first");
  // Whoever waits meanwhile begins a file of its own, and does not empty the one that is whole.
  std::thread second([&] { write_whole(file, "second"); });
  fs::rename(part, file);
  std::ifstream reader(file);
  close_part(first);
  second.join();
  std::string seen;
  reader >> seen;
  EXPECT_THAT(seen, testing::AnyOf("first", "second"));  // the other may have been done before
  EXPECT_EQ(folder.read("a"), "second");
  EXPECT_FALSE(fs::exists(part));
}

TEST(WholeFile, SaysThatADiskIsFull) {
  const int full = ::open("/dev/full", O_WRONLY);
  ASSERT_GE(full, 0);
  EXPECT_FALSE(write_all(full, "x"));
  EXPECT_EQ(errno, ENOSPC);
  ::close(full);
}

}  // namespace
}  // namespace muster
