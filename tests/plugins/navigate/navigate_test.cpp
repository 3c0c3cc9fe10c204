// Ways that are planned, followed and planned anew.
#include "navigate_world.hpp"
#include "roadmap/plan.hpp"
#include "tests/roadmap/random_plans.hpp"

namespace muster::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

TEST(Navigate, Row49GetsThereByTheShortestWayAndKeepsItsRadiusFromEveryWall) {
  for (const std::string method : {"visibility", "grid"}) {
    const Folder folder;
    Simulation run = navigating(folder, "7,3.5\n", "", "",
                                "<robots.roadmap name='plan' robot='rover' step='0.25' method='" + method + "'/>");
    // The walls with their gaps, from the figures of the world's text.
    const std::vector<rm::Block> walls{{{0, 0}, {8, 0}, 0.1},  {{0, 4}, {8, 4}, 0.1},   {{0, 0}, {0, 4}, 0.1},
                                       {{8, 0}, {8, 4}, 0.1},  {{4, 0}, {4, 0.5}, 0.1}, {{4, 1.4}, {4, 2.8}, 0.1},
                                       {{4, 3.7}, {4, 4}, 0.1}};
    double least = 1e9, gone = 0, along = 0;
    Pose before = row<Pose>(run, "robot/rover/pose");
    ASSERT_TRUE(run_to_goal(run, 1, [&](const Pose& at) {
      for (const rm::Block& wall : walls) least = std::min(least, apart({at.x, at.y}, {at.x, at.y}, wall));
      gone += std::hypot(at.x - before.x, at.y - before.y);
      before = at;
      if (state_of(run).status == 1) {
        EXPECT_GE(state_of(run).along, along - 1e-9) << "it goes on by arclength";
        along = state_of(run).along;
      }
    })) << method;
    EXPECT_GE(least, rover_radius) << method;
    EXPECT_LT(std::hypot(before.x - 7, before.y - 3.5), 0.06);
    // By the far door: to its southern post and on, 0.2024 m aside in both directions.
    const double keep = 0.20240, south = 2.8 + keep, west = 3.95 - keep, east = 4.05 + keep;
    const double shortest = std::hypot(west - 1, south - 1) + (east - west) + std::hypot(7 - east, 3.5 - south);
    EXPECT_NEAR(gone, shortest, method == "grid" ? 0.6 : 0.15);
    EXPECT_THAT(said(run), ElementsAre(StartsWith("plans "), "is at 7.00 3.50"));
  }
}

TEST(Navigate, Row49AClosedDoorLeadsToAnotherWay) {
  const std::string door = "<sensors.laser/><at t='3'><set path='door/near/state' value='closed'/></at>";
  const auto crosses_closed = [](Simulation& run) {
    bool result = false;
    Pose before = row<Pose>(run, "robot/rover/pose");
    run_to_goal(run, 1, [&](const Pose& at) {
      result = result || (before.x < 4 && at.x >= 4 && at.y < 1.4);
      before = at;
    });
    return result;
  };
  const Folder folder, other;
  Simulation seeing = navigating(folder, "7,1\n", "laser='true'", door);
  EXPECT_FALSE(crosses_closed(seeing));
  EXPECT_EQ(state_of(seeing).reached, 1);
  EXPECT_GT(state_of(seeing).plans, 1);
  EXPECT_THAT(said(seeing), testing::Contains(StartsWith("an obstacle is in the way: plans ")));
  Simulation blind = navigating(other, "7,1\n", "", door);
  EXPECT_TRUE(crosses_closed(blind)) << "the physics of this test lets it through: what stops it is what it sees";
  EXPECT_EQ(state_of(blind).plans, 1);
}

TEST(Navigate, WhereNoWayIsLeftItWaitsUntilTheDoorIsForgotten) {
  const Folder folder;
  Simulation run = navigating(folder, "7,1\n", "laser='true' forget='10'",
                              "<sensors.laser/><at t='3'><set path='door/near/state' value='closed'/></at>"
                              "<at t='40'><set path='door/near/state' value='open'/></at>",
                              plan,
                              "<material name='board' loss='5'/>"
                              "<wall name='between' from='4 0' to='4 4' material='board'/>"
                              "<wall name='south' from='0 0' to='8 0' material='board'/>"
                              "<wall name='north' from='0 4' to='8 4' material='board'/>"
                              "<wall name='west' from='0 0' to='0 4' material='board'/>"
                              "<wall name='east' from='8 0' to='8 4' material='board'/>"
                              "<door name='near' wall='between' at='0.5' width='0.9' state='open'/>");
  while (run.time() < 39.9) run.step();
  EXPECT_EQ(state_of(run).status, 3);
  EXPECT_LT(row<Pose>(run, "robot/rover/pose").x, 4);
  EXPECT_EQ(row<Command>(run, "robot/rover/command").v, 0);
  EXPECT_TRUE(run_to_goal(run));
  EXPECT_THAT(said(run), testing::Contains(HasSubstr("no way to 7.00 1.00: no way leads from ")));
}

