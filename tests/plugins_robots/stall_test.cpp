// Robots that push against a wall.
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <iterator>

#include "robot_world.hpp"

namespace {

using namespace muster;
using namespace muster::test;

struct EachBackend : testing::TestWithParam<const char*> {
  // In how many ticks a Scarab whose motors have this torque [N m] stalls: of 150 on its way to a wall, of 150 at it,
  // and of 150 on its way back.
  std::array<int, 3> stalled(const std::string& torque) const {
    const Folder folder;
    std::ifstream scarab(MUSTER_PLUGINS_DIR "/models/scarab.urdf");
    std::string urdf{std::istreambuf_iterator<char>(scarab), {}};
    const std::string old = "max_torque=\"2.765\"";
    urdf.replace(urdf.find(old), old.size(), "max_torque=\"" + torque + "\"");
    const auto model = folder.write("scarab.urdf", urdf);
    std::filesystem::copy(MUSTER_PLUGINS_DIR "/models/hokuyo.stl", model.parent_path());
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

TEST_P(EachBackend, WheelsThatSlipDoNotStall) { EXPECT_EQ(stalled("2.765"), (std::array{0, 0, 0})); }

INSTANTIATE_TEST_SUITE_P(Physics, EachBackend, testing::Values("physics.simbody", "physics.ode"),
                         [](const auto& backend) { return std::string(backend.param).substr(8); });

}  // namespace
