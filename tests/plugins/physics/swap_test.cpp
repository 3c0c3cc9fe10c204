// Backends exchanged in mid-run, without jumps.
#include <cstring>

#include "physics_world.hpp"
#include "tests/sanitized.hpp"

namespace {

using namespace muster;
using namespace muster::test;

struct State {
  Pose pose;
  Twist twist;
};

State state(const Simulation& run, const std::string& robot) {
  return {row<Pose>(run, "robot/" + robot + "/pose"), row<Twist>(run, "robot/" + robot + "/twist")};
}

template <class Row>
bool same_bits(const Row& a, const Row& b) {
  return std::memcmp(&a, &b, sizeof(Row)) == 0;
}

// One step of dt under a bound on acceleration, from velocities that may be up to dt older than their pose.
void expect_no_jump(const State& a, const State& b, double bound, double dt) {
  EXPECT_LE(std::hypot(b.twist.vx - a.twist.vx, b.twist.vy - a.twist.vy), bound * dt);
  EXPECT_LE(std::hypot(b.pose.x - a.pose.x - a.twist.vx * dt, b.pose.y - a.pose.y - a.twist.vy * dt), bound * dt * dt);
  EXPECT_LE(std::abs(b.pose.z - a.pose.z), 1e-4);
}

TEST(Swap, SimbodyToPlanarAndBackDoesNotJump) {
  Folder folder;
  Simulation run =
      world_of(folder, std::string(two_scarabs) +
                           R"(<test.wheels v="0.35" dv="0.1" dw="0.8"/><physics.simbody name="physics"/>)");
  run_to(run, 150);
  const double dt = 0.01, bound = 0.8 * 9.81;
  for (int round = 0; round < 6; ++round) {
    const bool to_planar = round % 2 == 0;
    const State a = state(run, "a"), b = state(run, "b");
    run.swap("physics", instance(to_planar ? "physics.planar" : "physics.simbody"));
    EXPECT_TRUE(same_bits(a.pose, state(run, "a").pose));
    EXPECT_TRUE(same_bits(a.twist, state(run, "a").twist));
    EXPECT_TRUE(same_bits(b.pose, state(run, "b").pose));
    run.step();
    expect_no_jump(a, state(run, "a"), bound, dt);
    expect_no_jump(b, state(run, "b"), bound, dt);
    run_to(run, run.tick() + 30);
  }
  const auto wheels = row<Wheels>(run, "robot/a/wheels");
  EXPECT_GT(wheels.left + wheels.right, 10);  // angles continued through all swaps
}

// A robot that joined as a copy has the model of its original: later instances can read it.
TEST(Swap, ABackendMadeAfterARobotJoinedKnowsItsModel) {
  Folder folder;
  const auto made = [&] {
    return world_of(folder, std::string(two_scarabs) + R"(<test.wheels v="0.3"/><physics.simbody name="physics"/>
                    <toy.join name="j" library=")" MUSTER_BUILD_DIR
                                                       R"(/tests/toys/toy_join.so" at="20" leave="1000" like="0"/>)");
  };
  Simulation run = made(), other = made();
  run_to(run, 30);
  run.snapshot().save(folder / "at30");
  run.remake("physics");
  run_to(run, 40);
  run_to(other, 40);
  EXPECT_EQ(run.digest(), other.digest());
  run.swap("physics", instance("physics.planar"));  // which keeps no model
  run.swap("physics", instance("physics.simbody"));
  run_to(run, 60);
  EXPECT_LT(std::abs(row<Pose>(run, "robot/late/pose").z), 0.2);  // it stands on its wheels
  Simulation again = made();
  again.restore(Snapshot::load(folder / "at30"));
  again.remake("physics");
  run_to(again, 40);
  EXPECT_EQ(again.digest(), other.digest());
}

TEST(Swap, EventSaysWhatPlanarCannotHold) {
  Folder folder;
  Simulation run = world_of(folder, std::string(two_scarabs) + R"(<physics.simbody name="physics"/>
                                    <swap at="0.05" instance="physics" plugin="physics.planar"/>)");
  run_to(run, 10);
  bool said = false;
  for (const Event& event : run.events()) {
    said = said || event.message ==
                       "swapped from physics.simbody to physics.planar/1; it cannot hold changes of height, roll "
                       "and pitch, and wheel slip";
  }
  EXPECT_TRUE(said);
}

TEST(Swap, ReferenceIntegratorTakesOver) {
  Folder folder;
  Simulation run = world_of(
      folder, std::string(two_scarabs) + R"(<test.wheels v="0.3" dw="0.5"/><physics.simbody name="physics"/>)");
  run_to(run, 100);
  const State a = state(run, "a");
  run.swap("physics", instance("physics.simbody", {{"integrator", "rk3"}}));
  EXPECT_TRUE(same_bits(a.pose, state(run, "a").pose));
  run.step();
  const State b = state(run, "a");
  EXPECT_LT(std::hypot(b.pose.x - a.pose.x - a.twist.vx * 0.01, b.pose.y - a.pose.y - a.twist.vy * 0.01), 1e-4);
}

// Resident pages, as the kernel counts them.
long resident_pages() {
  std::ifstream statm("/proc/self/statm");
  long size = 0, resident = 0;
  statm >> size >> resident;
  return resident;
}

TEST(Swap, ManySwapsLeaveMemoryFlat) {
  Folder folder;
  Simulation run =
      world_of(folder, std::string(two_scarabs) + R"(<test.wheels v="0.3"/><physics.simbody name="physics"/>)");
  const auto swaps = [&](int count) {
    for (int i = 0; i < count; ++i) {
      run.swap("physics", instance(i % 2 ? "physics.simbody" : "physics.planar"));
      run.step();
    }
  };
  swaps(20);
  const long before = resident_pages();
  swaps(60);
  if (sanitized) GTEST_SKIP() << "a sanitizer keeps what was freed";
  EXPECT_LT(resident_pages() - before, 256);  // 1 MB in 60 swaps
}

}  // namespace
