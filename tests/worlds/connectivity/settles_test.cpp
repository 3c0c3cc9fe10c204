// Where the chain of worlds/connectivity comes to rest, and what it looks like there.
#include <algorithm>
#include <vector>

#include "chain.hpp"

namespace {

using namespace muster;
using namespace muster::test;

// Every link within 1 dB of the threshold over the last 200 s, never far under it on the way (Fig. 5), and nobody moves
// at the end.
void expect_held(Simulation& run) {
  while (!run.done()) {
    run.step();
    for (std::size_t i = 0; i < 3; ++i) {
      const double rssi = chain_of(run)[i].rssi;
      ASSERT_GT(rssi, -61.5) << i << " at " << run.time();
      if (run.time() > 300) {
        ASSERT_NEAR(rssi, -60, 1) << i << " at " << run.time();
      }
    }
  }
  for (const char* name : {"steer1", "steer2", "steer"})
    EXPECT_LT(std::abs(steering_of(run, name).speed), 0.005) << name;
}

class Settles : public testing::TestWithParam<const char*> {};

TEST_P(Settles, EveryLinkAtTheThresholdOnceExtended) {
  Simulation run(connectivity("world.xml", GetParam()), standard(), options());
  expect_held(run);
  const Chain at_end = chain_of(run);
  EXPECT_EQ(at_end.follower1.walls, 0);
  EXPECT_EQ(at_end.follower2.walls, 4) << "the followers have the obstacle between them";
  EXPECT_EQ(at_end.leader.walls, 0);
  // Fig. 4: at equal RSSI, those whom the obstacle parts are closer.
  EXPECT_LT(at_end.follower2.distance, 0.7 * at_end.follower1.distance);
  EXPECT_LT(at_end.follower2.distance, 0.7 * at_end.leader.distance);
}

INSTANTIATE_TEST_SUITE_P(Physics, Settles, testing::Values("physics.planar", "physics.simbody"),
                         [](const auto& each) { return std::string(each.param).substr(8); });

TEST(Connectivity, TheGoalIsOutOfReachAndTheRelaysMatter) {
  Simulation run(connectivity(), standard(), options());
  run_until(run, 500);
  EXPECT_LT(steering_of(run, "steer").arclength, 56);
  const auto base = row<Mount>(run, "radio/base/mount");
  const auto leader = row<Pose>(run, "robot/leader/pose");
  const double alone = -25 - 12.9 - 17 * std::log10(std::hypot(base.x - leader.x, base.y - leader.y)) - 4;
  EXPECT_LT(alone, -68) << "without relays the leader would have been lost long before";
}

TEST(Connectivity, NoWallIsCrossedAtRest) {
  Simulation run(connectivity(), standard(), options());
  run_until(run, 250);
  while (!run.done()) {
    run.step();
    ASSERT_EQ(chain_of(run).follower2.walls, 4) << run.time();
  }
}

TEST(Connectivity, FollowersStayUntilTheyAreNeeded) {
  Simulation run(connectivity(), standard(), options());
  while (chain_of(run).leader.rssi > -50 || run.tick() == 0) run.step();
  EXPECT_NEAR(row<Pose>(run, "robot/follower2/pose").x, 6, 0.01);
  while (chain_of(run).follower2.rssi > -50) run.step();
  EXPECT_NEAR(row<Pose>(run, "robot/follower1/pose").x, 5, 0.01);
}

// With fading, the rssi smoothed over 5 s: at least nine tenths of all readings within 1 dB of the threshold, and
// ninety-nine hundredths within 2 dB, over the last 200 s and five seeds.
TEST(Connectivity, HoldsItsQuantilesWithFading) {
  std::vector<double> off;
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    World world = connectivity("fading.xml");
    world.seed = seed;
    Simulation run(std::move(world), standard(), options());
    run_until(run, 300);
    while (!run.done()) {
      run.step();
      for (std::size_t i = 0; i < 3; ++i) off.push_back(std::abs(chain_of(run)[i].smooth + 60));
    }
    EXPECT_LT(chain_of(run).follower2.distance, chain_of(run).leader.distance) << seed;
  }
  std::sort(off.begin(), off.end());
  EXPECT_LT(off[off.size() * 9 / 10], 1);
  EXPECT_LT(off[off.size() * 99 / 100], 2);
}

class Switchings : public testing::TestWithParam<const char*> {};

TEST_P(Switchings, TheSwitchingFunctionIsAParameter) {
  World world = connectivity();
  for (const char* name : {"steer1", "steer2", "steer"}) {
    set(instance_of(world, name), "switching", GetParam());
    set(instance_of(world, name), "width", GetParam() == std::string("relay") ? "1" : "3");
  }
  Simulation run(std::move(world), standard(), options());
  expect_held(run);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Switchings, testing::Values("tanh", "relay"),
                         [](const auto& each) { return std::string(each.param); });

TEST(Connectivity, AGoalWithinReachIsReached) {
  Folder folder;
  const auto roadmap = folder.write("near.csv", "x[m],y[m]\n3.5,12\n20,12\n");
  World world = connectivity();
  set(instance_of(world, "steer"), "roadmap", roadmap);
  Simulation run(std::move(world), standard(), options());
  run_until(run, 200);
  EXPECT_NEAR(row<Pose>(run, "robot/leader/pose").x, 20, 0.02);
  EXPECT_GT(chain_of(run).leader.rssi, -60);
}

TEST(Connectivity, WithoutTheBaseTheChainDrawsBack) {
  Simulation run(connectivity(), standard(), options());
  run_until(run, 250);
  const double before = steering_of(run, "steer1").arclength;
  run.remove("control.beacon");
  run_until(run, 254);
  EXPECT_NEAR(steering_of(run, "steer1").arclength, before, 0.1) << "not yet lost";
  run_until(run, 290);
  EXPECT_LT(steering_of(run, "steer1").arclength, before - 5);
  run_until(run, 400);
  EXPECT_LT(steering_of(run, "steer1").arclength, 0.5) << "as far as the roadmap goes";
}

}  // namespace
