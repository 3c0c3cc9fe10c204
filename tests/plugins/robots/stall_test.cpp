// Robots whose wheels are held.
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "robot_world.hpp"
#include "tests/backends.hpp"

namespace {

using namespace muster;
using namespace muster::test;

struct EachBackend : testing::TestWithParam<const char*> {
  // Number of ticks in which a Scarab whose motors have this torque [N m] stalls: of 150 on its way to a wall, of 150
  // at it, and of 150 on its way back.
  std::array<int, 3> stalled(const std::string& torque) const {
    const Folder folder;
    const auto model = scarab_with(folder, {{"max_torque=\"2.765\"", "max_torque=\"" + torque + "\""}});
    Simulation run =
        world_of(folder,
                 "<material name=\"brick\" loss=\"6\"/><wall name=\"w\" from=\"1 -2\" to=\"1 2\" "
                 "material=\"brick\"/><robot name=\"r\" model=\"" +
                     model.string() + "\" at=\"0 0 0\"/><" + GetParam() +
                     "/><robots.drive/><robots.odometry/><test.command robot=\"r\" plan=\"plan.csv\"/>",
                 {{"plan.csv", "t[s],v[m/s],w[rad/s]\n0,0.2,0\n7.5,-0.2,0\n"}}, "dt=\"0.02\" until=\"12\" seed=\"1\"");
    std::array<int, 3> result{};
    const auto count = [&](int& ticks) {
      for (int k = 0; k < 150; ++k) {
        run.step();
        ticks += row<Stall>(run, "robot/r/stall").stalled != 0;
      }
    };
    count(result[0]);
    for (int k = 0; k < 75; ++k) run.step();  // it arrives
    count(result[1]);
    count(result[2]);
    return result;
  }
};

TEST_P(EachBackend, WeakMotorsStallAtAWallAndNowhereElse) {
  const auto [before, at, back] = stalled("0.3");
  EXPECT_EQ(before, 0);
  EXPECT_GE(at, 145);
  EXPECT_LE(back, 5) << "while the rate that is asked for falls to zero";
}

// One wheel is enough, on either side and in either direction; no stall while both turn as commanded, or are at rest.
TEST(Stall, IsOfEitherWheel) {
  const auto stalled = [](const std::string& stuck, const std::string& asked) {
    const Folder folder;
    Simulation run =
        world_of(folder,
                 "<robot name=\"r\" at=\"0 0 0\"/><test.command robot=\"r\" plan=\"plan.csv\"/><test.turner stuck=\"" +
                     stuck + "\"/><robots.drive/><robots.odometry/>",
                 {{"plan.csv", "t[s],v[m/s],w[rad/s]\n0," + asked + "\n"}});
    for (int k = 0; k < 20; ++k) run.step();
    return row<Stall>(run, "robot/r/stall").stalled;
  };
  for (const std::string asked : {"0.2,0", "-0.2,0", "0,0.5", "0,-0.5"}) {
    EXPECT_EQ(stalled("none", asked), 0) << asked;
    EXPECT_EQ(stalled("left", asked), 1) << asked;
    EXPECT_EQ(stalled("right", asked), 1) << asked;
  }
  EXPECT_EQ(stalled("left", "0,0"), 0);
}

TEST_P(EachBackend, WheelsThatSlipDoNotStall) { EXPECT_EQ(stalled("2.765"), (std::array{0, 0, 0})); }

INSTANTIATE_TEST_SUITE_P(Physics, EachBackend,
                         testing::ValuesIn(built({"physics.simbody", "physics.ode", "physics.mujoco"})),
                         [](const auto& backend) { return std::string(backend.param).substr(8); });

}  // namespace
