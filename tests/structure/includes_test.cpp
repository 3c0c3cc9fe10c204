// Includes run down the storeys of the tree and form no circles.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../folder.hpp"
#include "include_graph.hpp"
#include "lines.hpp"
#include "storeys.hpp"

namespace muster::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const std::filesystem::path root = MUSTER_SOURCE_DIR;
constexpr std::size_t largest_circle = 2;  // units; two concepts may know each other, three are a knot

const IncludeGraph& graph_of_the_tree() {
  static const IncludeGraph graph = read_includes(root, top_folders(storeys()));
  return graph;
}

const Storeys two_storeys{{"low", {}}, {"high", {"low"}}, {"high/*", {"low", "high"}}, {"high/top", {"high/room"}}};

TEST(Storeys, TheTableNamesFoldersAndOnlyLowerOnes) {
  const auto faults = table_faults(root, storeys());
  EXPECT_TRUE(faults.empty()) << lines(faults);
}

TEST(Storeys, IncludesRunDown) {
  EXPECT_GE(graph_of_the_tree().includes.size(), 1000u);
  const auto faults = upward_includes(graph_of_the_tree(), storeys());
  EXPECT_TRUE(faults.empty()) << lines(faults) << "\nThe table is tests/structure/storey_table.cpp.";
}

TEST(Storeys, EverySourceHasOne) {
  const auto folders = homeless_folders(graph_of_the_tree(), storeys());
  EXPECT_TRUE(folders.empty()) << lines(folders);
}

TEST(Storeys, EveryQuotedIncludeIsAFileOfTheTree) {
  EXPECT_TRUE(graph_of_the_tree().unresolved.empty()) << lines(graph_of_the_tree().unresolved);
}

TEST(Circles, NoThreeUnitsIncludeOneAnother) {
  const auto found = circles(graph_of_the_tree(), largest_circle);
  EXPECT_TRUE(found.empty()) << lines(found);
}

TEST(Storeys, AnIncludeThatRunsUpIsNamed) {
  Folder tree;
  tree.write("high/a.hpp", "#include \"low/b.hpp\"\n#include <vector>\n");
  tree.write("low/b.hpp", "#pragma once\n\n  #  include \"high/a.hpp\"\n");
  EXPECT_THAT(upward_includes(read_includes(tree.path(), top_folders(two_storeys)), two_storeys),
              ElementsAre("low/b.hpp:3: low includes high (high/a.hpp); it may include nothing"));
}

TEST(Storeys, AStarMakesARoomOfEachFolder) {
  Folder tree;
  tree.write("high/shared.hpp", "");
  tree.write("high/room/own.hpp", "#include \"high/shared.hpp\"\n");
  tree.write("high/room/a.hpp", "#include \"own.hpp\"\n#include \"../other/b.hpp\"\n");
  tree.write("high/other/b.hpp", "");
  tree.write("high/top/c.hpp", "#include \"high/room/a.hpp\"\n#include \"high/other/b.hpp\"\n");
  EXPECT_THAT(
      upward_includes(read_includes(tree.path(), top_folders(two_storeys)), two_storeys),
      ElementsAre("high/room/a.hpp:2: high/room includes high/other (high/other/b.hpp); it may include low, high",
                  "high/top/c.hpp:2: high/top includes high/other (high/other/b.hpp); it may include high/room"));
}

TEST(Storeys, AUnitCanBeARoom) {
  Folder tree;
  tree.write("high/result.hpp", "");
  tree.write("high/result.cpp", "#include \"result.hpp\"\n#include \"room/a.hpp\"\n");
  tree.write("high/room/a.hpp", "#include \"high/result.hpp\"\n");
  const Storeys table{{"high/result", {}}, {"high/room", {"high/result"}}};
  const IncludeGraph graph = read_includes(tree.path(), top_folders(table));
  EXPECT_THAT(table_faults(tree.path(), table), IsEmpty());
  EXPECT_THAT(homeless_folders(graph, table), IsEmpty());
  EXPECT_THAT(
      upward_includes(graph, table),
      ElementsAre("high/result.cpp:2: high/result includes high/room (high/room/a.hpp); it may include nothing"));
}

TEST(Storeys, ASourceOutsideTheTableIsNamed) {
  Folder tree;
  tree.write("low/new/a.hpp", "#include \"low/b.hpp\"\n");
  tree.write("low/b.hpp", "");
  tree.write("low/c.hpp", "");
  const Storeys table{{"low/new", {}}};
  const IncludeGraph graph = read_includes(tree.path(), top_folders(table));
  EXPECT_THAT(homeless_folders(graph, table), ElementsAre("low"));
  EXPECT_THAT(upward_includes(graph, table),
              ElementsAre("low/new/a.hpp:1: low/new includes what has no storey (low/b.hpp); it may include nothing"));
}

TEST(Storeys, FaultsOfATableAreNamed) {
  Folder tree;
  tree.write("low/a.hpp", "");
  EXPECT_THAT(
      table_faults(tree.path(), {{"low", {"attic", "middle"}}, {"middle", {"low"}}}),
      ElementsAre("low: may include attic, which is no room of the table",
                  "low: may include middle, which does not lie below it", "middle: there is no such folder or unit"));
}

TEST(Storeys, AnIncludeThatIsNowhereIsNamed) {
  Folder tree;
  tree.write("low/a.cpp", "#include \"muster/plugin.hpp\"\n#include \"lost.hpp\"\n#include \"fading/found.hpp\"\n");
  tree.write("plugins/fading/found.hpp", "");
  tree.write("plugin_api/muster/plugin.hpp", "");
  const IncludeGraph graph = read_includes(tree.path(), {"low"});
  EXPECT_THAT(
      graph.unresolved,
      ElementsAre("low/a.cpp:2: \"lost.hpp\" is not beside the file, below the root, in plugins/ or in plugin_api/"));
  ASSERT_EQ(graph.includes.size(), 2u);
  EXPECT_EQ(graph.includes[0].to, "plugin_api/muster/plugin.hpp");
  EXPECT_EQ(graph.includes[1].to, "plugins/fading/found.hpp");
}

TEST(Circles, ACircleIsWalked) {
  Folder tree;
  tree.write("low/a.hpp", "#include \"b.hpp\"\n");
  tree.write("low/b.hpp", "");
  tree.write("low/b.cpp", "#include \"b.hpp\"\n#include \"c.hpp\"\n");
  tree.write("low/c.hpp", "#include \"d.hpp\"\n#include \"a.hpp\"\n");
  tree.write("low/d.hpp", "#include \"c.hpp\"\n");
  tree.write("low/outside.hpp", "#include \"a.hpp\"\n");
  EXPECT_THAT(circles(read_includes(tree.path(), {"low"}), 2), ElementsAre(R"(4 units include one another in a circle:
  low/a.hpp:1 includes low/b.hpp
  low/b.cpp:2 includes low/c.hpp
  low/c.hpp:2 includes low/a.hpp
  and low/d
move what two of them share into a header below both)"));
  EXPECT_THAT(circles(read_includes(tree.path(), {"low"}), 4), IsEmpty());
}

}  // namespace
}  // namespace muster::test
