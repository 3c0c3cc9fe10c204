// What is packed comes out as it was, and what is hostile does not come out.
#include "bundle/archive.hpp"

#include <gtest/gtest.h>

#include <set>

#include "hostile.hpp"
#include "tests/folder.hpp"
#include "text/error.hpp"

namespace muster::test {
namespace {

namespace fs = std::filesystem;
using namespace muster::bundle;

class Archives : public testing::Test {
 protected:
  Archives() { fs::create_directories(inside()); }
  fs::path inside() const { return folder / "deep/down/inside"; }
  std::string refusal(const std::vector<HostileEntry>& entries, const Limits& limits = {}) {
    write_archive(folder / "x.tar.zst", entries);
    return refusal_of_file(limits);
  }
  // Whatever was in it, nothing is to have come to lie beside the folder.
  std::string refusal_of_file(const Limits& limits = {}) {
    const auto before = outside();
    std::string result;
    try {
      unpack(folder / "x.tar.zst", inside(), limits);
    } catch (const Error& e) {
      EXPECT_EQ(e.exit(), Exit::invalid_input);
      result = folder.inside(e.what());
    }
    EXPECT_EQ(outside(), before);
    return result;
  }
  std::set<std::string> outside() const {
    std::set<std::string> result;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
      const std::string name = entry.path().lexically_relative(folder.path()).string();
      if (!name.starts_with("deep/down/inside/")) result.insert(name);
    }
    return result;
  }

