// Four rotors against their sums one by one, and against closed forms.
#include "description/quadrotor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "description/abilities.hpp"
#include "files.hpp"

namespace muster::description {
namespace {

using Eigen::Vector3d;

const Robot& hummingbird() {
  static const Robot robot = read_robot(MUSTER_SOURCE_DIR "/plugins/robots/models/hummingbird.urdf");
  return robot;
}

TEST(Hummingbird, HasItsSourcesFigures) {
  const Robot& robot = hummingbird();
  ASSERT_TRUE(robot.quadrotor);
  EXPECT_FALSE(robot.drive);
  EXPECT_NEAR(whole_mass(robot).mass, 0.68 + 4 * 0.009, 1e-12);
  const Quadrotor& drive = *robot.quadrotor;
  EXPECT_EQ(drive.arm, 0.17);
  EXPECT_NEAR(drive.torque_factor / drive.thrust_factor, 0.016, 1e-9);
  EXPECT_EQ(drive.lag_up, 0.0125);
  EXPECT_EQ(drive.lag_down, 0.025);
  EXPECT_GT(drive.max_thrust(), 3 * 0.716 * 9.81);
  for (const char* name : {"front_rotor", "left_rotor", "back_rotor", "right_rotor"}) {
    const auto joint = std::find_if(robot.joints.begin(), robot.joints.end(),
                                    [&](const Joint& j) { return j.name == std::string(name) + "_mount"; });
    ASSERT_NE(joint, robot.joints.end());
    EXPECT_NEAR(joint->origin.translation().head<2>().norm(), drive.arm, 1e-12) << name;
    EXPECT_NEAR(joint->origin.translation().z(), drive.height, 1e-12) << name;
  }
}

// Each rotor alone: its thrust and torque, and the drag of its air flow.
TEST(Rotors, WrenchIsTheSumOverRotors) {
  const Quadrotor& drive = *hummingbird().quadrotor;
  const RotorRates rates = {300, 450, 600, 200};
  const Vector3d v(1, -2, 3), w(0.5, -1.5, 2.5);
  const Vector3d places[] = {{drive.arm, 0, drive.height},
                             {0, drive.arm, drive.height},
                             {-drive.arm, 0, drive.height},
                             {0, -drive.arm, drive.height}};
  Vector3d force(0, 0, 0), torque(0, 0, 0);
  for (std::size_t i = 0; i < 4; ++i) {
    Vector3d air = v + w.cross(places[i]);
    air.z() = 0;
    const Vector3d own = Vector3d(0, 0, drive.thrust_factor * rates[i] * rates[i]) - drive.drag_factor * rates[i] * air;
    const double sense = i % 2 == 0 ? 1 : -1;  // against the rotor's own: front and back turn clockwise
    force += own;
    torque += places[i].cross(own) + Vector3d(0, 0, sense * drive.torque_factor * rates[i] * rates[i]);
  }
  const Wrench sum = drive.wrench(rates, v, w);
  EXPECT_LT((sum.force - force).norm(), 1e-12);
  EXPECT_LT((sum.torque - torque).norm(), 1e-12);
}

TEST(Rotors, FollowAsALagOfFirstOrderAndTimesCompose) {
  const Quadrotor& drive = *hummingbird().quadrotor;
  const RotorRates now = {100, 500, 0, 800}, asked = {400, 400, 900, -5};
  const RotorRates then = drive.later(now, asked, drive.decay(0.02));
  EXPECT_NEAR(then[0], 400 - 300 * std::exp(-0.02 / 0.0125), 1e-9);
  EXPECT_NEAR(then[1], 400 + 100 * std::exp(-0.02 / 0.025), 1e-9);
  EXPECT_NEAR(then[2], 838 * (1 - std::exp(-0.02 / 0.0125)), 1e-9) << "asked for more than it can";
  EXPECT_NEAR(then[3], 800 * std::exp(-0.02 / 0.025), 1e-9) << "it does not turn backwards";
  const RotorRates halves = drive.later(drive.later(now, asked, drive.decay(0.01)), asked, drive.decay(0.01));
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(halves[i], then[i], 1e-10);
}

TEST(Rotors, RatesForAWrenchGiveIt) {
  const Quadrotor& drive = *hummingbird().quadrotor;
  const Vector3d torque(0.1, -0.15, 0.02);
  const Wrench given = drive.wrench(drive.rates_for(8, torque), Vector3d::Zero(), Vector3d::Zero());
  EXPECT_NEAR(given.force.z(), 8, 1e-12);
  EXPECT_LT((given.torque - torque).norm(), 1e-12);
}

// Turning is reduced first, then thrust is changed, up or down, and roll and pitch are reduced last.
TEST(Rotors, WhatIsTooMuchGivesWayInOrder) {
  const Quadrotor& drive = *hummingbird().quadrotor;
  const double most = drive.max_thrust() / 4;
  const auto given = [&](double thrust, const Vector3d& torque) {
    return drive.wrench(drive.rates_for(thrust, torque), Vector3d::Zero(), Vector3d::Zero());
  };
  const Vector3d tilt(0.3 * most * drive.arm, 0.2 * most * drive.arm, 0);
  for (const double thrust : {0.01, 2 * most, 9 * most}) {
    const Wrench w = given(thrust, tilt + Vector3d(0, 0, 99));
    EXPECT_LT((w.torque.head<2>() - tilt.head<2>()).norm(), 1e-9) << thrust;
    EXPECT_GT(w.torque.z(), 0) << thrust;
    EXPECT_LT(w.torque.z(), 99) << thrust;
    EXPECT_LE(w.force.z(), drive.max_thrust()) << thrust;
  }
  EXPECT_GT(given(0.01, tilt).force.z(), 0.01) << "raised, so that no rotor turns backwards";
  EXPECT_NEAR(given(2 * most, tilt).force.z(), 2 * most, 1e-9);
  EXPECT_LT(given(9 * most, tilt).force.z(), 4 * most) << "lowered";
  EXPECT_NEAR(given(2 * most, Vector3d(99, 0, 0)).torque.x(), most * drive.arm, 1e-9);
  for (const double rate : drive.rates_for(0, tilt)) EXPECT_EQ(rate, 0);
}

TEST(Rotors, HoverDragIsWhatTheWrenchHas) {
  const Quadrotor& drive = *hummingbird().quadrotor;
  const Wrench w = drive.wrench(drive.rates_for(7, Vector3d::Zero()), Vector3d(1e-3, 0, 0), Vector3d::Zero());
  EXPECT_NEAR(-w.force.x() / 1e-3, drive.hover_drag(7), 1e-9);
}

std::string quadrotor(const std::string& change, const std::string& to) {
  std::string text =
      "<robot name='r'>\n<link name='a'><inertial><mass value='0.5'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' "
      "iyz='0' izz='1'/></inertial></link>\n<muster><quadrotor arm='0.17' thrust_factor='8e-6' torque_factor='1e-7' "
      "max_speed='800' lag_up='0.02' lag_down='0.03' attitude_p='200' attitude_d='20' yaw_p='4'/></muster></robot>";
  const auto at = text.find(change);
  return at == text.npos ? "no such text" : text.replace(at, change.size(), to);
}

TEST(QuadrotorFault, IsNamedWithItsLine) {
  const std::pair<std::array<std::string, 2>, std::string> cases[] = {
      {{"arm='0.17'", ""}, "<quadrotor> has no attribute 'arm'"},
      {{"arm='0.17'", "arm='17 cm'"}, "<quadrotor> arm=\"17 cm\" is wrong; expected a number above 0"},
      {{"arm=", "armm='1' arm="}, "<quadrotor> has no attribute 'armm'; did you mean 'arm'?"},
      {{"yaw_p='4'", "yaw_p='4' drag_factor='-1'"},
       "<quadrotor> drag_factor=\"-1\" is wrong; expected a number from 0"},
      {{"max_speed='800'", "max_speed='300'"},
       "<quadrotor> four rotors at max_speed lift 2.88 N, but the robot weighs 4.905 N"},
      {{"attitude_d='20'", "attitude_d='5'"},
       "<quadrotor> roll and pitch would never come to rest with rotors that lag by 0.03 s; expected attitude_d above "
       "lag attitude_p + attitude_i / attitude_p"},
      {{"yaw_p='4'", "yaw_p='4' yaw_i='150'"},
       "<quadrotor> the turn rate would never come to rest with rotors that lag by 0.03 s; expected yaw_p above lag "
       "yaw_i"},
      {{"<muster>",
        "<muster><quadrotor arm='0.17' thrust_factor='8e-6' torque_factor='1e-7' max_speed='800' "
        "lag_up='0.02' lag_down='0.03' attitude_p='200' attitude_d='20' yaw_p='4'/>"},
       "has a second drive"}};
  for (const auto& [change, message] : cases) {
    Files files;
    const std::string path = files.write("bad.urdf", quadrotor(change[0], change[1]));
    EXPECT_EQ(message_of([&] { read_robot(path); }), path + ":3: " + message);
  }
  Files files;
  EXPECT_TRUE(read_robot(files.write("good.urdf", quadrotor("yaw_p", "yaw_p"))).quadrotor);
}

TEST(Abilities, WhatIsLackingIsListed) {
  const Robot& flying = hummingbird();
  const Ability all = Ability::wheels | Ability::rotors | Ability::height | Ability::tilting;
  EXPECT_EQ(lacking(flying, all), "");
  EXPECT_EQ(lacking(flying, Ability::wheels), "rotors (<quadrotor>), changes of height, roll and pitch");
  EXPECT_EQ(lacking(flying, Ability::rotors | Ability::height), "roll and pitch");
  Robot driven = read_robot(MUSTER_SOURCE_DIR "/plugins/robots/models/scarab.urdf");
  EXPECT_EQ(lacking(driven, Ability::wheels), "");
  EXPECT_EQ(lacking(driven, Ability::rotors), "wheels (<differential>)");
  driven.restitution = 0.5;
  EXPECT_EQ(lacking(driven, all), "bouncing (<muster restitution=...>)");
  EXPECT_EQ(lacking(driven, all | Ability::bouncing), "");
  driven.restitution = 0;
  driven.drive->right = driven.drive->left;
  EXPECT_EQ(lacking(driven, all), "joint 'right_wheel_joint' (continuous) without a motor");
  driven.drive.reset();
  EXPECT_EQ(
      lacking(driven, Ability::wheels | Ability::hinges),
      "motion without a drive (its model has no <muster><differential .../></muster>, <quadrotor .../> or <legs>)");
}

}  // namespace
}  // namespace muster::description
