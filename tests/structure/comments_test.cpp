// A path that a comment cites is one of the tree.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../folder.hpp"
#include "cited_paths.hpp"
#include "lines.hpp"

namespace muster::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> texts(const std::string& path, const std::string& text) {
  std::vector<std::string> result;
  for (const Comment& comment : comments_of({path, text}))
    result.push_back(std::to_string(comment.line) + ":" + comment.text);
  return result;
}

TEST(Comments, CitePathsThatAreThere) {
  const auto lost = lost_citations(MUSTER_SOURCE_DIR);
  EXPECT_TRUE(lost.empty()) << "comments that cite what is not in the tree, " << lines(lost);
}

TEST(Comments, OfSourcesAreRead) {
  EXPECT_THAT(
      texts("a.cpp",
            "int n = 1'000;  // one\nauto s = \"// no \\\" // no\";  // two\n/* three\nfour */ char c = '\"'; // five"),
      ElementsAre("1: one", "2: two", "3: three", "4:four ", "4: five"));
  EXPECT_THAT(texts("a.cpp", "auto raw = R\"x(// no )\" )x\";  // yes\n"), ElementsAre("1: yes"));
}

TEST(Comments, OfScriptsCMakeFilesAndWorldsAreRead) {
  EXPECT_THAT(texts("run", "#!/bin/sh\nx='it # no'  # ${#n}, it's\ny=${#x} \\# \"# no\"\n"),
              ElementsAre("1:!/bin/sh", "2: ${#n}, it's"));
  EXPECT_THAT(texts("CMakeLists.txt", "# world's\nset(a \"# no\")  # yes\n"), ElementsAre("1: world's", "2: yes"));
  EXPECT_THAT(texts("a.xml", "<a b=\"# no\"/> <!-- one\ntwo -->\n// no\n"), ElementsAre("1: one", "2:two "));
}

TEST(Comments, PathsAreFound) {
  const std::vector<std::string> tops{"kernel", "docs"};
  EXPECT_THAT(paths_in(" as in kernel/step.cpp, (see docs/a.md#part) and `search/b.hpp`.", tops),
              ElementsAre("kernel/step.cpp", "docs/a.md", "search/b.hpp"));
  EXPECT_THAT(paths_in("m/s, robot/leader/pose, kernel alone, kernels/x, https://host.org/a.md", tops), IsEmpty());
  EXPECT_THAT(
      paths_in("docs/*.md docs/NAME.md ../shared/a.md build/a.csv out/b.csv docs/{x}.md path/to/a.md docs/long/x.md",
               tops),
      IsEmpty());
  EXPECT_THAT(paths_in("kernel/README.md, page.md, a.hpp", tops), ElementsAre("kernel/README.md", "page.md"));
}

TEST(Comments, ALostCitationIsNamed) {
  Folder tree;
  tree.write(
      "room/low/a.hpp",
      "// See low/b.hpp, c.hpp, page.md, GONE.md and\n// docs/lost.md; \"docs/x.md\"\nauto s = \"docs/none.md\";\n");
  tree.write("room/low/b.hpp", "");
  tree.write("docs/reference/page.md", "");
  tree.write("build/a.hpp", "// docs/lost.md\n");
  tree.write("room/world.xml", "<w/>\n<!-- docs/reference/page.md room/gone.csv -->\n");
  EXPECT_THAT(lost_citations(tree.path()),
              ElementsAre("room/low/a.hpp:1: GONE.md", "room/low/a.hpp:2: docs/lost.md", "room/low/a.hpp:2: docs/x.md",
                          "room/world.xml:2: room/gone.csv"));
}

}  // namespace
}  // namespace muster::test
