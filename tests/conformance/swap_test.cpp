// From each backend to each: motion continues without a jump.
#include <muster/limbs.hpp>

#include "tests/conformance/physics_backends.hpp"

namespace muster::test {
namespace {

using FromTo = std::tuple<Backend, Backend>;
class EachSwap : public Physics, public testing::TestWithParam<FromTo> {};

// One step under the bound of friction, from velocities that may be up to dt older than their pose.
void expect_no_jump(const State& a, const State& b, double dt) {
  const double bound = 0.8 * gravity;
  EXPECT_LE(std::hypot(b.twist.vx - a.twist.vx, b.twist.vy - a.twist.vy), bound * dt);
  EXPECT_LE(b.distance(a.pose.x + a.twist.vx * dt, a.pose.y + a.twist.vy * dt), bound * dt * dt);
  EXPECT_LE(std::abs(b.pose.z - a.pose.z), 1e-4);
}

TEST_P(EachSwap, NothingJumps) {
  const auto& [from, to] = GetParam();
  Started sim = started(from, two, rolling, bends);
  run_for(sim, 150);
  const State a = state(sim), b = state(sim, "b");
  sim.swap("physics", instance(to));
  for (const auto& [before, after] : {std::pair(a, state(sim)), std::pair(b, state(sim, "b"))}) {
    EXPECT_TRUE(same_bits(before.pose, after.pose));
    EXPECT_TRUE(same_bits(before.twist, after.twist));
  }
  sim.step();
  expect_no_jump(a, state(sim), 0.01);
  expect_no_jump(b, state(sim, "b"), 0.01);
  run_for(sim, 50);
  EXPECT_GT(row<Wheels>(sim, "robot/a/wheels").left, 10);  // angles went on
}

TEST_P(EachSwap, NothingJumpsInTheAir) {
  const auto& [from, to] = GetParam();
  if (!from.rotors || !to.rotors) GTEST_SKIP() << "one of them claims no rotors";
  Started sim = started(from, air, {}, wild);
  run_for(sim, 60);
  const State before = state(sim, "b");
  const auto rotors = row<Rotors>(sim, "robot/b/rotors");
  sim.swap("physics", instance(to));
  EXPECT_TRUE(same_bits(before.pose, state(sim, "b").pose));
  EXPECT_TRUE(same_bits(before.twist, state(sim, "b").twist));
  EXPECT_TRUE(same_bits(rotors, row<Rotors>(sim, "robot/b/rotors")));
  sim.step();
  const State after = state(sim, "b");
  const double dt = 0.01, fastest_change = 4 * gravity;  // thrust is at most 3.4 times the weight
  EXPECT_LT(
      std::hypot(after.twist.vx - before.twist.vx, after.twist.vy - before.twist.vy, after.twist.vz - before.twist.vz),
      fastest_change * dt);
  EXPECT_LT(std::hypot(after.pose.x - before.pose.x - before.twist.vx * dt,
                       after.pose.y - before.pose.y - before.twist.vy * dt,
                       after.pose.z - before.pose.z - before.twist.vz * dt),
            fastest_change * dt * dt);
  EXPECT_NEAR(row<Rotors>(sim, "robot/b/rotors").front, rotors.front, 20);
}

// A pendulum on the back of a robot that drives.
TEST_P(EachSwap, LimbsGoOnWithoutAJump) {
  const auto& [from, to] = GetParam();
  if (!from.limbs || !to.limbs) GTEST_SKIP() << "one of them claims no limbs";
  std::filesystem::copy_file(models + "hokuyo.stl", folder / "hokuyo.stl");
  std::string urdf = contents(models + "scarab.urdf");
  urdf.insert(urdf.find("<muster>"),
              "<link name='bob'><inertial><origin xyz='0.05 0 0.1'/><mass value='0.2'/><inertia ixx='1e-4' ixy='0' "
              "ixz='0' iyy='1e-4' iyz='0' izz='1e-4'/></inertial></link><joint name='neck' type='continuous'><parent "
              "link='base'/><child link='bob'/><origin xyz='0 0 0.4'/><axis xyz='0 1 0'/></joint>");
  folder.write("carries.urdf", urdf);
  Started sim = started(from, "<robot name='a' model='carries.urdf' at='0 0 0'/>", {}, bends);
  run_for(sim, 60);
  const State before = state(sim);
  const auto limbs = row<Limbs>(sim, "robot/a/limbs");
  sim.swap("physics", instance(to));
  EXPECT_TRUE(same_bits(before.pose, state(sim).pose));
  EXPECT_TRUE(same_bits(before.twist, state(sim).twist));
  EXPECT_TRUE(same_bits(limbs, row<Limbs>(sim, "robot/a/limbs")));
  sim.step();
  expect_no_jump(before, state(sim), 0.01);
  const Limb then = limbs.limb[0], now = row<Limbs>(sim, "robot/a/limbs").limb[0];
  const double bound = 0.2 * 0.12 * 2 * gravity / 1e-3;  // weight and a push at the bob, over more than its inertia
  EXPECT_GT(std::abs(then.rate), 1);
  EXPECT_LT(std::abs(now.rate - then.rate), bound * 0.01);
  EXPECT_LT(std::abs(now.angle - then.angle - then.rate * 0.01), bound * 0.01 * 0.01);
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(EachSwap);
INSTANTIATE_TEST_SUITE_P(Plugins, EachSwap,
                         testing::Combine(testing::ValuesIn(backends()), testing::ValuesIn(backends())),
                         [](const auto& pair) {
                           return std::get<0>(pair.param).name + "_to_" + std::get<1>(pair.param).name;
                         });

// The table has every plugin that moves robots without a file.
TEST(Backends, AreAllHeldToThis) {
  std::vector<std::string> known;
  for (const Backend& backend : table()) known.push_back(backend.plugin);
  for (const auto& listed : list_plugins({MUSTER_PLUGINS_DIR})) {
    if (!listed.library) continue;
    const muster_plugin& plugin = listed.library->plugins().back();
    bool needs = plugin.phase != MUSTER_PHYSICS;
    for (uint32_t i = 0; i < plugin.param_count; ++i) needs |= (plugin.params[i].flags & MUSTER_REQUIRED) != 0;
    if (!needs) {
      EXPECT_THAT(known, testing::Contains(std::string(listed.library->id())));
    }
  }
}

}  // namespace
}  // namespace muster::test
