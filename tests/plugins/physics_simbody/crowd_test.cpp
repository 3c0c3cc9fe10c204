// Twenty crowds and ten jams of fifty Scarabs: the checks of contact_test.cpp on many robots, at length.
#include <gtest/gtest.h>

#include <cstdio>

#include "benchmarks/crowds.hpp"
#include "midpoint_engine.hpp"

namespace muster::simbody {
namespace {

constexpr double dt = 0.01;  // [s]

// Runs on the stepper itself, which counts its searches, and prints the statistics.
void run(std::vector<RobotState> states, const std::vector<scene::Wall>& walls, double until,
         const std::function<Command(int, double)>& command_of, const std::string& name) {
  std::vector<NamedRobot> robots;
  for (int i = 0; i < crowd; ++i) robots.push_back({"r" + std::to_string(i), &scarab()});
  MidpointEngine engine(robots, dt);
  const auto slabs_of_walls = slabs(walls, {});
  engine.set_surroundings(slabs_of_walls, 0.3);
  Trouble seen;
  for (int k = 0; k < std::lround(until / dt); ++k) {
    std::vector<Command> commands;
    for (int i = 0; i < crowd; ++i) commands.push_back(command_of(i, k * dt));
    engine.step(dt, commands, states);
    seen.see(states, slabs_of_walls, dt);
  }
  std::printf("%s: penetration %.2f mm, rise %.2f m/s, tilt %.1f deg; searches %ld, unsettled %ld, failed %ld\n",
              name.c_str(), 1e3 * seen.deepest, seen.rise, seen.tilt * 180 / M_PI, engine.count().solved,
              engine.count().unsettled, engine.count().failed);
  EXPECT_LE(seen.deepest, 1e-3) << name;
  EXPECT_LE(seen.rise, 0.3) << name;
  EXPECT_LE(engine.count().failed, 1e-5 * static_cast<double>(engine.count().solved)) << name;
}

TEST(Crowd, TwentySeeds) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const RandomArcs arcs(seed);
    run(
        crowd_at_rest(seed), arena(crowd), 10, [&](int i, double t) { return arcs.between(i, t, t + dt); },
        "crowd " + std::to_string(seed));
  }
}

TEST(Crowd, TenJams) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const Stream stream(seed);
    run(
        jam_at_rest(), {}, 5, [&](int i, double t) { return inward(stream, i, t); }, "jam " + std::to_string(seed));
  }
}

}  // namespace
}  // namespace muster::simbody
