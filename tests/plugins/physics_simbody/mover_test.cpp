// Robots that cannot meet within a tick are moved separately, with identical results.
#include <gtest/gtest.h>

#include <cstring>
#include <thread>

#include "benchmarks/crowds.hpp"
#include "midpoint_engine.hpp"
#include "motion.hpp"
#include "walkers.hpp"

namespace muster::simbody {
namespace {

constexpr double tick = 0.125, step = tick / 128;  // exact in binary: both sides have steps of the same length

bool same_bits(const std::vector<RobotState>& a, const std::vector<RobotState>& b) {
  return a.size() == b.size() && !std::memcmp(a.data(), b.data(), a.size() * sizeof(RobotState));
}

std::vector<NamedRobot> scarabs(std::size_t count) {
  std::vector<NamedRobot> robots;
  for (std::size_t i = 0; i < count; ++i) robots.push_back({"r" + std::to_string(i), &scarab()});
  return robots;
}

// Runs half of the calls on a thread of its own, and each half backwards.
void backwards_on_two_threads(std::size_t count, const std::function<void(std::size_t)>& call) {
  const auto some = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = to; i > from; --i) call(i - 1);
  };
  std::thread other(some, 0, count / 2);
  some(count / 2, count);
  other.join();
}

// A crowd on random commands for a second, each held for a tick.
std::vector<RobotState> crowd_after(double own_tick, const Each& each = one_by_one) {
  std::vector<RobotState> states = crowd_at_rest(5);
  MidpointEngine engine(scarabs(states.size()), step);
  engine.set_surroundings(scene::slabs(arena(crowd), {}), 0.3);
  const RandomArcs arcs(5);
  std::vector<Command> commands(states.size());
  for (int k = 0; k < 8; ++k) {
    for (int i = 0; i < crowd; ++i) {
      const Command c = arcs.between(i, 0.2 + k * tick, 0.2 + (k + 1) * tick);
      commands[i] = {c.left, c.right, 0, 0};
    }
    for (int part = 0; part < std::lround(tick / own_tick); ++part) engine.step(own_tick, commands, states, each);
  }
  return states;
}

TEST(ClusterStepper, LongTicksFindWhoMeetsInTheirMidst) {
  EXPECT_TRUE(same_bits(crowd_after(tick), crowd_after(step)));
}

TEST(ClusterStepper, ThreadsAndTheirOrderDoNotShow) {
  EXPECT_TRUE(same_bits(crowd_after(tick / 4), crowd_after(tick / 4, backwards_on_two_threads)));
}

// The second of three is at rest, beyond the third's reach by all bounds, until the first hits it towards the third:
// the tick starts again.
TEST(ClusterStepper, WhoIsStruckMeetsOthersInTheSameTick) {
  constexpr double long_tick = 0.0625;
  const auto after = [](double own_tick) {
    const RobotModel model(scarab());
    const double off = 2 * model.reach + 4 * way_of(model, at_rest(0, 0, 0), long_tick) + 0.01;
    std::vector<RobotState> states = {at_rest(0, 0, 0), at_rest(0.25, 0, 0), at_rest(0.25 + off, 0, 0)};
    states[0].twist[0] = 20;
    MidpointEngine engine(scarabs(3), long_tick / 64);
    engine.set_surroundings({}, 0.3);
    for (int part = 0; part < std::lround(long_tick / own_tick); ++part)
      engine.step(own_tick, std::vector<Command>(3), states);
    EXPECT_GT(states[2].pose[0], 0.26 + off) << "the third was not reached";
    return states;
  };
  EXPECT_TRUE(same_bits(after(long_tick), after(long_tick / 64)));
}

// Each as in an engine of its own kind, while they are far from each other.
TEST(ClusterStepper, LegsHaveStepsAndUnknownsOfTheirOwn) {
  const std::vector<NamedRobot> walker = {{"walker", &rdk()}}, roller = scarabs(1);
  MidpointEngine both({walker[0], roller[0]}, Steps(0.01, 0.002)), legs(walker, 0.002), wheels(roller, 0.01);
  std::vector<RobotState> two = {at_rest(0, 0, 0), at_rest(2, 0, 1)}, first = {two[0]}, second = {two[1]};
  for (int k = 0; k < 100; ++k) {
    const Command walk = Walk{1}.over(0.01 * k, 0.01), drive = command(0.3, 0.5);
    both.step(0.01, {walk, drive}, two);
    legs.step(0.01, {walk}, first);
    wheels.step(0.01, {drive}, second);
  }
  EXPECT_TRUE(same_bits({two[0]}, first));
  EXPECT_TRUE(same_bits({two[1]}, second));
}

TEST(ClusterStepper, WhoMayMeetLegsTakesTheirSteps) {
  const std::vector<NamedRobot> robots = {{"walker", &rdk()}, {"roller", &scarab()}};
  MidpointEngine mixed(robots, Steps(0.01, 0.002)), fine(robots, 0.002);
  std::vector<RobotState> a = {at_rest(0, 0, 0), at_rest(0.35, 0, 3)}, b = a;
  for (int k = 0; k < 20; ++k) {
    const std::vector<Command> commands = {Walk{1}.over(0.01 * k, 0.01), command(0.1, 0)};
    mixed.step(0.01, commands, a);
    fine.step(0.01, commands, b);
  }
  EXPECT_TRUE(same_bits(a, b));
}

}  // namespace
}  // namespace muster::simbody
