// Routings with radios in several PANs of 802.15.4: broadcasts stay in one, messages to one radio may cross.
#include <map>

#include "routing_worlds.hpp"

namespace muster {
namespace {

// r0 and r1 are in one PAN, r2 and r3 in another.
const std::string two_pans = "<radio.pan id=\"1\" radios=\"r2 r3\"/>\n";

class RoutedPans : public Routings {
 protected:
  // Of one message from r0 after so many seconds: the number of copies by outcome, and of relayed packets.
  std::map<std::string, double> journey(int seconds, const std::string& routing, const std::string& to) const {
    Simulation sim =
        world("network.lrwpan", routing, chain(4) + two_pans + send("s", "r0", to + " only=\"1\""), 1, "0.05");
    run(sim, 20 * seconds);
    std::map<std::string, double> result;
    for (const std::string& outcome : outcomes)
      if (const double count = journeys(sim, "r0", outcome); count > 0) result[outcome] = count;
    if (const double count = sum_of(sim, "radio/*/relaying", relayed); count > 0) result["relayed"] = count;
    return result;
  }
};

using testing::ElementsAre;
using Outcome = std::pair<const std::string, double>;

TEST_F(RoutedPans, AFloodStaysInItsPan) {
  EXPECT_THAT(journey(5, "routing.flooding", ""), ElementsAre(Outcome("delivered", 1), Outcome("lost", 2),
                                                              Outcome("relayed", 1)));  // by r1, to no receiver
}

TEST_F(RoutedPans, ASearchStaysInItsPan) {
  EXPECT_THAT(journey(100, "routing.aodv", "to=\"r3\""), ElementsAre(Outcome("no_route", 1)));
  EXPECT_THAT(journey(30, "routing.aodv", "to=\"r1\""), ElementsAre(Outcome("delivered", 1)));
}

TEST_F(RoutedPans, ATableLeadsFromOneToTheOther) {
  folder.put("routes.csv", chain_routes(4));
  EXPECT_THAT(journey(5, "routing.static routes=\"routes.csv\"", "to=\"r3\""),
              ElementsAre(Outcome("delivered", 1), Outcome("relayed", 2)));
}

// A message without any receiver is settled as soon as it is sent.
TEST_F(RoutedPans, WhoIsAloneInItsPanDoesNotWaitForAnybody) {
  Simulation sim = world("network.lrwpan", "routing.none",
                         chain(3) + "<radio.pan id=\"1\" radios=\"r1\"/>" + send("s", "r1") +
                             "<swap at=\"3\" instance=\"s\" plugin=\"test.sender\" from=\"r1\" count=\"0\"/>\n");
  run(sim, 40);
  EXPECT_GE(journeys(sim, "r1", "asked"), 58);
  EXPECT_EQ(journeys(sim, "r1", "lost"), journeys(sim, "r1", "asked"));
}

}  // namespace
}  // namespace muster
