// An operator's orders go by the radio: they are lost, given again, answered.
#include "mission_world.hpp"

namespace {

using namespace muster;
using namespace muster::test;
using testing::ElementsAre;
using testing::EndsWith;

class Orders : public Missions {
 protected:
  Simulation ordered(const std::string& orders, const std::string& mission, const std::string& robots = scout) const {
    folder.write("orders.xml", "<orders>" + orders + "</orders>");
    return run(mission, "<control.operator name='operator' radio='base' orders='orders.xml'/>", robots);
  }
};

struct Given {
  double given, answered, unanswered;
};
Given given(const Simulation& run) { return row<Given>(run, "instance/operator/state"); }

TEST_F(Orders, AnOrderIsAnswered) {
  Simulation sim = ordered("<order at='2' to='scout' text='go' again='1'/>", "<wait message='go'/>\n<go_to at='1 0'/>");
  ASSERT_TRUE(run_to_line(sim, 3));
  EXPECT_NEAR(sim.time(), 2, 0.15);
  run_to(sim, 10);
  EXPECT_EQ(given(sim).given, 1);
  EXPECT_EQ(given(sim).answered, 1);
  EXPECT_THAT(said(sim, "operator"), ElementsAre("the order \"go\" is answered by scout"));
}

// At 40 + 20 log d dB and a sensitivity of -95 dBm everybody hears; behind a wall of 60 dB nobody.
TEST_F(Orders, WhatIsLostIsGivenAgainUntilItIsHeard) {
  const std::string robots =
      "<material name='lead' loss='60'/><wall name='w' from='1 -3' to='1 3' material='lead'/>"
      "<door name='d' wall='w' at='2.5' width='1' state='closed'/>"
      "<robot name='scout' at='2 0 0'/><control.goal2d robot='scout'/><control.mission "
      "name='mission' robot='scout' mission='mission.xml'/>"
      "<at t='6.5'><set path='door/d/state' value='open'/></at>";
  Simulation sim =
      ordered("<order at='1' to='scout' text='go' again='1'/>", "<wait message='go'/>\n<go_to at='2 1'/>", robots);
  ASSERT_TRUE(run_to_line(sim, 3));
  EXPECT_NEAR(sim.time(), 7, 0.15);
  EXPECT_EQ(given(sim).given, 7);
}

// As many orders as before: those that were done in the first file counted as done in the second.
TEST_F(Orders, ThoseOfAnotherFileAreStillToBeGiven) {
  folder.write("second.xml", "<orders><order at='5' to='scout' text='home'/></orders>");
  Simulation sim = ordered("<order at='1' to='scout' text='go'/>", "<wait message='go'/>\n<wait message='home'/>",
                           scout +
                               "<at t='4'><swap instance='operator' plugin='control.operator' radio='base' "
                               "orders='second.xml'/></at>");
  run_to(sim, 4.5);
  EXPECT_EQ(given(sim).given, 1);
  EXPECT_EQ(line(sim), 3);
  run_to(sim, 6);
  EXPECT_EQ(given(sim).given, 2);
  EXPECT_EQ(line(sim), 1) << "the end";
}

TEST_F(Orders, ItGivesUp) {
  Simulation sim = ordered("<order at='1' to='scout' text='dance' again='1' tries='3'/>", "<wait message='go'/>");
  run_to(sim, 10);
  EXPECT_EQ(given(sim).given, 3);
  EXPECT_EQ(given(sim).unanswered, 1);
  EXPECT_THAT(said(sim, "operator"),
              ElementsAre(EndsWith("attribute \"text\": no mission of this world waits for \"dance\"; expected go"),
                          "the order \"dance\" was never answered by scout"));
}

TEST_F(Orders, ThatNoMissionWaitsForOrThatComeTooLateAreDoubted) {
  Simulation sim = ordered("<order at='1e6' to='scout' text='go'/>", "<go_to at='1 1'/>");
  run_to(sim, 1);
  const std::vector<std::string> told = said(sim, "operator");
  ASSERT_FALSE(told.empty());
  EXPECT_THAT(told[0], EndsWith("no mission of this world waits for \"go\"; expected a <control.mission> with <wait "
                                "message=\"go\"/> or <on message=\"go\">"));
}

TEST_F(Orders, WhatCannotBeIsRefused) {
  const auto refused = [&](const std::string& order) {
    const std::string text = folder.inside(refusal([&] { ordered(order, "<wait seconds='1'/>"); }));
    const auto at = text.find("orders.xml:");
    return at == text.npos ? text : text.substr(at + 11);
  };
  EXPECT_EQ(refused("<order at='1' to='base' text='go'/>"),
            "1:27: attribute \"to\": \"base\" speaks to itself; expected another radio");
  EXPECT_EQ(refused(""), "1:1: <orders> is empty; expected <order at=\"...\" to=\"...\" text=\"...\"/>");
  EXPECT_EQ(refused("<order at='1' text='go' again='1'/>"),
            "1:9: <order> to all is answered by nobody in particular; again=\"...\" needs to=\"...\"");
  EXPECT_EQ(refused("<order at='1' to='scuot' text='go'/>"),
            "1:27: no radio is called \"scuot\"; expected one of base, scout; did you mean \"scout\"?");
  EXPECT_EQ(refused("<order at='1' to='scout' text='go' tries='3'/>"),
            "1:44: tries=\"...\" needs again=\"...\", the time between them");
  EXPECT_EQ(refused("<order at='1' to='scout' text='go' again='1' tries='2.5'/>"),
            "1:61: attribute \"tries\": 2.5 is no whole number; expected one, such as 3");
}

}  // namespace
