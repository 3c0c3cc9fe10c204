// The four claims: access to read, write, add and modify, and the resulting order of the steps.
#include <cmath>

#include "toy_world.hpp"

namespace muster {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::StartsWith;
using Claims = ToyWorld;

// Names of the instances of each batch, joined.
std::vector<std::string> order(const Simulation& run) {
  std::vector<std::string> result;
  for (const auto& batch : run.batches()) {
    std::string names = phase_name(batch.phase);
    for (const Instance* i : batch.instances) names += ' ' + i->name();
    if (!batch.instances.empty()) result.push_back(names);
  }
  return result;
}

TEST_F(Claims, ReadersFollowWritersInsideAPhaseAndOthersStepTogether) {
  Simulation sim = run(two_robots +
                       "<toy.copy_radio name='last' from='robot/*/q' to='robot/*/r'/>\n"
                       "<toy.copy_radio name='mid' from='robot/*/p' to='robot/*/q' add='10'/>\n"
                       "<toy.copy_radio name='aside' to='robot/*/s' add='5'/>\n"
                       "<toy.copy_radio name='first' to='robot/*/p' add='1'/>\n"
                       "<toy.copy_control name='before' to='self/x'/>\n");
  EXPECT_THAT(order(sim), ElementsAre("CONTROL before", "RADIO aside first", "RADIO mid", "RADIO last"));
  step(sim);
  EXPECT_EQ(cell(sim, "robot/a/r"), 11);
}

TEST_F(Claims, ATableOfALaterPhaseIsReadAsItWasATickBefore) {
  Simulation sim = run(two_robots +
                       "<toy.copy_physics name='early' from='robot/*/count' to='robot/*/seen'/>\n"
                       "<toy.copy_sense name='late' to='robot/*/count' own='true' add='1'/>\n");
  EXPECT_EQ(cell(sim, "robot/a/count"), 1);  // the SENSE pass before the first tick
  EXPECT_EQ(cell(sim, "robot/a/seen"), 0);
  step(sim);
  EXPECT_EQ(cell(sim, "robot/a/count"), 2);
  EXPECT_EQ(cell(sim, "robot/a/seen"), 1);
  step(sim, 5);
  EXPECT_EQ(cell(sim, "robot/b/count"), 7);
  EXPECT_EQ(cell(sim, "robot/b/seen"), 6);
}

TEST_F(Claims, ASumIsTakenInTheOrderOfTheWorldFile) {
  const std::string adders =
      "<toy.copy_radio name='z' to='robot/*/sum' as='add' add='0.1'/>\n"
      "<toy.copy_radio name='m' to='robot/*/sum@fine' as='add' add='0.2'/>\n"
      "<toy.copy_physics name='far' to='robot/*/elsewhere'/>\n"
      "<toy.copy_radio name='a' to='robot/*/sum' as='add' add='-0.3'/>\n"
      "<toy.copy_radio name='reader' from='robot/*/sum' and='robot/*/sum@m.fine' to='robot/*/r'/>\n";
  Simulation sim = run(two_robots + adders);
  step(sim);
  const double forward = (0.1 + 0.2) + -0.3;
  ASSERT_NE(forward, 0.1 + (0.2 + -0.3));  // else the order would not show
  EXPECT_TRUE(same_bits(cell(sim, "robot/*/sum", 0, 1), forward));
  EXPECT_EQ(cell(sim, "robot/a/sum@z"), 0.1);
  EXPECT_EQ(cell(sim, "robot/a/sum@m.fine"), 0.2);
  EXPECT_EQ(cell(sim, "robot/a/sum@a"), -0.3);
  EXPECT_TRUE(same_bits(cell(sim, "robot/a/r"), forward + 0.2));
}

TEST_F(Claims, APartThatIsNotDueKeepsItsValueInTheSum) {
  Simulation sim = run(two_robots +
                       "<toy.copy_radio name='slow' every='4' to='robot/*/sum' as='add' own='true' add='100'/>\n"
                       "<toy.copy_radio name='fast' to='robot/*/sum' as='add' own='true' add='1'/>\n");
  std::vector<double> sums;
  for (int i = 0; i < 9; ++i) step(sim), sums.push_back(cell(sim, "robot/b/sum"));
  EXPECT_THAT(sums, ElementsAre(1, 2, 3, 104, 105, 106, 107, 208, 209));
}

TEST_F(Claims, StagesRunInTheOrderOfTheWorldFileAndStayReadable) {
  Simulation sim =
      run(two_robots +
          "<toy.copy_sense name='twice' as='modify' to='robot/*/value' times='2'/>\n"
          "<toy.copy_radio name='made' to='robot/*/value' add='5'/>\n"
          "<toy.copy_sense name='more' as='modify' to='robot/*/value' add='1'/>\n"
          "<toy.copy_observe name='reader' from='robot/*/value' and='robot/*/value@twice' to='robot/*/both'/>\n"
          "<toy.copy_observe name='raw' from='robot/*/value@base' to='robot/*/unmodified'/>\n");
  step(sim);
  EXPECT_EQ(cell(sim, "robot/a/value@base"), 5);
  EXPECT_EQ(cell(sim, "robot/a/value@twice"), 10);
  EXPECT_EQ(cell(sim, "robot/a/value@more"), 11);
  EXPECT_EQ(cell(sim, "robot/a/value"), 11);
  EXPECT_EQ(cell(sim, "robot/a/both"), 21);
  EXPECT_EQ(cell(sim, "robot/a/unmodified"), 5);
}

TEST_F(Claims, AStageMayTouchOneRowAndTheOthersPass) {
  Simulation sim =
      run(two_robots +
          "<toy.copy_control name='ask' to='robot/*/command' columns='v[m/s] w[rad/s]' add='3'/>\n"
          "<toy.copy_actuate name='clip' as='modify' to='robot/b/command' columns='v[m/s] w[rad/s]' times='0.5'/>\n");
  step(sim);
  EXPECT_THAT(column(sim, "robot/*/command"), ElementsAre(3, 1.5));
  EXPECT_THAT(column(sim, "robot/*/command@base"), ElementsAre(3, 3));
}

TEST_F(Claims, ARowHasOneWriter) {
  const std::string one = two_robots + "<toy.copy_physics name='one' to='robot/a/v'/>\n";
  EXPECT_EQ(error_of_world(one + "<toy.copy_physics name='two' to='robot/b/v'/>\n"), "no error");
  EXPECT_EQ(
      error_of_world(one + "<toy.copy_physics name='two' to='robot/a/v'/>\n"),
      "world.xml:5:1: two (toy.copy_physics): writes \"robot/a/v\"; so does world.xml:4:1: one (toy.copy_physics); "
      "expected one of the two");
  EXPECT_EQ(
      error_of_world(one + "<toy.copy_physics name='two' to='robot/*/v'/>\n"),
      "world.xml:5:1: two (toy.copy_physics): writes \"robot/*/v\"; so does world.xml:4:1: one (toy.copy_physics); "
      "expected one of the two");
  EXPECT_EQ(error_of_world(one + "<toy.copy_radio name='two' to='robot/b/v'/>\n"),
            "world.xml:5:1: two (toy.copy_radio): writes \"robot/*/v\" in the phase RADIO, but world.xml:4:1: one "
            "(toy.copy_physics) in PHYSICS; a table is written in one phase");
  EXPECT_EQ(
      error_of_world(one + "<toy.copy_physics name='two' to='robot/*/v' as='add'/>\n"),
      "world.xml:4:1: one (toy.copy_physics): writes \"robot/*/v\", to which world.xml:5:1: two (toy.copy_physics) "
      "adds; expected one of the two, or add<...>(...) in place of write<...>(...) in the source of toy.copy_physics");
}

TEST_F(Claims, PartsOfASumAreAddedInOnePhase) {
  EXPECT_EQ(error_of_world(two_robots + "<toy.copy_radio name='one' to='robot/*/v' as='add'/>\n<toy.copy_sense "
                                        "name='two' to='robot/*/v' as='add'/>\n"),
            "world.xml:5:1: two (toy.copy_sense): adds to \"robot/*/v\" in the phase SENSE, but world.xml:4:1: one "
            "(toy.copy_radio) in RADIO; a table is written in one phase");
}

TEST_F(Claims, WhatTheWorldGivesIsNoPartOfASum) {
  EXPECT_EQ(error_of_world("<material name='m' loss='3'/>\n<toy.copy_radio name='one' to='material/*/loss' "
                           "columns='loss[dB]' as='add'/>\n"),
            "world.xml:3:1: one (toy.copy_radio): adds to \"material/*/loss\", which the world gives; expected a claim "
            "to modify it");
}

TEST_F(Claims, OnlyPlainNumbersAreAdded) {
  for (const std::string columns : {"v?", "v~", "v{}", "v:robot"})
    EXPECT_EQ(
        error_of_world(two_robots + "<toy.copy_radio name='one' to='robot/*/v' as='add' columns='" + columns + "'/>\n"),
        "world.xml:4:1: one (toy.copy_radio): adds to \"robot/*/v\"; expected a whole table of numbers")
        << columns;
  EXPECT_EQ(error_of_world(two_robots + "<toy.copy_radio name='one' to='robot/a/v' as='add'/>\n"),
            "world.xml:4:1: one (toy.copy_radio): adds to \"robot/a/v\"; expected a whole table of numbers");
}

TEST_F(Claims, TwoTablesNeverBearOneName) {
  EXPECT_EQ(error_of_world(two_robots + "<toy.copy_radio name='x' to='robot/*/v@y' as='add'/>\n<toy.copy_radio "
                                        "name='x.y' to='robot/*/v' as='add'/>\n"),
            "world.xml:5:1: x.y (toy.copy_radio): claims \"robot/*/v@x.y\"; so does world.xml:4:1: x (toy.copy_radio)");
  EXPECT_EQ(
      error_of_world(
          two_robots +
          "<toy.copy_radio name='w' to='robot/*/v'/>\n<toy.copy_radio name='base' to='robot/*/v' as='modify'/>\n"
          "<toy.copy_radio name='m' to='robot/*/v' as='modify'/>\n"),
      "world.xml:5:1: base (toy.copy_radio): claims \"robot/*/v@base\"; so does world.xml:4:1: w (toy.copy_radio)");
}

TEST_F(Claims, AReadThatNobodyWritesNamesTheNearest) {
  EXPECT_EQ(
      error_of_world(two_robots + "<toy.copy_physics name='w' to='robot/*/charge'/>\n<toy.copy_radio name='r' "
                                  "from='robot/*/chargr' to='self/x'/>\n"),
      "world.xml:5:1: r (toy.copy_radio): reads \"robot/*/chargr\", which nobody writes; did you mean "
      "\"robot/*/charge\"? expected one of door/*/shape, door/*/state, "
      "endpoint/*/pose, endpoint/*/radio, floor/*/shape, heard/*/peer, inbox/*/message, instance/r/*/x, "
      "link/*/ends, link/*/rssi, "
      "material/*/colour, material/*/loss, mesh/*/shape, radio/*/mount, "
      "radio/*/traffic, range/*/message, robot/*/charge, robot/*/drive, robot/*/gait, robot/*/geometry, robot/*/gps, "
      "robot/*/imu, robot/*/legs, robot/*/odometry, "
      "robot/*/pose, "
      "robot/*/position3d, robot/*/rotor_drive, robot/*/rotors, robot/*/stall, robot/*/twist, "
      "... (33 in all)");
  EXPECT_THAT(
      error_of_world(two_robots + "<toy.copy_physics name='w' to='robot/*/v' as='add'/>\n<toy.copy_radio name='r' "
                                  "from='robot/*/v@u' to='self/x'/>\n"),
      AllOf(StartsWith("world.xml:5:1: r (toy.copy_radio): reads \"robot/*/v@u\", which nobody writes; did you mean "
                       "\"robot/*/v@w\"? expected one of "),
            EndsWith(" in all)")));
  Simulation sim =
      run(two_robots + "<toy.copy_radio name='r' from='robot/*/nothing' read_flags='1' to='robot/*/x' add='4'/>\n");
  step(sim);
  EXPECT_EQ(cell(sim, "robot/a/x"), 4);  // an optional read has no rows
}

// A mesh in a world whose channel ignores meshes. Rows that a table in use refers to count as read.
TEST_F(Claims, RowsThatNobodyReadsAreWarnedAbout) {
  const std::string rows = two_robots +
                           "<material name='m' loss='3'/>\n<wall from='0 0' to='1 0' material='m'/>\n"
                           "<wall from='0 1' to='1 1' material='m'/>\n";
  const std::string file = (folder / "world.xml").string();
  const std::string nothing = " rows, which do nothing";
  EXPECT_THAT(messages(run(rows)),
              ElementsAre("0 : warning: " + file + ":4:1: nobody reads the world's material" + nothing,
                          "0 : warning: " + file + ":5:1: nobody reads the world's wall" + nothing));
  const auto copy = [](const std::string& from, const std::string& columns) {
    return "<toy.copy_radio from='" + from + "/*/" + (from == "wall" ? "shape" : "loss") + "' columns='" + columns +
           "' to='" + from + "/*/seen'/>\n";
  };
  EXPECT_THAT(messages(run(rows + copy("material", Loss::columns))),
              ElementsAre("0 : warning: " + file + ":5:1: nobody reads the world's wall" + nothing));
  EXPECT_THAT(messages(run(rows + copy("wall", Wall::columns))), ElementsAre());
}

// A jammer in a world whose network ignores jammers.
TEST_F(Claims, WhatAPluginOfTheRadioSaysToNobodyIsWarnedAbout) {
  const std::string said = two_robots + "<toy.copy_radio name='r' to='robot/*/loudness' columns='v'/>\n";
  EXPECT_THAT(messages(run(said)),
              ElementsAre("0 : warning: " + (folder / "world.xml").string() +
                          ":4:1: r (toy.copy_radio): writes \"robot/*/loudness\", which nobody reads; muster "
                          "describe toy.copy_radio says what it is for"));
  EXPECT_THAT(messages(run(said + "<toy.copy_sense name='s' from='robot/*/loudness' columns='v' to='self/x'/>\n")),
              ElementsAre());
}

// A robot that a controller commands in a world without a drive would not move.
TEST_F(Claims, CommandsThatNobodyReadsAreWarnedAbout) {
  const std::string commands = two_robots +
                               "<toy.copy_control name='c' robot='a' to='robot/{robot}/command' columns='" +
                               std::string(Command::columns) + "'/>\n";
  const std::string warning = (folder / "world.xml").string() +
                              ":4:1: c (toy.copy_control): writes \"robot/a/command\", which nobody reads; expected "
                              "<physics.simbody/> in the world";
  Simulation deaf = run(commands);
  EXPECT_THAT(messages(deaf), ElementsAre("0 : warning: " + warning));
  EXPECT_THAT(messages(run(commands + "<record table='robot/*/command'/>\n")), ElementsAre());
  const std::string reader = "<toy.copy_physics name='p' from='robot/*/command' columns='" +
                             std::string(Command::columns) + "' to='robot/*/moved'/>\n";
  Simulation sim = run(commands + reader);
  EXPECT_THAT(messages(sim), ElementsAre());
  step(sim, 2);
  sim.swap("p", instance("toy.copy_physics", "", {{"to", "robot/*/moved"}, {"columns", Command::columns}}));
  EXPECT_THAT(messages(sim), testing::Contains("2 : warning: " + warning));
}

TEST_F(Claims, ClaimsThatMakeNoSense) {
  const auto claim = [&](const std::string& attributes) {
    return error_of_world(two_robots + "<toy.copy_radio name='r' " + attributes + "/>\n");
  };
  EXPECT_EQ(
      claim("to='robots/*/x'"),
      "world.xml:4:1: r (toy.copy_radio): claims a table of the set \"robots\"; expected one of door, endpoint, floor, "
      "inbox, link, "
      "material, mesh, outbox, radio, robot, scan, wall; did you mean \"robot\"?");
  EXPECT_EQ(claim("to='robot/c/x'"),
            "world.xml:4:1: r (toy.copy_radio): claims a row of robot called \"c\"; expected one of a, b");
  EXPECT_EQ(claim("to='robot'"), "world.xml:4:1: r (toy.copy_radio): claims \"robot\"; expected set/row/quantity");
  EXPECT_EQ(claim("to='robot/x'"), "world.xml:4:1: r (toy.copy_radio): claims \"robot/x\"; expected set/row/quantity");
  EXPECT_EQ(claim("to='robot/*/'"),
            "world.xml:4:1: r (toy.copy_radio): claims \"robot/*/\"; expected set/row/quantity");
  EXPECT_EQ(claim("to='robot/{robot}/x'"),
            "world.xml:4:1: r (toy.copy_radio): has no attribute \"robot\", which it needs");
  EXPECT_EQ(claim("to='robot/{times}/x'"),
            "world.xml:4:1: r (toy.copy_radio): claims {times}, which is no reference among its parameters; "
            "expected {robot}");
  EXPECT_EQ(claim("to='link/3/level' columns='level[dBm]'"),
            "world.xml:4:1: r (toy.copy_radio): claims one row of \"link\", whose rows are listed anew each tick; "
            "expected *");
  EXPECT_EQ(claim("to='robot/*/x' columns='x[m'"),
            "world.xml:4:1: r (toy.copy_radio): claims \"robot/*/x\": column \"x[m\" has no closing ]");
  EXPECT_EQ(claim("to='robot/*/x' columns='x x'"),
            "world.xml:4:1: r (toy.copy_radio): claims \"robot/*/x\": column \"x\" stands twice");
  EXPECT_EQ(claim("to='robot/*/x' columns='x0 x*2'"),
            "world.xml:4:1: r (toy.copy_radio): claims \"robot/*/x\": column \"x*2\" stands twice");
  EXPECT_EQ(claim("to='robot/*/x' columns=''"),
            "world.xml:4:1: r (toy.copy_radio): claims \"robot/*/x\" without columns");
  EXPECT_EQ(claim("to='robot/*/x' columns='x:robots'"),
            "world.xml:4:1: r (toy.copy_radio): claims \"robot/*/x\": column \"x\" refers to the set \"robots\"; "
            "expected one of door, "
            "endpoint, floor, inbox, link, material, mesh, outbox, radio, robot, scan, wall; did you mean \"robot\"?");
  EXPECT_EQ(claim("to='robot/*/twist' columns='v'"),
            "world.xml:4:1: r (toy.copy_radio): claims \"robot/*/twist\" as \"v\"; its columns are \"" + twist +
                "\", those of Twist; expected write<Twist>(...) there");
  EXPECT_EQ(
      claim("from='robot/*/odometry' columns='" + pose + "' to='self/x'"),
      "world.xml:4:1: r (toy.copy_radio): claims \"robot/*/odometry\" as \"" + pose +
          "\", those of Pose; its columns are \"x[m] y[m] yaw[rad] v[m/s] w[rad/s]\", those of Odometry; expected "
          "read<Odometry>(...) there");
  EXPECT_EQ(claim("to='outbox/a/message' as='modify' columns='radio:radio to:radio? payload{}'"),
            "world.xml:4:1: r (toy.copy_radio): modifies \"outbox/a/message\"; expected a whole queue");
}

TEST_F(Claims, ReaderAndWriterAgreeOnColumns) {
  EXPECT_EQ(error_of_world(two_robots + "<toy.copy_physics name='w' to='robot/*/d' columns='d[m]'/>\n<toy.copy_radio "
                                        "name='r' from='robot/*/d' columns='d[km]' to='self/x'/>\n"),
            "world.xml:5:1: r (toy.copy_radio): claims \"robot/*/d\" as \"d[km]\", but world.xml:4:1: w "
            "(toy.copy_physics) as \"d[m]\"");
}

TEST_F(Claims, ACycleInsideAPhaseIsWalked) {
  EXPECT_EQ(error_of_world(two_robots + "<toy.copy_radio name='x' from='robot/*/q' to='robot/*/p'/>\n"
                                        "<toy.copy_radio name='y' from='robot/*/r' to='robot/*/q'/>\n"
                                        "<toy.copy_radio name='z' from='robot/*/p' to='robot/*/r'/>\n"
                                        "<toy.copy_radio name='w' from='robot/*/r' to='robot/*/s'/>\n"),
            "world.xml:4:1: x (toy.copy_radio): a cycle inside the phase RADIO: x needs \"robot/*/q\" of y; y needs "
            "\"robot/*/r\" of z; "
            "z needs \"robot/*/p\" of x; let one of them work in another phase, so that it is read a tick later");
  EXPECT_EQ(error_of_world(two_robots + "<toy.copy_radio name='w' from='robot/*/p' to='robot/*/s'/>\n"
                                        "<toy.copy_radio name='x' from='robot/*/q' to='robot/*/p'/>\n"
                                        "<toy.copy_radio name='y' from='robot/*/p' to='robot/*/q'/>\n"),
            "world.xml:5:1: x (toy.copy_radio): a cycle inside the phase RADIO: x needs \"robot/*/q\" of y; y needs "
            "\"robot/*/p\" of x; "
            "let one of them work in another phase, so that it is read a tick later");
}

TEST_F(Claims, ReadingTheBaseOfAChainWaitsForNoStage) {
  Simulation sim = run(two_robots +
                       "<toy.copy_radio name='w' to='robot/*/v' add='2'/>\n"
                       "<toy.copy_radio name='gain' from='robot/*/v@base' to='robot/*/g' times='3'/>\n"
                       "<toy.copy_radio name='m' as='modify' from='robot/*/g' to='robot/*/v'/>\n");
  step(sim);
  EXPECT_EQ(cell(sim, "robot/a/v"), 8);
}

TEST_F(Claims, StagesComeNoEarlierThanWhatTheyModify) {
  const std::string made = two_robots + "<toy.copy_radio name='w' every='4' to='robot/*/v'/>\n";
  EXPECT_EQ(error_of_world(made + "<toy.copy_physics name='m' as='modify' to='robot/*/v'/>\n"),
            "world.xml:5:1: m (toy.copy_physics): modifies \"robot/*/v\" before it is written: world.xml:4:1: w "
            "(toy.copy_radio) comes "
            "in the phase RADIO");
  EXPECT_EQ(
      error_of_world(made + "<toy.copy_sense name='m' every='3' as='modify' to='robot/*/v'/>\n"),
      "world.xml:5:1: m (toy.copy_sense): modifies \"robot/*/v\" every 3 ticks and would miss values: world.xml:4:1: w "
      "(toy.copy_radio) writes every 4");
  EXPECT_EQ(error_of_world(made + "<toy.copy_sense name='m' every='2' as='modify' to='robot/*/v'/>\n"), "no error");
  EXPECT_EQ(error_of_world(two_robots + "<toy.copy_sense name='m' as='modify' to='robot/*/v'/>\n"),
            "world.xml:4:1: m (toy.copy_sense): modifies \"robot/*/v\", which nobody writes");
}

TEST_F(Claims, AWholeTableWriterAtEvery4BesideARowWriter) {
  Simulation sim = run(two_robots +
                       "<robot name='c' at='3 0 0'/>\n"
                       "<toy.copy_physics name='rest' every='4' to='robot/*/v' flags='2' own='true' add='100'/>\n"
                       "<toy.copy_physics name='row' to='robot/b/v' own='true' add='1'/>\n");
  std::vector<std::vector<double>> seen;
  for (int i = 0; i < 8; ++i) step(sim), seen.push_back(column(sim, "robot/*/v"));
  EXPECT_THAT(seen[2], ElementsAre(0, 3, 0));
  EXPECT_THAT(seen[3], ElementsAre(100, 4, 100));
  EXPECT_THAT(seen[6], ElementsAre(100, 7, 100));
  EXPECT_THAT(seen[7], ElementsAre(200, 8, 200));
}

TEST_F(Claims, PeriodsCountInTicksAndSetTheirOwnDt) {
  Simulation sim = run(two_robots + "<toy.plain name='fast'/>\n");
  Simulation slow = run(two_robots + "<toy.plain name='slow' every='2'/>\n");
  step(sim, 4), step(slow, 4);
  EXPECT_DOUBLE_EQ(cell(sim, "robot/a/battery"), std::pow(0.95, 4));
  EXPECT_DOUBLE_EQ(cell(slow, "robot/a/battery"), 0.9 * 0.9);
  EXPECT_EQ(slow.table("robot/*/battery").table->now().tick, 4u);
}

}  // namespace
}  // namespace muster
