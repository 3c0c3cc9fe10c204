// The engine of physics.mujoco by itself: MuJoCo's errors, its room for contacts, and joints that no other engine here
// has.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>

#include "plugins/physics_mujoco/world.hpp"
#include "tests/folder.hpp"

namespace muster::mujoco {
namespace {

using test::Folder;

const std::string models = MUSTER_SOURCE_DIR "/plugins/robots/models/";

RobotState at(double x, double y, double z) { return {{x, y, z, 1, 0, 0, 0}, {}, {}, {}}; }

bool same_bits(const RobotState& a, const RobotState& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

TEST(Mujoco, ItsErrorsAreExceptionsAndItsHandlersAreGivenBack) {
  const auto before = mju_user_error;
  const auto warned = mju_user_warning;
  {
    const Library library, another;
    EXPECT_THAT([] { mju_error("the roof is on fire"); },
                testing::ThrowsMessage<std::runtime_error>("MuJoCo: the roof is on fire"));
    EXPECT_THAT([] { compile("<mujoco><worldbody><body><freejoint/></body></worldbody></mujoco>"); },
                testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("MuJoCo refuses the world: ")));
    EXPECT_THAT([] { mju_error("still"); }, testing::ThrowsMessage<std::runtime_error>("MuJoCo: still"));
    Warnings warnings;
    mju_warning("smoke");
    mju_warning("more of it");
    EXPECT_EQ(warnings.count, 2);
    EXPECT_EQ(warnings.first, "smoke");
  }
  EXPECT_EQ(mju_user_error, before);
  EXPECT_EQ(mju_user_warning, warned);
  EXPECT_FALSE(std::filesystem::exists("MUJOCO_LOG.TXT"));
}

// A tower of crates, each in contact with the next: far more contacts than there is room for at first.
TEST(Mujoco, RoomForContactsChangesNothing) {
  const auto crate = description::read_robot(models + "crate.urdf");
  std::vector<NamedRobot> tower;
  std::vector<RobotState> states;
  for (int k = 0; k < 6; ++k) {
    tower.push_back({"crate" + std::to_string(k), &crate});
    states.push_back(at(0.01 * k, 0, 0.26 * k));
  }
  const std::vector<Command> none(tower.size(), Command{});
  World roomy(tower, {}), narrow(tower, {}, {2, 6});
  auto one = states, other = states;
  for (int tick = 0; tick < 40; ++tick) {
    EXPECT_EQ(roomy.step(0.01, none, one), "");
    EXPECT_EQ(narrow.step(0.01, none, other), "");
  }
  for (std::size_t i = 0; i < states.size(); ++i) EXPECT_TRUE(same_bits(one[i], other[i])) << i;
  EXPECT_GT(narrow.room().contacts, 2);
  EXPECT_LT(one[5].pose[2], states[5].pose[2] - 0.01) << "it fell onto the others";
}

// An arm that swings over the top into its stop at 4 rad.
TEST(Mujoco, StopsBeyondHalfATurnHold) {
  const auto inertial = [](const std::string& where, const std::string& mass, const std::string& moment) {
    return "<inertial><origin xyz='" + where + "'/><mass value='" + mass + "'/><inertia ixx='" + moment +
           "' ixy='0' ixz='0' iyy='" + moment + "' iyz='0' izz='" + moment + "'/></inertial>";
  };
  const Folder folder;
  const auto file = folder.write(
      "arm.urdf",
      "<robot name='arm'><link name='base'>" + inertial("0 0 0.5", "1e6", "1e6") +
          "<collision><origin xyz='0 0 0.5'/><geometry><box size='2 2 1'/></geometry></collision></link><link "
          "name='arm'>" +
          inertial("0.3 0 0", "0.5", "1e-3") +
          "</link><joint name='hinge' type='revolute'><parent link='base'/><child link='arm'/><origin xyz='0 0 2'/>"
          "<axis xyz='0 1 0'/><limit lower='0' upper='4' effort='1' velocity='1'/></joint></robot>");
  const auto robot = description::read_robot(file.string());
  World world({{"a", &robot}}, {});
  std::vector<RobotState> states{at(0, 0, 0)};
  states[0].limbs.limb[0].rate = 15;
  double farthest = 0;
  for (int tick = 0; tick < 100; ++tick) {
    world.step(0.01, {Command{}}, states);
    farthest = std::max(farthest, states[0].limbs.limb[0].angle);
  }
  EXPECT_NEAR(farthest, 4, 1e-3);
  EXPECT_NEAR(states[0].limbs.limb[0].rate, 0, 5);  // it fell back from there
}

// Sliding on wheels that are held: the normal force of a slipping contact is the weight, not more by friction times
// slip, as MuJoCo's own convex contacts would have it at their first step.
TEST(Mujoco, ASlidingCrateStaysOnTheGround) {
  const auto crate = description::read_robot(models + "crate.urdf");
  World world({{"a", &crate}}, {});
  std::vector<RobotState> states{at(0, 0, 0)};
  states[0].twist[0] = 2;
  double highest = 0, before = 2;
  for (int tick = 0; tick < 60; ++tick) {
    world.step(0.01, {Command{}}, states);
    highest = std::max(highest, std::abs(states[0].pose[2]));
    EXPECT_NEAR(before - states[0].twist[0], 0.3 * gravity * 0.01, 1e-4) << tick;
    before = states[0].twist[0];
  }
  EXPECT_LT(highest, 1e-5);
}

TEST(Mujoco, AMotionThatBlowsUpNamesTheRobot) {
  const auto crate = description::read_robot(models + "crate.urdf");
  World world({{"a", &crate}}, {});
  std::vector<RobotState> states{at(0, 0, 0)};
  states[0].twist[0] = 2000;
  EXPECT_THAT([&] { world.step(0.01, {Command{}}, states); },
              testing::ThrowsMessage<std::runtime_error>("robot 'a': its motion blew up"));
}

}  // namespace
}  // namespace muster::mujoco
