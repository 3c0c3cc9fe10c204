// Twenty crowds and ten jams of fifty Scarabs: what contact_test.cpp asks of a few, at length.
#include <cstdio>

#include "crowds.hpp"
#include "midpoint.hpp"

namespace muster::simbody {
namespace {

constexpr int count = 50;
constexpr double dt = 0.01;  // [s]

// Runs on the stepper itself, which counts its searches, and says what was seen.
void run(Fleet& fleet, double until, const std::function<Command(int, double)>& command_of, const std::string& name) {
  std::vector<NamedRobot> robots;
  for (int i = 0; i < count; ++i) robots.push_back({"r" + std::to_string(i), &scarab()});
  Midpoint engine(robots, dt);
  engine.set_surroundings(slabs(fleet.walls(), {}), 0.3);
  Trouble seen;
  for (int k = 0; k < std::lround(until / dt); ++k) {
    std::vector<Command> commands;
    for (int i = 0; i < count; ++i) commands.push_back(command_of(i, k * dt));
    engine.step(dt, commands, fleet.states);
    seen.see(fleet, dt);
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
    Fleet fleet(square(count, [&](int i, double, double) { return 6.28 * Stream(seed).uniform(1000 + i); }));
    fleet.among(arena(count), 0.3);
    const RandomArcs arcs(seed);
    run(
        fleet, 10, [&](int i, double t) { return arcs.between(i, t, t + dt); }, "crowd " + std::to_string(seed));
  }
}

TEST(Crowd, TenJams) {
  const double middle = 0.5 * spacing * (std::ceil(std::sqrt(count)) - 1);
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    Fleet fleet(square(count, [&](int, double x, double y) { return std::atan2(middle - y, middle - x); }));
    const Stream stream(seed);
    const auto inward = [&](int i, double t) {
      return command(0.4 * std::min(1.0, 2 * t), 0.6 * (stream.uniform(i, static_cast<uint64_t>(t + 1e-9)) - 0.5));
    };
    run(fleet, 5, inward, "jam " + std::to_string(seed));
  }
}

}  // namespace
}  // namespace muster::simbody
