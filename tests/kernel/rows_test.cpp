// Sets: listed anew each tick, or live, where rows join and leave and keep their numbers.
#include "toy_world.hpp"

namespace muster {
namespace {

using testing::ElementsAre;
using Rows = ToyWorld;

const std::string level = " columns='level[dBm]' ";
const std::string mover =
    "<toy.copy_physics name='mover' to='robot/*/pose' columns='" + pose + "' own='true' add='1'/>\n";

TEST_F(Rows, ListedSetsHaveOtherRowsEachTickAndAllTheirTablesFollow) {
  Simulation sim = run(two_robots +
                       "<toy.list name='l'/>\n"
                       "<toy.copy_radio name='p' as='add' to='link/*/level'" +
                       level +
                       "add='-40'/>\n"
                       "<toy.copy_radio name='q' as='add' to='link/*/level'" +
                       level +
                       "add='-2'/>\n"
                       "<toy.copy_radio name='r' from='link/*/level' from_columns='level[dBm]' to='link/*/rssi' "
                       "columns='rssi[dBm]?'/>\n");
  for (std::size_t tick = 1; tick < 12; ++tick) {
    step(sim);
    const std::size_t rows = tick % 5 + 1;
    EXPECT_EQ(sim.table("endpoint/*/radio").rows(), rows);
    EXPECT_EQ(sim.table("endpoint/*/pose").rows(), rows);
    EXPECT_EQ(column(sim, "link/*/rssi"), std::vector<double>((rows + 1) / 2, -42.0));
  }
}

TEST_F(Rows, OfEverySetAreToldByItsNameHoweverAskedFor) {
  Simulation sim = run(two_robots +
                       "<material name='x' loss='3'/>\n<material name='y' loss='4'/>\n<material name='z' loss='5'/>\n"
                       "<toy.ask name='p'/>\n");
  for (int tick = 0; tick < 3; ++tick) {
    step(sim);
    EXPECT_THAT(column(sim, "robot/*/asked", 0), ElementsAre(2, 2));
    EXPECT_THAT(column(sim, "robot/*/asked", 1), ElementsAre(3, 3));
    EXPECT_THAT(column(sim, "robot/*/asked", 2), ElementsAre(0, 0));
    EXPECT_THAT(column(sim, "robot/*/asked", 3), ElementsAre('a', 'b'));
    EXPECT_THAT(column(sim, "robot/*/asked", 4), ElementsAre('x', 'y'));
  }
}

TEST_F(Rows, ListedTablesHaveAsManyRowsEach) {
  Simulation sim = run(two_robots + "<toy.list name='l' uneven='true'/>\n");
  EXPECT_EQ(error_of([&] { sim.step(); }),
            "3 world.xml:4:1: l (toy.list): step failed at tick 1 (t = 0.5 s): lists 2 rows of endpoint/*/radio, but 1 "
            "of endpoint/*/pose");
  EXPECT_EQ(sim.table("endpoint/*/radio").rows(), 0u);
}

TEST_F(Rows, ReferencesIntoRowsThatAreListedAtTheSameTime) {
  Simulation sim = run(two_robots + "<toy.list name='l' loose='true'/>\n");
  EXPECT_EQ(error_of([&] { sim.step(); }),
            "3 world.xml:4:1: l (toy.list): step failed at tick 1 (t = 0.5 s): link/0/ends: rx is no row of endpoint");
}

TEST_F(Rows, WhoWritesListedRowsComesWithTheLister) {
  const auto with = [&](const std::string& more) {
    return error_of_world(two_robots + "<toy.list name='l' every='2'/>\n" + more);
  };
  const std::string claim = " as='add' to='link/*/level'" + level;
  EXPECT_EQ(with("<toy.copy_radio name='p' every='3'" + claim + "/>\n"),
            "world.xml:5:1: p (toy.copy_radio): writes \"link/*/level\" every 3 ticks, but world.xml:4:1: l (toy.list) "
            "lists its rows every 2");
  EXPECT_EQ(
      with("<toy.copy_physics name='p'" + claim + "/>\n"),
      "world.xml:5:1: p (toy.copy_physics): writes \"link/*/level\" before world.xml:4:1: l (toy.list) lists its rows");
  EXPECT_EQ(
      with("<toy.copy_sense name='p'" + claim + "/>\n<toy.copy_network name='r' from='link/*/level'" + level + "/>\n"),
      "world.xml:6:1: r (toy.copy_network): reads \"link/*/level\" after its rows are listed and before world.xml:5:1: "
      "p "
      "(toy.copy_sense) writes it");
  EXPECT_EQ(error_of_world(two_robots + "<toy.copy_radio name='p'" + claim + "/>\n"),
            "world.xml:4:1: p (toy.copy_radio): writes \"link/*/level\", but nobody lists the rows of \"link\"");
  EXPECT_EQ(error_of_world(two_robots + "<toy.list name='l' adds='true'/>\n"),
            "world.xml:4:1: l (toy.list): adds to or modifies \"link/*/level\", whose rows it lists itself; expected "
            "it to write the table");
}

TEST_F(Rows, ARobotJoinsAndLeaves) {
  Simulation sim = run(two_robots + mover +
                       "<toy.join name='j'/>\n<toy.copy_radio name='w' to='robot/*/own' own='true' add='1'/>\n"
                       "<record table='robot/*/own'/>\n");
  step(sim, 2);
  EXPECT_THAT(column(sim, "robot/*/pose", 0),
              ElementsAre(3, 4, 0));  // initial values: it is seen from the next tick on
  EXPECT_EQ(cell(sim, "robot/late/pose", 1), 7);
  EXPECT_EQ(cell(sim, "robot/late/pose", 3), 1);  // of the unit quaternion
  EXPECT_THAT(column(sim, "robot/*/own"), ElementsAre(2, 2, 0));
  step(sim, 3);
  EXPECT_THAT(column(sim, "robot/*/pose", 0), ElementsAre(6, 7, 3));
  step(sim, 2);  // it left after tick 5 and stands where it was
  EXPECT_THAT(column(sim, "robot/*/pose", 0), ElementsAre(8, 9, 3));
  EXPECT_THAT(column(sim, "robot/*/own"), ElementsAre(7, 7, 3));
  EXPECT_EQ(sim.board().find_set("robot")->find("late"), 2);
  EXPECT_EQ(sim.board().find_set("robot")->alive[2], 0);
  EXPECT_THAT(messages(sim), ElementsAre("2 j: robot \"late\" joins", "5 j: robot \"late\" leaves"));
}

TEST_F(Rows, AJoinerMayBeginLikeAnother) {
  Simulation sim = run(two_robots + mover + "<toy.join name='j' like='1'/>\n");
  step(sim, 2);
  EXPECT_EQ(cell(sim, "robot/late/pose", 0), cell(sim, "robot/b/pose", 0));
  EXPECT_EQ(cell(sim, "robot/late/pose", 1), 7);
}

// For any writer: a row's own, a rest, a part of a sum, a stage.
TEST_F(Rows, RowsThatHaveLeftKeepTheirValuesInEveryTable) {
  const std::string counts = " own='true' add='1'";
  Simulation sim = run(two_robots +
                       "<toy.join name='j' at='1000' leave='3' leaver='0'/>\n"
                       "<toy.copy_physics name='row' to='robot/a/v'" +
                       counts + "/>\n<toy.copy_physics name='rest' to='robot/*/v' flags='2'" + counts +
                       "/>\n"
                       "<toy.copy_radio name='part' as='add' to='robot/*/sum'" +
                       counts +
                       "/>\n"
                       "<toy.copy_sense name='stage' as='modify' from='robot/*/v' to='robot/*/sum'/>\n");
  step(sim, 6);
  EXPECT_THAT(column(sim, "robot/*/v"), ElementsAre(3, 6));
  EXPECT_THAT(column(sim, "robot/*/sum@part"), ElementsAre(3, 6));
  EXPECT_THAT(column(sim, "robot/*/sum"), ElementsAre(6, 12));
}

TEST_F(Rows, WhatJoinIsNot) {
  const auto fault = [&](const std::string& attributes, int ticks = 3) {
    Simulation sim = run(two_robots + mover + "<toy.join name='j' " + attributes + "/>\n");
    std::string error = error_of([&] { step(sim, ticks); });
    EXPECT_EQ(sim.board().find_set("robot")->names.size(), 2u);
    const auto colon = error.find(" s): ");
    return colon == std::string::npos ? error : error.substr(colon + 5);
  };
  EXPECT_EQ(fault("who='b'"), "join(): a robot is called \"b\" already");
  EXPECT_EQ(fault("who='a/b'"), "join(): \"a/b\" is not a name; expected letters, digits, _, - and .");
  EXPECT_EQ(fault("who=''"), "join(): \"\" is not a name; expected letters, digits, _, - and .");
  EXPECT_EQ(fault("twice='true'"), "join(): \"late\" joins twice");
  EXPECT_EQ(fault("like='2'"), "join() like a row that is not there");
  EXPECT_EQ(fault("leave='1' leaver='9'"), "leave() of a row that is not there");
  EXPECT_EQ(fault("quantity='poze'"), "place() of robot/*/poze, which is no table here");
  EXPECT_EQ(fault("column='7'"), "place() into column 7 of robot/*/pose, which has 7");
  EXPECT_EQ(
      error_of_world(two_robots + "<toy.join name='j' table='link/*/other'/>\n"),
      "world.xml:4:1: j (toy.join): claims \"link/*/other\" to let rows join, but the rows of \"link\" do not join");
}

TEST_F(Rows, AreSetJoinAndLeaveFromOutsideBetweenTicks) {
  const auto driven = [&] {
    Simulation sim = run(two_robots + mover);
    step(sim, 2);
    EXPECT_THAT(column(sim, "robot/*/pose"), ElementsAre(3, 4));
    sim.set_row("robot/a/pose", {10, 0, 0, 1, 0, 0, 0});
    EXPECT_THAT(column(sim, "robot/*/pose"), ElementsAre(10, 4));
    step(sim);
    EXPECT_THAT(column(sim, "robot/*/pose"), ElementsAre(11, 5));
    sim.join("robot", "c", "a");
    EXPECT_THAT(column(sim, "robot/*/pose"), ElementsAre(11, 5, 11));
    step(sim);
    sim.leave("robot", "b");
    step(sim);
    EXPECT_THAT(column(sim, "robot/*/pose"), ElementsAre(13, 6, 13));
    EXPECT_THAT(messages(sim), ElementsAre("3 : robot \"c\" joins, a copy of \"a\"", "4 : robot \"b\" leaves"));
    const Snapshot saved = sim.snapshot();
    step(sim);
    const auto digest = sim.digest();
    sim.restore(saved);
    step(sim);
    EXPECT_EQ(sim.digest(), digest);
    return digest;
  };
  EXPECT_EQ(driven(), driven());
}

TEST_F(Rows, ThatCannotBeSetFromOutsideStayAsTheyAre) {
  Simulation sim = run(two_robots + mover);
  step(sim);
  const auto before = sim.digest();
  EXPECT_EQ(error_of([&] {
              sim.set_row("robot/*/pose", {0, 0, 0, 1, 0, 0, 0});
            }),
            "\"robot/*/pose\": expected one row, such as \"robot/rover/pose\"");
  EXPECT_EQ(error_of([&] { sim.set_row("robot/a/pose", {0}); }),
            "\"robot/a/pose\": 1 values; expected 7: x[m] y[m] z[m] qw qx qy qz");
  EXPECT_EQ(error_of([&] {
              sim.set_row("robot/a/pose", {0, 0, NAN, 1, 0, 0, 0});
            }),
            "\"robot/a/pose\": the value of z is not finite");
  EXPECT_EQ(error_of([&] { sim.join("robot", "b", "a"); }), "a robot is called \"b\" already; names are never reused");
  EXPECT_EQ(error_of([&] { sim.join("robot", "a/b", "a"); }),
            "\"a/b\" is not a name; expected letters, digits, _, - and .");
  EXPECT_EQ(error_of([&] { sim.join("robot", "c", "d"); }), "no robot is called \"d\"; expected one of a, b");
  EXPECT_EQ(error_of([&] { sim.leave("wall", "w"); }),
            "rows neither join nor leave \"wall\"; expected a live set, such as \"robot\"");
  EXPECT_EQ(sim.digest(), before);
}

TEST_F(Rows, ASetHasOneThatLetsRowsJoin) {
  EXPECT_EQ(error_of_world(two_robots + mover + "<toy.join name='j'/>\n<toy.join name='k' table='robot/*/other'/>\n"),
            "world.xml:6:1: k (toy.join): lets rows of \"robot\" join and leave; so does world.xml:5:1: j (toy.join)");
}

}  // namespace
}  // namespace muster
