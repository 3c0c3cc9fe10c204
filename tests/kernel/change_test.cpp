// Instances exchanged, inserted, removed and made again between two ticks; planned swaps; a rebuilt library.
#include "toy_world.hpp"

namespace muster {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;
using Changes = ToyWorld;

const std::string mover =
    "<toy.copy_physics name='mover' to='robot/*/pose' columns='" + pose + "' own='true' add='1'/>\n";
const std::string counter = "<toy.copy_physics name='n' to='self/count' own='true' add='1'/>\n";

TEST_F(Changes, AnotherPluginReadsBackTheSameBits) {
  Simulation sim = run(two_robots + "<toy.copy_physics name='mover' to='robot/*/pose' columns='" + pose +
                       "' own='true' times='1.1' add='0.1'/>\n");
  step(sim, 7);
  const auto before = sim.table("robot/*/pose").table->now().data;
  sim.swap("mover", instance("toy.copy_physics", "", {{"to", "robot/*/pose"}, {"columns", pose}, {"own", "true"}}));
  EXPECT_EQ(sim.table("robot/*/pose").table->now().data, before);
  step(sim);  // adds nothing to what it finds
  EXPECT_EQ(sim.table("robot/*/pose").table->now().data, before);
  EXPECT_THAT(messages(sim),
              ElementsAre("7 mover: swapped from toy.copy_physics to toy.copy_physics/1; it cannot hold a tune"));
}

TEST_F(Changes, ASwapSaysWhatItDrops) {
  Simulation sim = run(two_robots + counter);
  step(sim, 3);
  sim.swap("n", instance("toy.copy_physics", "", {{"to", "robot/*/v"}}));
  EXPECT_THAT(messages(sim),
              ElementsAre("3 : dropped instance/n/*/count, which nobody writes any more",
                          "3 n: swapped from toy.copy_physics to toy.copy_physics/1; it cannot hold a tune"));
}

TEST_F(Changes, PrivateStateGoesWithTheName) {
  Simulation sim = run(two_robots + counter);
  step(sim, 3);
  sim.swap("n", instance("toy.copy_sense", "", {{"to", "self/count"}, {"own", "true"}, {"add", "10"}}));
  step(sim);
  EXPECT_EQ(cell(sim, "instance/n/count"), 13);
}

TEST_F(Changes, OtherColumnsAreRefusedUnlessAdopted) {
  Simulation sim =
      run(two_robots +
          "<toy.copy_physics name='n' to='self/state' columns='kept[m] gone[s] unit[s]' own='true' add='1'/>\n");
  step(sim, 3);
  const uint64_t before = sim.digest();
  const Attributes other = {{"to", "self/state"}, {"columns", "fresh unit[m] kept[m]"}, {"own", "true"}};
  EXPECT_EQ(error_of([&] { sim.swap("n", instance("toy.copy_physics", "", other)); }),
            "command line: n (toy.copy_physics): writes \"instance/n/*/state\" as \"fresh unit[m] kept[m]\", but it "
            "holds \"kept[m] gone[s] "
            "unit[s]\" and the plugin does not adopt that");
  EXPECT_EQ(sim.digest(), before);
  Attributes adopting = other;
  adopting.push_back({"flags", "8"});
  sim.swap("n", instance("toy.copy_physics", "", adopting));
  EXPECT_THAT((std::vector<double>{cell(sim, "instance/n/state", 0), cell(sim, "instance/n/state", 1),
                                   cell(sim, "instance/n/state", 2)}),
              ElementsAre(0, 0, 3));
  step(sim);
  EXPECT_EQ(cell(sim, "instance/n/state", 2), 3);
}

// An empty cell is no number, and bytes are no number either.
TEST_F(Changes, WhatIsAdoptedFitsItsColumn) {
  Simulation sim = run(two_robots + "<toy.kinds name='n'/>\n");
  step(sim, 3);
  sim.swap(
      "n",
      instance("toy.copy_sense", "",
               {{"to", "robot/*/kinds"}, {"columns", "rssi[dBm] image{} range0[m]"}, {"flags", "8"}, {"own", "true"}}));
  EXPECT_EQ(cell(sim, "robot/a/kinds", 0), 0);
  EXPECT_EQ(cell(sim, "robot/b/kinds", 1), 1);
  const auto& blob = *sim.table("robot/*/kinds").table->now().blobs.at(0);
  EXPECT_EQ(std::string(blob.begin(), blob.end()), "picture 3.1");
  sim.digest();
}

TEST_F(Changes, AFailedChangeLeavesTheRunAsItWas) {
  put("joins.csv", "t[s],tx,rx,tx_x[m]\n");
  Simulation sim = run(two_robots + mover + counter);
  Simulation other = run(two_robots + mover + counter);
  step(sim, 3), step(other, 3);
  const uint64_t before = sim.digest();
  const auto refused = [&](auto&& change, const std::string& error) {
    EXPECT_THAT(error_of(change), StartsWith(error));
    EXPECT_EQ(sim.digest(), before);
    EXPECT_EQ(sim.instances().size(), 2u);
  };
  const auto with = [](const std::string& to) { return instance("toy.copy_physics", "x", {{"to", to}}); };
  refused([&] { sim.swap("mover", with("self/")); },
          "command line: mover (toy.copy_physics): claims \"self/\"; expected set/row/quantity");
  refused(
      [&] {
        sim.swap("mover", instance("toy.copy_physics", "x", {{"to", "self/private"}, {"from", "robot/*/nothing"}}));
      },
      "command line: mover (toy.copy_physics): reads \"robot/*/nothing\", which nobody writes; expected one of ");
  refused([&] { sim.insert(with("robot/a/pose")); },
          "command line: x (toy.copy_physics): claims \"robot/a/pose\" as \"value\"; its columns are \"" + pose + "\"");
  refused(
      [&] {
        sim.insert(instance("toy.copy_physics", "x", {{"to", "robot/a/pose"}, {"columns", pose}}));
      },
      "command line: x (toy.copy_physics): writes \"robot/a/pose\"; so does world.xml:4:1: mover (toy.copy_physics); "
      "expected one of the two");
  refused(
      [&] {
        sim.insert(instance("toy.copy_physics", "n", {{"to", "self/q"}}));
      },
      "an instance is called \"n\" already: world.xml:5:1: n (toy.copy_physics)");
  refused(
      [&] {
        sim.insert(instance("toy.copy_physics", "x", {{"tow", "self/q"}}));
      },
      "command line: <toy.copy_physics> has no attribute \"tow\"; expected one of name, every, library, revision, "
      "from, and, to, columns, "
      "from_columns, as, flags, read_flags, own, add, times, robot; did you mean \"to\"?");
  refused([&] { sim.swap("mower", with("self/q")); },
          "no instance is called \"mower\"; expected one of mover, n; did you mean \"mover\"?");
  refused([&] { sim.remove("x"); }, "no instance is called \"x\"; expected one of mover, n");
  step(sim, 3), step(other, 3);
  EXPECT_EQ(sim.digest(), other.digest());
  EXPECT_THAT(messages(sim), IsEmpty());
}

TEST_F(Changes, ARunMayShareALibraryWithAnother) {
  Simulation one = run(two_robots + counter), other = run(two_robots + counter);
  const auto library = one.instances().back()->library();
  ASSERT_NE(other.instances().back()->library(), library);
  other.share(library);
  other.insert(instance("toy.copy_physics", "m", {{"to", "self/q"}, {"own", "true"}, {"add", "2"}}));
  EXPECT_EQ(other.instances().back()->library(), library);
  step(other);
  EXPECT_EQ(cell(other, "instance/m/q"), 2);
}

TEST_F(Changes, ManyComeAndGoAtOnceOrNoneDoes) {
  const auto added = [](const std::string& name) {
    return instance("toy.copy_physics", name, {{"to", "self/q"}, {"own", "true"}, {"add", "1"}});
  };
  const auto names = [](const Simulation& sim) {
    std::vector<std::string> result;
    for (const auto& one : sim.instances()) result.push_back(one->name());
    return result;
  };
  Simulation sim = run(two_robots + counter), one_by_one = run(two_robots + counter);
  EXPECT_THAT(error_of([&] {
                sim.insert_all({added("a"), added("n")});
              }),
              StartsWith("an instance is called \"n\" already"));
  EXPECT_THAT(error_of([&] {
                sim.insert_all({added("a"), added("a")});
              }),
              StartsWith("an instance is called \"a\" already"));
  EXPECT_THAT(names(sim), ElementsAre("n"));
  sim.insert_all({added("a"), added("b"), added("c")});
  for (const char* name : {"a", "b", "c"}) one_by_one.insert(added(name));
  step(sim, 2), step(one_by_one, 2);
  EXPECT_EQ(sim.digest(), one_by_one.digest());
  EXPECT_EQ(messages(sim), messages(one_by_one));
  EXPECT_THAT(error_of([&] { sim.remove_all({"b", "b"}); }), StartsWith("no instance is called \"b\""));
  EXPECT_THAT(names(sim), ElementsAre("n", "a", "b", "c"));
  sim.remove_all({"b", "n"});
  EXPECT_THAT(names(sim), ElementsAre("a", "c"));
  step(sim);
  EXPECT_EQ(cell(sim, "instance/c/q"), 3);
}

TEST_F(Changes, WhatIsReadCannotBeRemoved) {
  Simulation sim =
      run(two_robots +
          "<toy.copy_physics name='w' to='robot/*/v'/>\n<toy.copy_radio name='r' from='robot/*/v' to='self/x'/>\n");
  step(sim);
  EXPECT_THAT(error_of([&] { sim.remove("w"); }),
              StartsWith("world.xml:5:1: r (toy.copy_radio): reads \"robot/*/v\", which nobody writes; "));
  EXPECT_EQ(sim.instances()[0]->name(), "w");
  step(sim);
}

TEST_F(Changes, NothingOfAFormerInstanceRemains) {
  Simulation sim = run(two_robots + counter);
  Simulation other = run(two_robots + "<toy.copy_physics name='n' to='robot/*/v'/>\n");
  sim.swap("n", instance("toy.copy_physics", "", {{"to", "robot/*/v"}}));
  step(sim, 2), step(other, 2);
  EXPECT_EQ(sim.digest(), other.digest());
}

TEST_F(Changes, RemakingKeepsStateAndParameters) {
  Simulation sim = run(two_robots + counter);
  step(sim, 3);
  sim.set_parameter("n/add", 5);
  sim.remake("n");
  step(sim);
  EXPECT_EQ(cell(sim, "instance/n/count"), 8);
  EXPECT_EQ(sim.parameter("n/add").value, 5);
}

TEST_F(Changes, PlannedSwapsComeAtTheirTimeOnce) {
  Simulation sim = run(two_robots + counter +
                       "<swap at='2' instance='n' plugin='toy.copy_physics' to='self/count' own='true' add='100'/>\n");
  step(sim, 4);
  EXPECT_EQ(cell(sim, "instance/n/count"), 4);
  step(sim);
  EXPECT_EQ(cell(sim, "instance/n/count"), 104);
  EXPECT_THAT(messages(sim),
              ElementsAre("4 n: swapped from toy.copy_physics to toy.copy_physics/1; it cannot hold a tune"));
}

// toy.join has a parameter `at`, as <swap> has.
TEST_F(Changes, APluginInsideASwapKeepsItsAttributesApart) {
  EXPECT_EQ(
      error_of_world(two_robots + counter + "<swap at='2' instance='n' plugin='toy.join' leave='9'/>\n"),
      "world.xml:5:1: <swap> takes the attribute \"at\" for itself, but toy.join has one of that name; expected the "
      "plugin as an element inside: <swap at=\"...\" instance=\"...\"><toy.join .../></swap>");
  Simulation sim = run(two_robots + "<toy.copy_physics name='m' to='robot/*/pose' columns='" + pose + "'/>\n" +
                       counter + "<swap at='1' instance='n'><toy.join at='4' leave='9'/></swap>\n");
  step(sim, 3);
  EXPECT_EQ(sim.board().find_set("robot")->names.size(), 2u);
  step(sim, 1);
  EXPECT_EQ(sim.board().find_set("robot")->names.size(), 3u);
  const auto swap = [&](const std::string& attributes, const std::string& inside) {
    return error_of_world(two_robots + counter + "<swap at='2' instance='n'" + attributes + ">" + inside + "</swap>\n");
  };
  EXPECT_EQ(swap(" plugin='toy.join'", "<toy.join/>"),
            "world.xml:5:27: <swap> has no attribute \"plugin\"; expected one of at, instance");
  EXPECT_EQ(swap("", "<toy.join name='m'/>"),
            "world.xml:5:37: <toy.join> has no attribute \"name\"; the replacement keeps the name \"n\"");
  EXPECT_EQ(swap("", "<toy.join/><toy.join/>"),
            "world.xml:5:1: <swap> has no attribute \"plugin\", which it needs; expected the new plugin's id, or the "
            "plugin as an element inside");
}

TEST_F(Changes, WhatAPlannedSwapBroughtAndFailedMayBeSwappedAgain) {
  Simulation sim = run(
      two_robots +
      "<toy.fault name='f' fault='none'/>\n<swap at='2' instance='f' plugin='toy.fault' fault='throws' tick='5'/>\n");
  step(sim, 4);
  EXPECT_THAT(error_of([&] { sim.step(); }), HasSubstr("the wheel came off"));
  sim.swap("f", instance("toy.fault", "", {{"fault", "none"}}));
  EXPECT_EQ(error_of([&] { sim.step(); }), "no error");
}

TEST_F(Changes, PlannedSwapsAreCheckedBeforeTheFirstTick) {
  const auto swap = [&](const std::string& attributes) {
    return error_of_world(two_robots + counter + "<swap at='2' " + attributes + "/>\n");
  };
  EXPECT_EQ(swap("instance='m' plugin='toy.copy_physics'"), "world.xml:5:24: no instance is called \"m\"; expected n");
  EXPECT_EQ(swap("instance='n' plugin='toy.copy_physics' tow='x'"),
            "world.xml:5:53: <toy.copy_physics> has no attribute \"tow\"; expected one of name, every, library, "
            "revision, from, and, to, "
            "columns, from_columns, as, flags, read_flags, own, add, times, robot; did you mean \"to\"?");
  EXPECT_EQ(swap("instance='n' plugin='toy.copy_physics' to='robot/c/v'"),
            "world.xml:5:1: n (toy.copy_physics): claims a row of robot called \"c\"; expected one of a, b");
  EXPECT_EQ(swap("instance='n' name='m' plugin='toy.copy_physics'"),
            "world.xml:5:27: <swap> has no attribute \"name\"; the replacement keeps the name \"n\"");
  EXPECT_THAT(swap("instance='n' plugin='toy.copy_fysics'"),
              HasSubstr("3 world.xml:5:1: plugin \"toy.copy_fysics\": toy_copy_fysics.so not found"));
}

TEST_F(Changes, ARebuiltPluginRunsTheNewCode) {
  std::filesystem::copy(MUSTER_BUILD_DIR "/tests/toys/toy_version.so", folder);
  Simulation sim = run(two_robots + "<toy.version name='v' offset='0.5'/>\n<toy.version name='w'/>\n");
  step(sim, 2);
  sim.set_parameter("v/offset", 0.25);
  step(sim);
  EXPECT_EQ(cell(sim, "instance/v/version"), 1.25);
  std::filesystem::copy(MUSTER_BUILD_DIR "/tests/toys_rebuilt/toy_version.so", folder,
                        std::filesystem::copy_options::overwrite_existing);
  step(sim);
  EXPECT_EQ(cell(sim, "instance/v/version"), 1.25);  // a file that changes does not change the run
  sim.reload("v");
  step(sim);
  EXPECT_EQ(cell(sim, "instance/v/version"), 2.25);
  EXPECT_EQ(cell(sim, "instance/v/version", 1), 5);  // steps counted on
  EXPECT_EQ(cell(sim, "instance/w/version"), 1);
  sim.remake("v");  // remaking runs the same code
  step(sim);
  EXPECT_EQ(cell(sim, "instance/v/version"), 2.25);
  EXPECT_THAT(messages(sim), ElementsAre("4 v: reloaded toy.version/1"));
}

TEST_F(Changes, ARebuiltPluginHasItsNewDefaultsAndWhatWasSet) {
  std::filesystem::copy(MUSTER_BUILD_DIR "/tests/toys/toy_version.so", folder);
  Simulation sim = run(two_robots +
                       "<toy.version name='u'/>\n<toy.version name='v' bias='3' mode='fast'/>\n"
                       "<toy.version name='w'/>\n<toy.version name='x'/>\n<toy.version name='y'/>\n");
  sim.set_parameter("w/bias", 5), sim.set_parameter("w/mode", 1);  // fast
  sim.set_parameter("x/bias", -5);
  sim.set_parameter("y/mode", 2);  // odd
  std::filesystem::copy(MUSTER_BUILD_DIR "/tests/toys_rebuilt/toy_version.so", folder,
                        std::filesystem::copy_options::overwrite_existing);
  for (const char* one : {"u", "v", "w"}) sim.reload(one);
  EXPECT_THAT(error_of([&] { sim.reload("x"); }),
              HasSubstr("parameter \"x/bias\": -5 is out of bounds; expected a number from 0 to 10"));
  EXPECT_THAT(error_of([&] { sim.reload("y"); }),
              HasSubstr("parameter \"y/mode\": \"odd\" is not a choice; expected one of off, slow, fast"));
  step(sim);
  const auto cells = [&](const std::string& name) {  // version, bias, mode
    const std::string table = "instance/" + name + "/version";
    return std::vector{cell(sim, table), cell(sim, table, 2), cell(sim, table, 3)};
  };
  EXPECT_THAT(cells("u"), ElementsAre(2, 2, 0));
  EXPECT_THAT(cells("v"), ElementsAre(2, 3, 2));
  EXPECT_THAT(cells("w"), ElementsAre(2, 5, 2));
  EXPECT_THAT(cells("x"), ElementsAre(1, -5, 0));
  EXPECT_THAT(cells("y"), ElementsAre(1, 1, 2));
}

TEST_F(Changes, ALibraryThatCannotBeLoadedLeavesTheRun) {
  std::filesystem::copy(MUSTER_BUILD_DIR "/tests/toys/toy_version.so", folder);
  Simulation sim = run(two_robots + "<toy.version name='v'/>\n");
  step(sim);
  put("toy_version.so", "not a library");
  EXPECT_THAT(error_of([&] { sim.reload("v"); }), HasSubstr("3 world.xml:4:1:"));
  step(sim);
  EXPECT_EQ(cell(sim, "instance/v/version", 1), 2);
}

}  // namespace
}  // namespace muster
