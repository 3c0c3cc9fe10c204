// Exchanging the physics in mid-run: the state is handed over whole, and the new backend keeps its declared bound.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kernel/simulation.hpp"
#include "tests/backends.hpp"

namespace muster {
namespace {

constexpr double acceleration = 0.8 * 9.81;  // [m/s2] what all backends declare for the Scarab: friction times gravity

const std::filesystem::path folder = std::filesystem::path(MUSTER_SOURCE_DIR) / "worlds/hot_swap";

std::unique_ptr<Simulation> hot_swap(std::vector<Occasion> swaps = {}) {
  World world = read_world(folder, standard());
  world.occasions = std::move(swaps);
  return std::make_unique<Simulation>(std::move(world), standard(), Options{{MUSTER_PLUGINS_DIR}, 1, {}});
}

InstanceDeclaration backend(const std::string& plugin) { return {plugin, plugin, 1, {}, {}, {}, {"test"}}; }

Occasion swap(uint64_t tick, const std::string& plugin) {
  return {.tick = tick, .plugins = {{PluginChange::Kind::swap, "physics", backend(plugin)}}};
}

std::vector<double> cells(const Simulation& run, const std::string& table) {
  return run.table(table).table->now().data;
}

void run_to(Simulation& run, double time) {
  while (run.time() < time - run.world().dt / 2) run.step();
}

struct Handover {
  std::string from, to;
  std::vector<std::string> said;  // in the swap's events
};
void PrintTo(const Handover& handover, std::ostream* out) { *out << handover.from << " to " << handover.to; }

// One after the other, as in the world's files.
std::vector<Handover> chain() {
  std::vector<Handover> result = {
      {"physics.simbody", "physics.ode", {"dropped robot/*/contact, which nobody writes any more"}},
      {"physics.ode",
       "physics.planar",
       {"it cannot hold changes of height", "wheel slip", "dropped robot/*/hinged",
        "dropped instance/physics/*/complaints"}},
      {"physics.planar", "physics.simbody", {}}};
  if (test::built({"physics.mujoco"}).empty()) return result;
  result.push_back({"physics.ode", "physics.mujoco", {"dropped robot/*/hinged"}});
  result.push_back({"physics.mujoco", "physics.planar", {"it cannot hold changes of height", "wheel slip"}});
  return result;
}

class HotSwap : public testing::TestWithParam<Handover> {};

TEST_P(HotSwap, HandsOverEveryBitAndKeepsTheAccelerationBound) {
  const auto& [from, to, said] = GetParam();
  auto run = hot_swap();
  if (from != "physics.simbody") run->swap("physics", backend(from));
  run_to(*run, 4);
  const auto pose = cells(*run, "robot/*/pose");
  const auto twist = cells(*run, "robot/*/twist");
  for (std::size_t r = 0; r < 2; ++r)
    ASSERT_GT(std::hypot(twist[r * 6], twist[r * 6 + 1]), 0.05) << "robot " << r << " stands still";
  run->swap("physics", backend(to));
  EXPECT_EQ(cells(*run, "robot/*/pose"), pose);
  EXPECT_EQ(cells(*run, "robot/*/twist"), twist);
  std::string events;
  for (const auto& event : run->events()) events += event.message + '\n';
  EXPECT_NE(events.find("swapped from " + from + " to " + to), std::string::npos) << events;
  for (const std::string& text : said) EXPECT_NE(events.find(text), std::string::npos) << text << " in\n" << events;

  run->step();
  const auto after = cells(*run, "robot/*/twist"), moved = cells(*run, "robot/*/pose");
  const double dt = run->world().dt;
  for (std::size_t r = 0; r < 2; ++r) {
    const double change = std::hypot(after[r * 6] - twist[r * 6], after[r * 6 + 1] - twist[r * 6 + 1]);
    EXPECT_LE(change, acceleration * dt * (1 + 1e-9)) << "robot " << r;
    // The position is the old one plus the velocity over dt, within half the bound's share of it.
    const double expected_x = pose[r * 7] + dt * twist[r * 6], expected_y = pose[r * 7 + 1] + dt * twist[r * 6 + 1];
    EXPECT_LE(std::hypot(moved[r * 7] - expected_x, moved[r * 7 + 1] - expected_y), acceleration * dt * dt)
        << "robot " << r;
  }
}
INSTANTIATE_TEST_SUITE_P(Backends, HotSwap, testing::ValuesIn(chain()),
                         [](const auto& made) { return made.param.from.substr(8) + "_to_" + made.param.to.substr(8); });

// The robots end where they would have without a swap, but for what the models differ in: rolling without slip is the
// same motion on all.
TEST(HotSwapRun, EndsNearTheRunWithoutSwaps) {
  auto plain = hot_swap();
  auto swapped = hot_swap({swap(300, "physics.ode"), swap(600, "physics.planar"), swap(900, "physics.simbody")});
  run_to(*plain, 12);
  run_to(*swapped, 12);
  const auto a = cells(*plain, "robot/*/pose"), b = cells(*swapped, "robot/*/pose");
  for (std::size_t r = 0; r < 2; ++r)
    EXPECT_LT(std::hypot(a[r * 7] - b[r * 7], a[r * 7 + 1] - b[r * 7 + 1]), 0.02) << "robot " << r;
  EXPECT_NE(a, b);  // they are three models
}

// The world with four backends, as it is shipped.
TEST(HotSwapRun, GoesThroughMujoco) {
  if (test::built({"physics.mujoco"}).empty()) GTEST_SKIP() << "needs libmujoco-dev";
  auto plain = hot_swap();
  Simulation run(read_world(folder / "mujoco.xml", standard()), standard(), {{MUSTER_PLUGINS_DIR}, 1, {}});
  while (!run.done()) run.step();
  run_to(*plain, run.time());
  std::vector<std::string> swaps;
  for (const auto& event : run.events()) {
    if (event.message.find("swapped from ") != std::string::npos) swaps.push_back(event.message);
  }
  const std::vector<std::string> expected{"physics.simbody to physics.ode", "physics.ode to physics.mujoco",
                                          "physics.mujoco to physics.planar", "physics.planar to physics.simbody"};
  ASSERT_EQ(swaps.size(), expected.size());
  for (std::size_t k = 0; k < swaps.size(); ++k) EXPECT_NE(swaps[k].find(expected[k]), std::string::npos) << swaps[k];
  const auto a = cells(*plain, "robot/*/pose"), b = cells(run, "robot/*/pose");
  for (std::size_t r = 0; r < 2; ++r)
    EXPECT_LT(std::hypot(a[r * 7] - b[r * 7], a[r * 7 + 1] - b[r * 7 + 1]), 0.02) << "robot " << r;
}

// Planned in the world file and asked for by hand are one thing.
TEST(HotSwapRun, PlannedSwapsEqualSwapsByHand) {
  auto planned = hot_swap({swap(100, "physics.planar")});
  auto by_hand = hot_swap();
  run_to(*planned, 2);
  run_to(*by_hand, 1);
  by_hand->swap("physics", backend("physics.planar"));
  run_to(*by_hand, 2);
  EXPECT_EQ(planned->digest(), by_hand->digest());
}

}  // namespace
}  // namespace muster
