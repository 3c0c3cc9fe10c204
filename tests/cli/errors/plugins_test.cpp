// FAULTS 15, 16 and 19: plugins that cannot be loaded, that throw, and that write or read what they must not.
#include <elf.h>
#include <gmock/gmock.h>

#include <cstddef>
#include <cstring>
#include <fstream>

#include "program.hpp"

using namespace muster::test;

namespace {

const std::string toys = MUSTER_TOYS;

Outcome run_toy(const ProgramFolder& folder, const std::string& elements, std::vector<std::string> more = {}) {
  folder.write("world.xml", world_of(elements));
  std::vector<std::string> words = {"run", "world.xml", "--plugins", toys};
  words.insert(words.end(), more.begin(), more.end());
  return folder.muster(words);
}

// ---- 15: what cannot be loaded ----

std::string bytes_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

// Of `check` and `run` alike: nothing has been simulated.
void expect_not_loaded(const ProgramFolder& folder, const std::string& words) {
  folder.write("world.xml", world_of(R"(<test.good library="test_good.so"/>)"));
  for (const char* verb : {"check", "run"}) {
    const auto outcome = folder.muster({verb, "world.xml"});
    expect_error(outcome, 3, "world.xml:1:36: plugin \"test.good\": test_good.so " + words);
    EXPECT_EQ(outcome.out, "");
  }
}

TEST(Fault15, AnAbsentPluginIsToldWithTheFoldersAndTheNearest) {
  const ProgramFolder folder;
  expect_error(run_toy(folder, "<test.god/>"), 3,
               "world.xml:1:36: plugin \"test.god\": test_god.so not found; looked in " + toys + ", " +
                   MUSTER_PLUGINS_DIR + "; did you mean \"test.good\"?");
}

TEST(Fault15, AFileThatIsNoPluginIsRefusedInOneLine) {
  const ProgramFolder folder;
  const std::string good = bytes_of(toys + "/test_good.so");
  expect_not_loaded(folder, "cannot be read: No such file or directory");
  folder.write("test_good.so", "a text, not a library\n");
  expect_not_loaded(folder, R"(is not a shared library: it starts with "a text, not a librar"; expected "\x7fELF")");
  folder.write("test_good.so", good.substr(0, 1000));
  uint64_t size = 0;  // p_filesz of the first program header, which stands behind the file's own
  std::memcpy(&size, good.data() + sizeof(Elf64_Ehdr) + offsetof(Elf64_Phdr, p_filesz), sizeof size);
  expect_not_loaded(folder, "is truncated: it has 1000 bytes, and its segment 0 has " + std::to_string(size) +
                                " from byte 0 on; copy or build it again");
  std::string foreign = good;
  foreign[18] = static_cast<char>(183);  // e_machine: AArch64
  folder.write("test_good.so", foreign);
  expect_not_loaded(folder, "is built for AArch64; expected x86-64; rebuild it for this machine");
}

struct Animal {
  const char* name;
  const char* words;
};

TEST(Fault15, ALibraryThatDoesNotFitIsRefusedInOneLine) {
  const ProgramFolder folder;
  const std::string zoo = MUSTER_ZOO;
  for (const Animal& animal :
       {Animal{"no_register", "does not export muster_register; expected one MUSTER_PLUGIN_IS in it"},
        Animal{"other_abi", "is built for plugin ABI 2; this muster has plugin ABI 1; rebuild it against plugin_api"},
        Animal{"undefined",
               "needs missing::law(double, char const*), which neither it nor a library that it links defines; link "
               "what defines it"}}) {
    SCOPED_TRACE(animal.name);
    const std::string name = animal.name;
    folder.write("world.xml", world_of("<zoo." + name + "/>"));
    expect_error(folder.muster({"run", "world.xml", "--plugins", zoo}), 3,
                 "world.xml:1:36: plugin \"zoo." + name + "\": " + zoo + "/zoo_" + name + ".so " + animal.words);
  }
}

// ---- 16: what throws, in process ----

TEST(Fault16, ThrowsInCreate) {
  const ProgramFolder folder;
  expect_error(run_toy(folder, "<test.throws_in_create name=\"shelf\"/>"), 3,
               "world.xml:1:36: shelf (test.throws_in_create): create failed: no licence found");
}

TEST(Fault16, AParameterThatIsNotDeclaredIsToldWithThoseThatAre) {
  const ProgramFolder folder;
  expect_error(run_toy(folder, "<test.undeclared/>"), 3,
               "world.xml:1:36: test.undeclared (test.undeclared): create failed: parameter \"sise\" is used but not "
               "declared in params; did you mean \"size\"? declared are size");
}

TEST(Fault16, ATextIsThatOfATextParameter) {
  const ProgramFolder folder;
  expect_error(run_toy(folder, "<test.text_of_number/>"), 3,
               "world.xml:1:36: test.text_of_number (test.text_of_number): create failed: asks for the text of the "
               "parameter \"size\", which is a number and has none; expected s.param(\"size\")");
  expect_error(run_toy(folder, "<test.text_of_none/>"), 3,
               "world.xml:1:36: test.text_of_none (test.text_of_none): create failed: parameter \"sise\" is used but "
               "not declared in params; did you mean \"size\"? declared are size");
}

TEST(Fault16, ATextIsNoNumber) {
  expect_error(run_toy(ProgramFolder(), "<test.value_of_text/>"), 3,
               "world.xml:1:36: test.value_of_text (test.value_of_text): create failed: parameter \"gear\" is a text, "
               "and no number; expected s.text(\"gear\"), in the constructor");
}

TEST(Fault16, AnAttributeThatNoCallLooksAtHasNoEffect) {
  const ProgramFolder folder;
  const std::string unused =
      "attribute \"size\" has no effect: the plugin's constructor never looks at it; expected "
      "s.value(\"size\") there, and k[...] of it in step()";
  EXPECT_THAT(run_toy(folder, "<test.good size=\"2\"/>").out, testing::HasSubstr(unused));
  EXPECT_THAT(run_toy(folder, "<test.good/>").out, testing::Not(testing::HasSubstr("has no effect")));
}

TEST(Fault16, AReferenceToRowsOfNoSetIsThePlugins) {
  expect_error(run_toy(ProgramFolder(), "<robot name=\"rover\" at=\"0 0 0\"/><test.refers whose=\"rover\"/>"), 3,
               "world.xml:1:68: test.refers/1: its parameter \"whose\" refers to rows of \"robots\", which is no set; "
               "expected reference(\"whose\", \"robot\", ...) in its source");
}

TEST(Fault16, WhatTheUserGaveWrongIsTheUsers) {
  const ProgramFolder folder;
  expect_error(run_toy(folder, "<test.refuses/>"), 2,
               "world.xml:1:36: test.refuses (test.refuses): the moon is no place for it");
}

TEST(Fault16, ThrowsInStepAndTheLogOfTheTicksBeforeIsWhole) {
  const std::vector<std::string> log = {"--out", "out", "--record", "instance/steady/cell"};
  for (const auto& [toy, said] : {std::pair{"throws_in_step", "!the shelf is empty"},
                                  std::pair{"throws_a_number", "threw something that is not a std::exception"},
                                  std::pair{"throws_out_of_range",
                                            "threw std::out_of_range: no third wheel; a debugger shows where: gdb -ex "
                                            "'catch throw' -ex run --args muster ..."},
                                  std::pair{"bare", "no such shelf"}}) {
    SCOPED_TRACE(toy);
    const ProgramFolder folder;
    const std::string id = std::string("test.") + toy;
    const auto outcome = run_toy(folder, "<test.good name=\"steady\"/>\n<" + id + " name=\"shelf\"/>", log);
    expect_error(outcome, 3, "world.xml:2:1: shelf (" + id + "): step failed at tick 5 (t = 0.5 s): " + said);
    const std::string text = folder.read("out/instance_steady_cell.csv");
    EXPECT_THAT(text, testing::EndsWith(",4\n"));
    EXPECT_THAT(text, testing::StartsWith("t[s],instance"));
  }
}

TEST(Fault16, AStepThatMayKeepStateIsWarnedOf) {
  const ProgramFolder folder;
  const std::string said =
      "warning: world.xml:1:36: its step() is not const: what it keeps in members is lost where a run is restored or a "
      "plugin swapped; expected state in a table, s.write<State>(\"self/state\") and k.last(state), and void "
      "step(const "
      "Step& k) const; or, where members hold only what can be computed again, static constexpr bool keeps_only_caches "
      "= "
      "true";
  const auto checked = [&](const std::string& toy) {
    folder.write("world.xml", world_of("<test." + toy + " name=\"shelf\"/>"));
    const auto outcome = folder.muster({"check", "world.xml", "--plugins", toys});
    return outcome.out + outcome.err;
  };
  EXPECT_THAT(checked("keeps"), testing::HasSubstr(said));
  EXPECT_THAT(checked("counts"),
              testing::HasSubstr("warning: world.xml:1:36: its step() changes a member, though it is const: what it "
                                 "keeps in members is lost where a run is restored or a plugin swapped; expected state "
                                 "in a table, s.write<State>(\"self/state\") and k.last(state), and no member that is "
                                 "mutable; or, where members hold only what can be computed again"));
  for (const char* toy : {"good", "keeps_caches", "counts_anew", "counts_caches"})
    EXPECT_THAT(checked(toy), testing::Not(testing::HasSubstr("const")));
}

// What no table holds is found where a run is saved: it goes on beside a world that begins from the snapshot.
TEST(Fault16, StateOutsideOfTablesIsFoundWhereARunIsSaved) {
  const ProgramFolder folder;
  const auto saved = [&](const std::string& toy) {
    const auto outcome = run_toy(folder, "<test." + toy + " name=\"shelf\"/>", {"--until", "0.5", "--save", "s.bin"});
    EXPECT_EQ(outcome.exit, 0) << outcome.err;
    return outcome.err;
  };
  EXPECT_THAT(saved("stops"),
              testing::HasSubstr("muster: warning: --save: s.bin does not hold all of the run's state: restored in a "
                                 "world of its own it goes on otherwise at 2.1 s, in instance/shelf/*/cell, row shelf, "
                                 "value[m], which shelf (test.stops/1) writes: 21 instead of -1; such a plugin keeps "
                                 "state in members or static variables"));
  for (const char* toy : {"good", "keeps_caches", "counts_caches"})
    EXPECT_THAT(saved(toy), testing::Not(testing::HasSubstr("--save"))) << toy;
}

TEST(Fault19, ColumnsAreSeparatedByBlanks) {
  const ProgramFolder folder;
  expect_error(
      run_toy(folder, "<test.commas/>"), 2,
      "world.xml:1:36: test.commas (test.commas): claims \"self/goal\": columns \"x[m],y[m], z[m]\" are parted "
      "by other signs than blanks; expected \"x[m] y[m] z[m]\"");
}

TEST(Fault19, NamesOfTablesAndUnitsAreToldAsTheyAreWritten) {
  const ProgramFolder folder;
  expect_error(run_toy(folder, "<test.own_table/>"), 2,
               "world.xml:1:36: test.own_table (test.own_table): claims \"state\"; expected set/row/quantity, or "
               "\"self/state\" for a table of its own");
  expect_error(run_toy(folder, "<test.round_unit/>"), 2,
               "world.xml:1:36: test.round_unit (test.round_unit): claims \"self/goal\": column \"sum(m)\" has no name "
               "of letters, digits and _; expected name, or name[unit]: sum[m]");
}

TEST(Fault19, APhaseOfAnotherKindIsToldWithTheOneThatIsMeant) {
  const ProgramFolder folder;
  expect_error(run_toy(folder, "<radio.copied/>"), 2,
               "world.xml:1:36: radio.copied (radio.copied): claims \"link/*/ends\", which is truth; its source states "
               "phase = MUSTER_CONTROL, in which a plugin has what its robot senses and no more; expected phase = "
               "MUSTER_RADIO");
}

TEST(Fault19, ARowThatIsNotThereIsRefusedBeforeItIsWritten) {
  const ProgramFolder folder;
  expect_error(run_toy(folder, "<test.beyond/>"), 3,
               "world.xml:1:36: test.beyond (test.beyond): step failed at tick 5 (t = 0.5 s): uses row 1 of "
               "instance/test.beyond/*/cell, which has 1 row here; expected row 0, or *k[table]");
}

TEST(Fault16, ThrowsWhenItIsDestroyed) {
  const ProgramFolder folder;
  expect_error(run_toy(folder, "<test.throws_in_destroy name=\"shelf\"/>"), 3,
               "world.xml:1:36: shelf (test.throws_in_destroy): destroy failed: still in use");
  expect_error(
      run_toy(folder, R"(<test.throws_in_destroy name="shelf"/><swap at="0.3" instance="shelf" plugin="test.good"/>)"),
      3, "world.xml:1:36: shelf (test.throws_in_destroy): destroy failed: still in use");
}

// ---- 19: what it writes and reads ----

TEST(Fault19, ValuesThatAreNoneAreTheirWritersFault) {
  const ProgramFolder folder;
  for (const auto& [toy, wrong] :
       {std::pair{"nan", "is NaN; expected a number: 0 / 0 is none, nor a logarithm or root of less than 0"},
        std::pair{"infinite", "is infinite; expected a number: a value over 0 is none"},
        std::pair{"unfilled",
                  "is not filled; expected step() to fill each cell that it writes in every tick, also where "
                  "nothing is to change"}}) {
    SCOPED_TRACE(toy);
    const std::string id = std::string("test.") + toy;
    expect_error(run_toy(folder, "<" + id + " name=\"shelf\"/>"), 3,
                 "world.xml:1:36: shelf (" + id +
                     "): step failed at tick 5 (t = 0.5 s): instance/shelf/shelf/cell: value[m] " + wrong);
  }
}

TEST(Fault19, ClaimsThatDoNotFitAreRefusedAtTheStart) {
  const ProgramFolder folder;
  expect_error(run_toy(folder, R"(<robot name="a" at="0 0 0"/><test.wrong_columns/>)"), 2,
               "world.xml:1:64: test.wrong_columns (test.wrong_columns): claims \"robot/*/pose\" as \"value[m]\"; its "
               "columns are \"x[m] "
               "y[m] z[m] qw qx qy qz\", those of Pose; expected read<Pose>(...) there");
  expect_error(
      run_toy(folder,
              R"(<robot name="a" at="0 0 0"/><test.second_writer name="one"/><test.second_writer name="two"/>)"),
      2,
      "world.xml:1:96: two (test.second_writer): writes \"robot/*/command\"; so does world.xml:1:64: one "
      "(test.second_writer); expected one of the two");
  expect_error(run_toy(folder, R"(<robot name="a" at="0 0 0"/><test.reads_nobodys/>)"), 2,
               "world.xml:1:64: test.reads_nobodys (test.reads_nobodys): reads \"robot/*/poise\", which nobody writes; "
               "did you mean "
               "\"robot/*/pose\"? expected one of door/*/shape, "
               "door/*/state, endpoint/*/pose, endpoint/*/radio, floor/*/shape, heard/*/peer, inbox/*/message, "
               "instance/test.reads_nobodys/*/cell, "
               "link/*/ends, "
               "link/*/rssi, material/*/colour, material/*/loss, mesh/*/shape, radio/*/mount, radio/*/traffic, "
               "range/*/message, robot/*/drive, "
               "robot/*/gait, "
               "robot/*/geometry, robot/*/gps, robot/*/imu, robot/*/legs, "
               "robot/*/odometry, robot/*/pose, "
               "robot/*/position3d, robot/*/rotor_drive, robot/*/rotors, robot/*/stall, robot/*/twist, robot/*/wheels, "
               "... (32 in all)");
}

// The scene of the record asked for the states of doors, which are in no table of such a run.
TEST(Scene, OfARunThatReadsOnlyTheShapesOfDoorsIsRecorded) {
  const ProgramFolder folder;
  const auto outcome = run_toy(folder,
                               R"(<material name="m" loss="6"/><wall name="w" from="0 0" to="4 0" material="m"/>)"
                               R"(<door name="d" wall="w" at="1" state="open"/><test.reads_doors/>)",
                               {"--out", "out"});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
}

}  // namespace
