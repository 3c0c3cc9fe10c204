// Exchanging the physics in mid-run: the state is handed over whole, and the new backend keeps its declared bound.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kernel/simulation.hpp"

namespace muster {
namespace {

constexpr double acceleration = 0.8 * 9.81;  // [m/s2] what both backends declare for the Scarab: friction times gravity

std::unique_ptr<Simulation> hot_swap(std::vector<SwapDeclaration> swaps = {}) {
  World world = read_world(std::filesystem::path(MUSTER_SOURCE_DIR) / "worlds/hot_swap", standard());
  world.swaps = std::move(swaps);
  return std::make_unique<Simulation>(std::move(world), standard(), Options{{MUSTER_PLUGINS_DIR}, 1, {}});
}

InstanceDeclaration backend(const std::string& plugin) { return {plugin, plugin, 1, {}, {}, {}, {"test"}}; }

std::vector<double> cells(const Simulation& run, const std::string& table) {
  return run.table(table).table->now().data;
}

void run_to(Simulation& run, double time) {
  while (run.time() < time - run.world().dt / 2) run.step();
}

class HotSwap : public testing::TestWithParam<const char*> {};

TEST_P(HotSwap, HandsOverEveryBitAndKeepsTheAccelerationBound) {
  auto run = hot_swap();
  if (std::string(GetParam()) == "physics.simbody") run->swap("physics", backend("physics.planar"));
  run_to(*run, 4);
  const auto pose = cells(*run, "robot/*/pose");
  const auto twist = cells(*run, "robot/*/twist");
  for (std::size_t r = 0; r < 2; ++r)
    ASSERT_GT(std::hypot(twist[r * 6], twist[r * 6 + 1]), 0.05) << "robot " << r << " stands still";
  run->swap("physics", backend(GetParam()));
  EXPECT_EQ(cells(*run, "robot/*/pose"), pose);
  EXPECT_EQ(cells(*run, "robot/*/twist"), twist);
  run->step();
  const auto after = cells(*run, "robot/*/twist");
  const double dt = run->world().dt;
  for (std::size_t r = 0; r < 2; ++r) {
    const double change = std::hypot(after[r * 6] - twist[r * 6], after[r * 6 + 1] - twist[r * 6 + 1]);
    EXPECT_LE(change, acceleration * dt * (1 + 1e-9)) << "robot " << r;
    // The position is the old one plus the velocity over dt, within half the bound's share of it.
    const auto moved = cells(*run, "robot/*/pose");
    const double expected_x = pose[r * 7] + dt * twist[r * 6], expected_y = pose[r * 7 + 1] + dt * twist[r * 6 + 1];
    EXPECT_LE(std::hypot(moved[r * 7] - expected_x, moved[r * 7 + 1] - expected_y), acceleration * dt * dt)
        << "robot " << r;
  }
}
INSTANTIATE_TEST_SUITE_P(Backends, HotSwap, testing::Values("physics.planar", "physics.simbody"),
                         [](const auto& made) { return std::string(made.param).substr(8); });

TEST(HotSwapEvents, SayWhatIsDropped) {
  auto run = hot_swap();
  run_to(*run, 1);
  run->swap("physics", backend("physics.planar"));
  std::string all;
  for (const auto& event : run->events()) all += event.message + '\n';
  EXPECT_NE(all.find("swapped from physics.simbody to physics.planar/1; it cannot hold "), std::string::npos) << all;
  EXPECT_NE(all.find("dropped robot/*/contact, which nobody writes any more"), std::string::npos) << all;
}

// The robots end where they would have without a swap, but for what the models differ in: rolling without slip is the
// same motion on both.
TEST(HotSwapRun, EndsNearTheRunWithoutSwaps) {
  auto plain = hot_swap();
  auto swapped = hot_swap({{400, "physics", backend("physics.planar")}, {800, "physics", backend("physics.simbody")}});
  run_to(*plain, 12);
  run_to(*swapped, 12);
  const auto a = cells(*plain, "robot/*/pose"), b = cells(*swapped, "robot/*/pose");
  for (std::size_t r = 0; r < 2; ++r)
    EXPECT_LT(std::hypot(a[r * 7] - b[r * 7], a[r * 7 + 1] - b[r * 7 + 1]), 0.02) << "robot " << r;
  EXPECT_NE(a, b);  // they are two models
}

// Planned in the world file and asked for by hand are one thing.
TEST(HotSwapRun, PlannedSwapsEqualSwapsByHand) {
  auto planned = hot_swap({{100, "physics", backend("physics.planar")}});
  auto by_hand = hot_swap();
  run_to(*planned, 2);
  run_to(*by_hand, 1);
  by_hand->swap("physics", backend("physics.planar"));
  run_to(*by_hand, 2);
  EXPECT_EQ(planned->digest(), by_hand->digest());
}

}  // namespace
}  // namespace muster