  Folder folder;
};

TEST_F(Archives, GiveBackWhatWasPacked) {
  std::string all;
  for (unsigned i = 0; i < 300'000; ++i) all += static_cast<char>(i * 7919u % 256u);
  const std::string far = std::string(60, 'd') + '/' + std::string(200, 'f');  // longer than tar's own field
  const std::vector<std::string> names{"bundle.json", "a/empty.csv", "a/b/all bytes", "a/\xC3\xBC.csv", far};
  for (const std::string& name : names) folder.write("from/" + name, name == "a/empty.csv" ? "" : name + all);
  pack(folder / "from", names, folder / "x.tar.zst");
  EXPECT_EQ(refusal_of_file(), "");
  for (const std::string& name : names) EXPECT_EQ(contents(inside() / name), folder.read("from/" + name)) << name;
  EXPECT_FALSE(fs::exists(folder / "x.tar.zst.part"));
}

TEST_F(Archives, AreTheSameBytesWheneverTheFilesAre) {
  folder.write("from/a", "one");
  pack(folder / "from", {"a"}, folder / "x.tar.zst");
  fs::last_write_time(folder / "from/a", fs::file_time_type::clock::now() - std::chrono::hours(9));
  pack(folder / "from", {"a"}, folder / "y.tar.zst");
  EXPECT_EQ(folder.read("x.tar.zst"), folder.read("y.tar.zst"));
}

TEST_F(Archives, AreNotWrittenOverAFile) {
  folder.write("from/a", "one");
  folder.write("x.tar.zst", "mine");
  EXPECT_THROW(pack(folder / "from", {"a"}, folder / "x.tar.zst"), Error);
  EXPECT_EQ(folder.read("x.tar.zst"), "mine");
}

TEST_F(Archives, LeaveNothingWhereTheyCannotBeWritten) {
  folder.write("from/a", "one");
  EXPECT_ANY_THROW(pack(folder / "from", {"a", "b"}, folder / "x.tar.zst"));
  EXPECT_FALSE(fs::exists(folder / "x.tar.zst"));
  EXPECT_FALSE(fs::exists(folder / "x.tar.zst.part"));
}

TEST_F(Archives, DoNotLeaveTheirFolder) {
  const std::string leaves = "which leaves the bundle; expected a path inside of it";
  EXPECT_EQ(refusal({{"a", "1"}, {"../out", "2"}}), "x.tar.zst: has \"../out\", " + leaves);
  EXPECT_EQ(refusal({{"b/../../out", "2"}}), "x.tar.zst: has \"b/../../out\", " + leaves);
  EXPECT_EQ(refusal({{"b/..", "2"}}), "x.tar.zst: has \"b/..\", " + leaves);
  EXPECT_EQ(refusal({{"../out", "", AE_IFDIR}}), "x.tar.zst: has \"../out/\", " + leaves);
  const std::string absolute = folder.at("out");
  EXPECT_NE(refusal({{absolute, "2"}}).find("which is absolute"), std::string::npos);
  EXPECT_NE(refusal({{"c/./d", "2"}}).find("which is no plain path"), std::string::npos);
  EXPECT_NE(refusal({{"c//d", "2"}}).find("which is no plain path"), std::string::npos);
  EXPECT_NE(refusal({{"c\nd", "2"}}).find("which has a control character"), std::string::npos);
  EXPECT_NE(refusal({{std::string(2000, 'n'), "2"}}).find("which is too long"), std::string::npos);
}

TEST_F(Archives, HaveNoLinksAndNoDevices) {
  const std::string link = ", which is a link; a bundle has plain files alone";
  EXPECT_EQ(refusal({{"out", "", AE_IFLNK, "../.."}, {"out/x", "2"}}), "x.tar.zst: has \"out\"" + link);
  EXPECT_EQ(refusal({{"mine", "1"}, {"other", "", AE_IFREG, "", "/etc/hostname"}}), "x.tar.zst: has \"other\"" + link);
  for (const int type : {AE_IFIFO, AE_IFCHR, AE_IFBLK})
    EXPECT_EQ(refusal({{"odd", "", type}}),
              "x.tar.zst: has \"odd\", which is no plain file; a bundle has plain files alone");
}

TEST_F(Archives, WriteNoFileTwice) {
  EXPECT_EQ(refusal({{"twice", "1"}, {"twice", "2"}}), "x.tar.zst: has \"twice\" more than once");
  EXPECT_EQ(contents(inside() / "twice"), "1");
  EXPECT_EQ(refusal({{"./again", "1"}, {"again", "2"}}), "x.tar.zst: has \"again\" more than once");
  EXPECT_EQ(refusal({{"file", "1"}, {"file/below", "2"}}), "x.tar.zst: has \"file/below\", below another file of it");
  EXPECT_EQ(refusal({{"dir/file", "1"}, {"dir", "2"}}), "x.tar.zst: has \"dir\" more than once");
}

TEST_F(Archives, EndAtTheirLimits) {
  const Limits limits{4, 3 << 20, 5 << 20};
  const std::string large(2 << 20, 'x');
  EXPECT_EQ(refusal({{"a", large}, {"b", large}, {"c", std::string(1 << 20, 'x')}}, limits), "");
  EXPECT_EQ(refusal({{"d", large}, {"e", large}, {"f", large}}, limits),
            "x.tar.zst: has more than 5 MB of files, and a bundle has no more");
  EXPECT_FALSE(fs::exists(inside() / "f"));
  EXPECT_EQ(refusal({{"g", large + large}}, limits),
            "x.tar.zst: has \"g\" of more than 3 MB, and a file of a bundle has no more");
  EXPECT_FALSE(fs::exists(inside() / "g"));
  EXPECT_EQ(refusal({{"h", ""}, {"i", ""}, {"j", ""}, {"k", ""}, {"l", ""}}, limits),
            "x.tar.zst: has more than 4 entries, and a bundle has no more");
  EXPECT_EQ(refusal(std::vector<HostileEntry>(9, {"m", "", AE_IFDIR}), limits),
            "x.tar.zst: has more than 4 entries, and a bundle has no more");
}

// A header of tar: the size is 11 octal digits from byte 124 on, the sum of the bytes 6 from byte 148 on.
TEST_F(Archives, ClaimNoSizeThatTheyHaveNot) {
  const auto claiming = [&](const std::string& octal) {
    write_archive(folder / "x.tar.zst", {{"n", "short"}}, false);
    std::string bytes = folder.read("x.tar.zst");
    bytes.replace(124, 11, octal);
    bytes.replace(148, 8, "        ");
    unsigned sum = 0;
    for (std::size_t i = 0; i < 512; ++i) sum += static_cast<unsigned char>(bytes[i]);
    char text[8];
    std::snprintf(text, sizeof text, "%06o", sum);
    bytes.replace(148, 7, text, 7);
    folder.write("x.tar.zst", bytes);
    return refusal_of_file();
  };
  EXPECT_EQ(claiming("77777777777"), "x.tar.zst: has \"n\" of more than 1024 MB, and a file of a bundle has no more");
  EXPECT_FALSE(fs::exists(inside() / "n"));
  EXPECT_NE(claiming("00000777777").find("is no whole bundle"), std::string::npos);
}

TEST_F(Archives, ThatAreCutShortOrDamagedAreRefused) {
  folder.write("from/a", std::string(100'000, 'a') + "end");
  folder.write("from/b", "second");
  pack(folder / "from", {"a", "b"}, folder / "whole.tar.zst");
  const std::string whole = folder.read("whole.tar.zst");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    fs::remove_all(inside());
    fs::create_directories(inside());
    folder.write("x.tar.zst", whole.substr(0, length));
    EXPECT_NE(refusal_of_file(), "") << length << " of " << whole.size() << " bytes";
  }
  folder.write("x.tar.zst", "a plain text");
  EXPECT_NE(refusal_of_file().find("is no whole bundle; expected a file that `muster bundle` wrote"),
            std::string::npos);
}

}  // namespace
}  // namespace muster::test
