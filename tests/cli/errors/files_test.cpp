// FAULTS 1 to 4: files that are no world, and files made to hurt.
#include <sys/stat.h>

#include <cstdlib>

#include "program.hpp"
#include "tests/sanitized.hpp"

using namespace muster::test;

namespace {

const std::string root = R"(<world name="w" dt="0.1" until="1">)";

// Fault 1 allows 100 ms and 50 MB.
void expect_cheap(const Outcome& outcome) {
  if (sanitized) return;
  EXPECT_LT(outcome.cpu_seconds, 0.1);
  EXPECT_LT(outcome.peak_kilobytes, 50'000);
}

struct Case {
  const char* file;
  const char* message;
};

TEST(Fault1, AFileThatIsNoWorldIsRefusedAtOnce) {
  const ProgramFolder folder;
  std::filesystem::create_directory(folder.path() / "folder");
  folder.write("empty.xml", "");
  folder.write("large.xml", "");
  std::filesystem::resize_file(folder.path() / "large.xml", std::uintmax_t{5} << 30);  // takes no room on disk
  ASSERT_EQ(::mkfifo((folder.path() / "fifo").c_str(), 0666), 0);
  for (const Case& c :
       {Case{"absent.xml", "absent.xml: no such file"}, Case{"folder", "folder/world.xml: no such file"},
        Case{"empty.xml", "empty.xml: is empty; expected an XML element"},
        Case{"large.xml", "large.xml: has 5368709120 bytes; expected at most 16777216"},
        Case{"fifo", "fifo: is not a regular file"}, Case{"/dev/zero", "/dev/zero: is not a regular file"}}) {
    SCOPED_TRACE(c.file);
    for (const char* verb : {"check", "run", "graph"}) {
      const auto outcome = folder.muster({verb, c.file});
      expect_error(outcome, 2, c.message);
      expect_cheap(outcome);
    }
  }
}

TEST(Fault2, BrokenXmlIsRefusedWithItsPlace) {
  const ProgramFolder folder;
  folder.expect_refused(R"(<world name="w" dt="0.1" until="1"><material name="a)",
                        R"(world.xml:1:52: the value of "name" is cut off; expected a closing ")");
  folder.expect_refused(root + "\n</world><world/>", "world.xml:2:9: <world> is a second root element; expected one");
  folder.expect_refused("<world name=\"w\"\n name=\"v\" dt=\"0.1\" until=\"1\"/>",
                        R"(world.xml:2:2: attribute "name" stands twice in the tag "world"; expected one)");
  folder.expect_refused(
      "<world name=\"\xff\" dt=\"0.1\" until=\"1\"/>",
      "world.xml:1:14: byte 14 of the file, 0xff, is not valid UTF-8; is it Latin-1, as editors of Windows "
      "write? expected UTF-8: iconv -f ISO-8859-1 -t UTF-8 world.xml > NEW");
  folder.expect_refused(std::string("\xff\xfe<\0w\0", 6),
                        "world.xml: is UTF-16; expected UTF-8: iconv -f UTF-16 -t UTF-8 world.xml > NEW");
}

TEST(Fault2, AByteOrderMarkIsFine) {
  const ProgramFolder folder;
  folder.write("world.xml", "\xef\xbb\xbf" + world_of(""));
  const auto outcome = folder.muster({"check", "world.xml"});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "w: 0 instances, 0 tables; nothing is wrong\n");
}

TEST(Fault3, DepthAndAttributesAreLimitedBeforeAnythingIsBuilt) {
  const ProgramFolder folder;
  std::string deep = root;
  for (int i = 0; i < 1'000'000; ++i) deep += "<a>";
  folder.write("deep.xml", deep);
  std::string wide = "<world";
  for (int i = 0; i < 40'000; ++i) wide += " a" + std::to_string(i) + "=\"1\"";
  folder.write("wide.xml", wide + "/>");
  const auto of_deep = folder.muster({"check", "deep.xml"}), of_wide = folder.muster({"check", "wide.xml"});
  expect_error(of_deep, 2, R"(deep.xml:1:225: "a" is nested too deep; expected at most 64 elements in each other)");
  expect_error(of_wide, 2, R"(wide.xml:1:1: the tag "world" has too many attributes; expected at most 256)");
  EXPECT_LT(of_deep.cpu_seconds, 1);
  EXPECT_LT(of_wide.cpu_seconds, 1);
}

const char* const laughs =
    "<!DOCTYPE w [<!ENTITY a \"ha\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;\">]>\n"
    "<world name=\"&b;\" dt=\"0.1\" until=\"1\"/>";

TEST(Fault4, EntitiesAreNotSupported) {
  const ProgramFolder folder;
  folder.expect_refused(laughs, "world.xml:1:1: entities are not supported; expected no <!DOCTYPE> and no <!ENTITY>");
  folder.expect_refused(
      "<world name=\"&b;\" dt=\"0.1\" until=\"1\"/>",
      R"(world.xml:1:14: entities are not supported: "b"; expected &lt; &gt; &amp; &quot; or &apos;)");
}

// The entity's file is a pipe that nobody writes: to open it would block, and its name would stand in a trace.
TEST(Fault4, NoFileThatAnEntityNamesIsOpened) {
  const ProgramFolder folder;
  const std::string target = (folder.path() / "secret").string();
  ASSERT_EQ(::mkfifo(target.c_str(), 0666), 0);
  folder.write("world.xml", "<!DOCTYPE w [<!ENTITY a SYSTEM \"file://" + target +
                                "\">]>\n<world name=\"&a;\" dt=\"0.1\" until=\"1\"/>");
  const std::string message = "world.xml:1:1: entities are not supported; expected no <!DOCTYPE> and no <!ENTITY>";
  const auto plain = folder.muster({"check", "world.xml"});
  expect_error(plain, 2, message);
  EXPECT_LT(plain.cpu_seconds, 1);
  // Where processes may be traced, see the calls themselves.
  if (std::system("strace -qq -o /dev/null true >/dev/null 2>&1") != 0) GTEST_SKIP() << "needs strace";
  Surroundings traced;
  traced.environment = {"ASAN_OPTIONS=detect_leaks=0"};  // the leak check cannot run under ptrace
  traced.wrapper = {"strace", "-f", "-qq", "-e", "trace=open,openat,stat,newfstatat,access", "-o", "trace"};
  expect_error(folder.muster({"check", "world.xml"}, traced), 2, message);
  const std::string trace = folder.read("trace");
  EXPECT_NE(trace.find("world.xml"), trace.npos);
  EXPECT_EQ(trace.find("secret"), trace.npos);
}

}  // namespace