TEST(Navigate, AGoalWithoutAWayIsOneClearMessage) {
  const auto events = [](const std::string& goal) {
    const Folder folder;
    Simulation run = navigating(folder, goal);
    while (run.time() < 20) run.step();
    EXPECT_EQ(state_of(run).status, 3);
    EXPECT_EQ(row<Pose>(run, "robot/rover/pose").x, 1) << "it stays";
    EXPECT_GT(state_of(run).plans, 10) << "it tries again each second";
    std::vector<std::string> told = said(run);
    for (std::string& each : told) each = folder.inside(each);
    return told;
  };
  EXPECT_THAT(events("7,3.9\n"),
              ElementsAre("warning: goals.csv:2:1: no way to 7.00 3.90: the goal 7 3.9 is 0.05 m from "
                          "a wall; expected at least the radius, 0.2024 m, on all sides"));
  EXPECT_THAT(events("9,9\n"),
              ElementsAre("warning: goals.csv:2:1: no way to 9.00 9.00: no way leads from 1 1 to 9 9, which "
                          "lies outside of the plan (x 0 to 8, y 0 to 4 m)"));
}

TEST(Navigate, GoesToRowsInTurnAndAnew) {
  const Folder folder, other;
  Simulation once = navigating(folder, "7,3.5\n7,1\n1,1\n", "speed='0.6'");
  while (!once.done()) once.step();
  EXPECT_EQ(state_of(once).reached, 3);
  EXPECT_EQ(state_of(once).status, 0);
  Simulation again = navigating(other, "7,1\n1,1\n", "loop='true' speed='0.6'");
  while (!again.done()) again.step();
  EXPECT_GE(state_of(again).reached, 4);
}

TEST(Navigate, ALoopOfOneRowIsReachedOnce) {
  const Folder folder;
  Simulation run = navigating(folder, "2,1\n", "loop='true' speed='0.6'");
  while (run.time() < 20) run.step();
  EXPECT_EQ(state_of(run).reached, 1);
  EXPECT_EQ(state_of(run).status, 2);
  EXPECT_THAT(said(run), ElementsAre(StartsWith("plans "), "is at 2.00 1.00"));
}

TEST(Navigate, DrivesWhereAMissionSendsIt) {
  const Folder folder;
  Simulation run = world_of(folder,
                            two_rooms + rover + plan +
                                "<radio.multiwall l0='40' n='2'/><network.ideal/>"
                                "<control.mission name='mission' robot='rover' mission='mission.xml'/>"
                                "<control.navigate name='steer' robot='rover'/>",
                            {{"mission.xml",
                              "<mission><go_to at='7 3.5'/><wait seconds='1'/>"
                              "<go_to at='1 3' heading='1.57' within='0.08'/></mission>"}},
                            minutes);
  while (!run.done()) run.step();
  const Pose at = row<Pose>(run, "robot/rover/pose");
  EXPECT_LT(std::hypot(at.x - 1, at.y - 3), 0.1);
  EXPECT_NEAR(2 * std::atan2(at.qz, at.qw), 1.57, 0.05);
  bool is_done = false;
  for (const auto& event : run.events()) is_done = is_done || event.message == "the mission is done";
  EXPECT_TRUE(is_done);
}

TEST(Navigate, AGoalThatMovesOnALittleAtATimeIsFollowedWithoutAnEventEachTime) {
  const Folder folder;
  Simulation run = world_of(folder,
                            two_rooms + rover + plan +
                                "<robot name='leader' at='2.5 1 0'/>"
                                "<radio.multiwall l0='40' n='2'/><network.ideal/>"
                                "<control.mission name='leads' robot='leader' mission='leader.xml' report='0.2'/>"
                                "<control.goal2d robot='leader' speed='0.2'/>"
                                "<control.mission name='mission' robot='rover' mission='mission.xml'/>"
                                "<control.navigate name='steer' robot='rover'/>",
                            {{"leader.xml", "<mission><go_to at='7 1'/><go_to at='7 3'/></mission>"},
                             {"mission.xml", "<mission><follow radio='leader' distance='1' until='stop'/></mission>"}},
                            minutes);
  while (!run.done()) run.step();
  const Pose at = row<Pose>(run, "robot/rover/pose");
  EXPECT_LT(std::hypot(at.x - 7, at.y - 3), 1.2);
  EXPECT_GT(state_of(run).plans, 50);
  EXPECT_LT(said(run).size(), 5u);
}

TEST(Navigate, ARobotBesideItsWayPlansAnew) {
  const Folder folder;
  Simulation run = navigating(folder, "7,1\n");
  while (run.time() < 5) run.step();
  Pose at = row<Pose>(run, "robot/rover/pose");
  EXPECT_EQ(state_of(run).plans, 1);
  run.set_row("robot/rover/odometry", {1, 3, 0, 0, 0});
  run.step();
  run.step();
  EXPECT_THAT(said(run), testing::Contains(StartsWith("it is off its way: plans ")));
  EXPECT_GT(at.x, 1.5);
}

TEST(Navigate, TheRoadmapIsExchangedInMidRun) {
  const Folder folder;
  Simulation run = navigating(folder, "7,3.5\n1,1\n", "speed='0.6'");
  ASSERT_TRUE(run_to_goal(run, 1));
  const double nodes = run.table("robot/rover/roadmap").at(0, 0);
  InstanceDeclaration grid = run.world().instances[3];
  ASSERT_EQ(grid.name, "plan");
  grid.attributes.push_back({"method", "grid", {}, {}});
  run.swap("plan", grid);
  run.step();
  EXPECT_GT(run.table("robot/rover/roadmap").at(0, 0), nodes + 20);
  EXPECT_TRUE(run_to_goal(run, 2));
}

}  // namespace
}  // namespace muster::test
