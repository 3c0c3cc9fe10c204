// Missions: what a robot does of each step, and what a file that cannot be is refused with.
#include "mission_world.hpp"

namespace {

using namespace muster;
using namespace muster::test;
using testing::ElementsAre;
using testing::HasSubstr;

TEST_F(Missions, PlacesInTheirOrder) {
  Simulation sim = run("<go_to at='2 0'/>\n<go_to at='2 1' heading='3.14159' within='0.05'/>\n<wait seconds='3'/>");
  ASSERT_TRUE(run_to_line(sim, 3));
  EXPECT_LT(away(sim, 2, 0), 0.1 + 0.03);
  ASSERT_TRUE(run_to_line(sim, 4));
  EXPECT_LT(away(sim, 2, 1), 0.05 + 0.03);
  EXPECT_GT(std::abs(place_of(sim).qz), 0.999);
  const double waits = sim.time();
  ASSERT_TRUE(run_to_line(sim, 1));  // its end, at the root
  EXPECT_NEAR(sim.time() - waits, 3, 0.051);
  run_to(sim, sim.time() + 5);
  EXPECT_LT(away(sim, 2, 1), 0.05);
}

TEST_F(Missions, APatrolGoesRoundAsOftenAsItIsTold) {
  Simulation sim = run("<patrol times='2'>\n<place at='1 0'/>\n<place at='1 1'/>\n</patrol>\n<go_to at='0 0'/>");
  std::vector<double> lines{line(sim)};
  while (sim.time() < 60) {
    sim.step();
    if (line(sim) != lines.back()) lines.push_back(line(sim));
  }
  EXPECT_THAT(lines, ElementsAre(0, 3, 4, 3, 4, 6, 1));
}

TEST_F(Missions, RepeatsStandInOneAnother) {
  Simulation sim =
      run("<repeat times='2'>\n<wait seconds='1'/>\n<repeat times='3'>\n<wait seconds='0.5'/>\n</repeat>\n"
          "</repeat>");
  ASSERT_TRUE(run_to_line(sim, 1));
  EXPECT_NEAR(sim.time(), 2 * (1 + 3 * 0.5), 0.06 * 8);
}

TEST_F(Missions, AMissionOfStepsThatTakeNoTimeEndsNoTick) {
  Simulation sim = run("<repeat><say text='here'/></repeat>");
  run_to(sim, 1);
  EXPECT_EQ(row<Traffic>(sim, "radio/scout/traffic").asked > 0, true);
}

TEST_F(Missions, APlaceThatIsNotReachedIsGivenUp) {
  Simulation sim = run("<go_to at='50 0' patience='2'/>\n<wait seconds='5'/>");
  ASSERT_TRUE(run_to_line(sim, 3));
  EXPECT_NEAR(sim.time(), 2, 0.11);
  const double given_up = place_of(sim).x;
  run_to(sim, 10);
  EXPECT_NEAR(place_of(sim).x, given_up, 0.05) << "it stays where it gave up";
  EXPECT_THAT(said(sim, "mission"), ElementsAre("line 2: gives up going there after 2 s", "the mission is done"));
}

// The place in one mission means nothing in another.
TEST_F(Missions, AnotherMissionIsBegunAtItsBeginning) {
  std::string many;
  for (int i = 0; i < 50; ++i) many += "<say text='x'/>";
  folder.write("second.xml", "<mission><go_to at='-1 0'/></mission>");
  for (const std::string& first : {many + "<wait seconds='100'/>", std::string("<go_to at='1 0'/>")}) {
    Simulation sim =
        run(first,
            "<at t='4'><swap instance='mission' plugin='control.mission' robot='scout' mission='second.xml'/>"
            "</at>");
    run_to(sim, 12);
    EXPECT_LT(away(sim, -1, 0), 0.15);
  }
}

// An order that comes while it does something else is not forgotten.
TEST_F(Missions, AMessageIsTakenOnce) {
  folder.write("orders.xml", "<orders><order at='1' to='scout' text='go'/></orders>");
  Simulation sim = run("<wait seconds='3'/>\n<wait message='go' from='base'/>\n<wait message='go' patience='5'/>",
                       "<control.operator radio='base' orders='orders.xml'/>");
  ASSERT_TRUE(run_to_line(sim, 4));
  EXPECT_NEAR(sim.time(), 3, 0.11);
  ASSERT_TRUE(run_to_line(sim, 1));
  EXPECT_NEAR(sim.time(), 8, 0.2);
}

// Free space from 40 dB at 1 m: -60 dBm are at 10 m, -57 dBm at 7.1 m.
TEST_F(Missions, ALinkIsKept) {
  const double limit = 10, free = std::pow(10, 17 / 20.0);
  Simulation sim = run("<keep_link to='base' above='-60' margin='3'>\n<go_to at='30 0'/>\n</keep_link>",
                       "<control.beacon radio='base' period='0.2'/>");
  double farthest = 0;
  int turns = 0;
  bool was_held = false;
  while (sim.time() < 150) {
    sim.step();
    farthest = std::max(farthest, place_of(sim).x);
    const bool held = sim.table("instance/mission/state").at(0, 12) != 0;
    turns += held != was_held;
    was_held = held;
  }
  // The filter's 2 s, at 0.5 m/s, and the tick.
  EXPECT_GT(farthest, limit);
  EXPECT_LT(farthest, limit + 2.5);
  EXPECT_GT(place_of(sim).x, free - 1.5);
  EXPECT_GE(turns, 7);  // it tries again, and again; the first two are of the time before it heard the base
  EXPECT_EQ(line(sim), 3);
}

// The place of the tick before was no longer strong: the robot stayed there for ever.
TEST_F(Missions, AHeldRobotGoesBackToWhereItsLinkWasStrongAndThenGoesOn) {
  Simulation sim =
      run("<wait seconds='1'/>\n<keep_link to='base' above='-60' margin='3'>\n<go_to at='30 0'/>\n"
          "</keep_link>",
          "<control.beacon radio='base' period='0.2'/>");
  const auto is_held = [&] { return sim.table("instance/mission/state").at(0, 12) != 0; };
  const auto run_until = [&](bool held) {
    for (const double end = sim.time() + 40; sim.time() < end && is_held() != held;) sim.step();
    return is_held() == held;
  };
  run_to(sim, 5);
  ASSERT_FALSE(is_held());
  ASSERT_TRUE(run_until(true));
  const double turns_back = place_of(sim).x;
  EXPECT_GT(turns_back, 10);
  ASSERT_TRUE(run_until(false));
  EXPECT_LT(place_of(sim).x, std::pow(10, 17 / 20.0)) << "the link is strong nearer than that";
  ASSERT_TRUE(run_until(true)) << "it goes on";
  EXPECT_NEAR(place_of(sim).x, turns_back, 0.5);
}

TEST_F(Missions, WithoutAWordFromTheOtherItStaysWhereItIs) {
  Simulation sim = run("<keep_link to='base' above='-60'>\n<go_to at='5 0'/>\n</keep_link>");
  run_to(sim, 20);
  EXPECT_LT(away(sim, 0, 0), 0.02);
}

TEST_F(Missions, ChoosesByALinkAndByAMessage) {
  const std::string ways =
      "<wait seconds='2'/>\n<choose>\n<if link='base' below='-50'>\n<go_to at='0 2'/>\n</if>\n"
      "<if message='left' from='base'>\n<go_to at='2 2'/>\n</if>\n<otherwise>\n<go_to at='0 "
      "-2'/>\n</otherwise>\n</choose>\n<wait seconds='100'/>";
  const std::string beacon = "<control.beacon radio='base' period='0.2'/>";
  folder.write("orders.xml", "<orders><order at='1' to='scout' text='left'/></orders>");
  Simulation near = run(ways, beacon), deaf = run(ways),
             told = run(ways, "<control.operator radio='base' orders='orders.xml' name='o'/>" + beacon);
  for (Simulation* each : {&near, &deaf, &told}) ASSERT_TRUE(run_to_line(*each, 14));
  EXPECT_LT(away(near, 0, -2), 0.15);
  EXPECT_LT(away(deaf, 0, 2), 0.15);  // a link that was never heard is below any level
  EXPECT_LT(away(told, 2, 2), 0.15);
}

TEST_F(Missions, AMessageEndsTheMission) {
  folder.write("orders.xml",
               "<orders><order at='4' to='scout' text='home'/><order at='9' to='scout' text='home'/></orders>");
  Simulation sim =
      run("<repeat><go_to at='3 0'/><go_to at='3 1'/></repeat>\n<on message='home'>\n<go_to at='0 0'/>\n</on>",
          "<control.operator radio='base' orders='orders.xml'/>");
  ASSERT_TRUE(run_to_line(sim, 4));
  EXPECT_NEAR(sim.time(), 4, 0.11);
  ASSERT_TRUE(run_to_line(sim, 3));
  EXPECT_LT(away(sim, 0, 0), 0.15);
  run_to(sim, 30);
  EXPECT_EQ(line(sim), 3) << "a second one begins nothing anew";
  EXPECT_THAT(said(sim, "mission"), ElementsAre("the mission is ended by \"home\"", "the mission is done"));
}

TEST_F(Missions, OneFollowsAnother) {
  folder.write("lead.xml", "<mission><go_to at='6 3'/><wait seconds='8'/><say text='stop'/></mission>");
  const std::string two = scout +
                          "<robot name='lead' at='2 0 0'/><control.goal2d name='g' robot='lead' speed='0.4'/>"
                          "<control.mission name='leads' robot='lead' mission='lead.xml' report='0.5'/>";
  Simulation sim = run("<follow radio='lead' distance='1' until='stop'/>\n<go_to at='0 0'/>", "", two);
  ASSERT_TRUE(run_to_line(sim, 3));
  const Pose lead = place_of(sim, "lead");
  EXPECT_NEAR(away(sim, lead.x, lead.y), 1, 0.1);
  EXPECT_LT(away(sim, 6, 3, "lead"), 0.15);
}

TEST_F(Missions, AQuadrotorFliesThroughPlaces) {
  const std::string bird =
      "<robot name='scout' model='hummingbird' at='0 0 1'/><robots.attitude/><robots.mocap/>"
      "<control.velocity3d robot='scout'/><control.mission name='mission' robot='scout' mission='mission.xml' "
      "moves='air' speed='1.5'/>";
  Simulation sim = world_of(folder, base + bird + "<physics.simbody/>" + air,
                            {{"mission.xml", "<mission>\n<go_to at='3 0 2'/>\n<go_to at='3 2'/>\n</mission>\n"}},
                            "dt='0.01' until='60' seed='1'");
  ASSERT_TRUE(run_to_line(sim, 3, 20));
  EXPECT_NEAR(place_of(sim).z, 2, 0.12);
  ASSERT_TRUE(run_to_line(sim, 1, 20));
  run_to(sim, sim.time() + 5);
  EXPECT_LT(away(sim, 3, 2), 0.05);
  EXPECT_NEAR(place_of(sim).z, 2, 0.05);  // no height: it keeps that of before
}

// What it needs, and a network that nobody uses before, are no fault.
TEST_F(Missions, AMissionJoinsWithItsRobot) {
  Simulation sim = world_of(folder,
                            base + "<physics.planar/>" + air +
                                "<at t='2'><robot name='scout' at='0 0 0'/><control.goal2d robot='scout' speed='0.5'/>"
                                "<control.mission name='mission' robot='scout' mission='mission.xml'/></at>",
                            {{"mission.xml", "<mission>\n<go_to at='1 0'/>\n</mission>\n"}}, one_second);
  run_to(sim, 10);
  EXPECT_LT(away(sim, 1, 0), 0.15);
}

TEST_F(Missions, ARunIsTheSameAgain) {
  folder.write("mission.xml",
               "<mission><keep_link to='base' above='-60'><repeat><go_to at='1 0'/><wait message='go' "
               "patience='1'/></repeat></keep_link><on message='home'><go_to at='0 1'/></on></mission>");
  folder.write("orders.xml",
               "<orders><order at='1' to='scout' text='go' again='0.5'/><order at='2.2' text='home'/>"
               "</orders>");
  const std::string inside =
      base + scout + ground + air + "<control.operator name='o' radio='base' orders='orders.xml'/>";
  for (const char* name : {"mission", "o"}) expect_one_run([&] { return world_in(folder, inside); }, name, 80);
}

TEST_F(Missions, WhatIsSaidIsNoSightingWhateverItsLength) {
  for (const std::size_t size : {24, 32}) {
    Simulation sim = run("<wait seconds='0.5'/>\n<say text='" + std::string(size, 'x') + "'/>",
                         "<observe.target name='known' base='base' target='scout'/>");
    run_to(sim, 2);
    EXPECT_GT(row<Traffic>(sim, "radio/scout/traffic").delivered, 0);
    EXPECT_EQ(sim.table("instance/known/estimate").at(0, 8), 0) << "messages that are heard, of size " << size;
  }
}

TEST_F(Missions, WhatCannotBeIsRefusedWithItsPlace) {
  const auto refused = [&](const std::string& mission) {
    const std::string text = folder.inside(refusal([&] { run(mission); }));
    const auto at = text.find("mission.xml:");
    return at == text.npos ? text : text.substr(at + 12);
  };
  EXPECT_EQ(refused("<goto at='1 2'/>"),
            "2:1: <goto> is no step of a mission; expected one of go_to, wait, say, follow, keep_link, repeat, patrol, "
            "choose; did you mean \"go_to\"?");
  EXPECT_EQ(refused("<go_to at='1'/>"), "2:12: attribute \"at\": \"1\" is no place; expected x y or x y z");
  EXPECT_EQ(
      refused("<go_to at='4,0'/>"),
      "2:12: attribute \"at\": \"4,0\" is no place; expected x y or x y z; numbers stand between blanks: at=\"4 0\"");
  EXPECT_EQ(refused("<go_to at='1 2' with='3'/>"),
            "2:17: <go_to> has no attribute \"with\"; expected one of at, heading, within, patience; did you mean "
            "\"within\"?");
  EXPECT_EQ(refused("<wait seconds='2min'/>"),
            "2:16: attribute \"seconds\": \"2min\" is not a number; \"min\" follows the number: units are fixed and "
            "not written; expected a number from 0 to "
            "1e+09 s; 2min are 120 s");
  EXPECT_THAT(refused("<keep_link to='base' above='60'/>"),
              testing::HasSubstr("60 is out of bounds; expected a number from -200 to 50 dBm; is a minus missing?"));
  EXPECT_EQ(refused("<wait seconds='soon'/>"),
            "2:16: attribute \"seconds\": \"soon\" is not a number; expected a number from 0 to 1e+09 s");
  EXPECT_EQ(
      refused("<wait/>"),
      "2:1: <wait> has no attribute \"message\", which it needs; expected seconds=\"...\", or the text of a message");
  EXPECT_EQ(refused("<wait seconds='1' from='base'/>"),
            "2:1: <wait> has seconds=\"...\" and more; expected seconds=\"...\" alone, or message=\"...\"");
  EXPECT_EQ(
      refused("<choose>\n<if link='base' below='-60' from='base'><wait seconds='1'/></if>\n</choose>"),
      "3:29: <if link=\"...\"> has \"from\", which is of a message; expected link=\"...\" with below or above, or "
      "message=\"...\" with from");
  EXPECT_EQ(refused("<say text='x' to='bas'/>"),
            "2:19: no radio is called \"bas\"; expected one of base, scout; did you mean \"base\"?");
  EXPECT_EQ(refused("<follow radio='base'/>"),
            "2:1: <follow> has no end; expected until=\"MESSAGE\" or patience=\"SECONDS\"");
  EXPECT_THAT(refused("<repeat times='1.5'><wait seconds='1'/></repeat>"), HasSubstr("expected a whole number"));
  EXPECT_THAT(refused("<repeat times='2'></repeat>"), HasSubstr("<repeat> is empty"));
  EXPECT_THAT(
      refused("<keep_link to='base' above='-60'><keep_link to='base' above='-70'><wait seconds='1'/></keep_link>"
              "</keep_link>"),
      HasSubstr("the link to \"base\" is kept already"));
  EXPECT_THAT(
      refused("<choose><otherwise><wait seconds='1'/></otherwise><if message='a'><wait seconds='1'/></if></choose>"),
      HasSubstr("<if> stands after <otherwise>"));
  EXPECT_EQ(refused("<go_to at='1 2 3'/>"),
            "2:12: attribute \"at\": a robot on the ground has no height to go to; expected x y");
  EXPECT_EQ(refused("<keep_link to='scout' above='-60'><wait seconds='1'/></keep_link>"),
            "2:16: attribute \"to\": \"scout\" is the robot's own radio; expected another");
  EXPECT_THAT(refused(""), HasSubstr("<mission> is empty"));
  EXPECT_THAT(
      refused("<wait seconds='1'/><on message='a'><wait seconds='1'/></on><on message='a'><wait seconds='1'/></on>"),
      HasSubstr("an earlier <on> takes \"a\" already"));
  EXPECT_THAT(refused("<choose><if link='base'><wait seconds='1'/></if></choose>"), HasSubstr("needs one of below"));
}

TEST_F(Missions, ABeaconToItselfIsWarnedOf) {
  const Simulation sim = run("<wait seconds='1'/>", "<control.beacon name='calls' radio='base' to='base'/>");
  const std::vector<std::string> events = said(sim, "calls");
  ASSERT_EQ(events.size(), 1u);
  EXPECT_THAT(events[0], testing::EndsWith("attribute \"to\": \"base\" is the radio that it speaks on, so that nobody "
                                           "hears it; expected another radio, or no \"to\", which is all"));
}

TEST_F(Missions, AHeadingThatLooksLikeDegreesIsWarnedOf) {
  const Simulation sim = run("<go_to at='1 0' heading='90'/>\n<go_to at='1 0' heading='-3.1'/>");
  const std::vector<std::string> events = said(sim, "mission");
  ASSERT_EQ(events.size(), 1u);
  EXPECT_THAT(events[0], testing::StartsWith("warning: "));
  EXPECT_THAT(
      events[0],
      HasSubstr("mission.xml:2:26: attribute \"heading\": 90 rad is more than a full turn; are these degrees?"));
}

}  // namespace
