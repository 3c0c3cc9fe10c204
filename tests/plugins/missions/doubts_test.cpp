// What is legal in missions and cannot go as it is written is warned of, with its place.
#include "mission_world.hpp"

namespace {

using namespace muster;
using namespace muster::test;
using testing::ElementsAre;
using testing::EndsWith;

TEST_F(Missions, AMessageThatNobodySaysIsWarnedOf) {
  EXPECT_THAT(
      said(run("<wait message='go'/>"), "mission"),
      ElementsAre(EndsWith("mission.xml:2:1: <wait> waits for \"go\", and no mission and no orders of this world "
                           "say it; expected <say text=\"go\"/> or an <order>")));
}

TEST_F(Missions, AMessageThatNobodySaysIsWarnedOfBesidePluginsThatSayNothing) {
  folder.write("log.csv", "t[s],robot,v[m/s],w[rad/s]\n0,other,0.1,0\n1,other,0,0\n");
  const std::string silent =
      "<control.recorded robot='other' file='log.csv'/><effect.rx_offset radio='base' offset='3'/>";
  EXPECT_THAT(said(run("<wait message='go'/>", silent, scout + "<robot name='other' at='5 5 0'/>"), "mission"),
              ElementsAre(testing::HasSubstr("<wait> waits for \"go\", and no mission and no orders of this world")));
}

TEST_F(Missions, StepsThatAreNeverComeToAreWarnedOf) {
  EXPECT_THAT(said(run("<patrol><place at='1 0'/></patrol>\n<say text='done'/>"), "mission"),
              ElementsAre(testing::HasSubstr("mission.xml:3:1: <say> is never come to: <patrol> (")));
  EXPECT_THAT(said(run("<patrol times='2'><place at='1 0'/></patrol>\n<say text='done'/>"), "mission"), ElementsAre());
  EXPECT_THAT(said(run("<wait seconds='1e6'/>\n<say text='done'/>"), "mission"),
              ElementsAre(testing::HasSubstr("mission.xml:3:1: <say> is never come to: <wait> (")));
}

TEST_F(Missions, PlacesInMillimetresAreDoubted) {
  EXPECT_THAT(said(run("<go_to at='800000 0'/>"), "mission"), ElementsAre(EndsWith("are these millimetres?")));
}

TEST_F(Missions, PeriodsAreHeldAgainstTheTick) {
  const Simulation sim = run("<wait seconds='1'/>", "<control.beacon name='calls' radio='base' period='0.001'/>");
  EXPECT_THAT(said(sim, "calls"), ElementsAre(testing::HasSubstr("0.001 s is less than a tick of ")));
}

}  // namespace
