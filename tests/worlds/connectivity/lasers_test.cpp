// The chain with lasers: a planner's roadmap, the RSSI of messages and what a laser sees meet in one command.
#include "chain.hpp"

namespace {

using namespace muster;
using namespace muster::test;

TEST(Lasers, DoNotStopTheChainWhereNothingIsInItsWay) {
  Simulation with(connectivity("lasers.xml"), standard(), options());
  Simulation without(connectivity(), standard(), options());
  run_until(with, 500);
  run_until(without, 500);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(chain_of(with)[i].rssi, -60, 0.1) << i;
    EXPECT_NEAR(chain_of(with)[i].distance, chain_of(without)[i].distance, 0.01) << i;
  }
}

// A crate on the leader's way, 0.4 m long, its middle at 10 m.
Simulation with_a_crate(const Folder& folder, const std::string& file) {
  std::string world = contents(std::string(MUSTER_SOURCE_DIR "/worlds/connectivity/") + file);
  world.insert(world.find("<physics.simbody"), "<robot name=\"crate\" model=\"crate\" at=\"10 12 0\"/>");
  for (const char* beside : {"walls.csv", "roadmap.csv"})
    std::filesystem::copy(std::string(MUSTER_SOURCE_DIR "/worlds/connectivity/") + beside, folder / beside);
  return load(folder.write("world.xml", world));
}

TEST(Lasers, StopTheLeaderBeforeACrate) {
  const Folder one, other;
  Simulation with = with_a_crate(one, "lasers.xml"), without = with_a_crate(other, "world.xml");
  run_until(with, 30);
  run_until(without, 30);
  EXPECT_NEAR(row<Pose>(with, "robot/leader/pose").x, 9.8 - 0.3, 0.05);
  EXPECT_NEAR(row<Pose>(with, "robot/crate/pose").x, 10, 1e-3);
  EXPECT_GT(row<Pose>(without, "robot/crate/pose").x, 11) << "pushed along";
}

}  // namespace
